#pragma once

#include "core/cutting/cut.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// Reads `engagement` of a predict case into cut.stock and cut.n, and into cut.cutter.height for a
/// square mill. `cut` has its cutter and feed direction. Accepts, all in the frame of the cut:
///
///     {"normal": n, "c": depth, "grooves": [[x, y, z], ...]}      plane stock, ball
///     {"normal": n, "a": depth, "ap": height}                     plane stock, square mill
///     {"normal": n, "faces": [{"normal", "height"} | {"centre", "axis", "radius", "material"}],
///      "combine": "all"|"any"}                                    an edge; any: concave
///     {"normal": n, "map": {"origin": [x, y], "cell", "columns", "heights": [...],
///      "at": [x, y, z]}}                                          height map; at: O' in its frame
void read_stock(const Value& value, cutting::Cut& cut);

}  // namespace ridgeline::jobs
