#pragma once

#include "ridgeline.h"

namespace ridgeline {

/// A typed chamfer of hole H1 of "tube-40" by tool 12, as a controller sends it.
inline ridgeline_wire_ChamferJob typed_chamfer() {
  static char tube[] = "tube-40", hole[] = "H1", tool[] = "12", none[] = "";
  ridgeline_wire_ChamferJob chamfer{};
  chamfer.workpiece = tube;
  chamfer.hole = hole;
  chamfer.tool = tool;
  chamfer.tool_axis = chamfer.dialect = chamfer.work_offset = none;
  chamfer.width = 0.5;
  return chamfer;
}

}  // namespace ridgeline
