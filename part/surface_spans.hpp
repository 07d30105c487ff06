#pragma once

#include <vector>

class BRepAdaptor_Surface;

namespace ridgeline::part {

/// Parameters between which 8 Gauss points are enough for a surface, from its first to its last.
struct SurfaceSpans {
  std::vector<double> u;
  std::vector<double> v;
};

SurfaceSpans surface_spans(const BRepAdaptor_Surface& surface);

}  // namespace ridgeline::part
