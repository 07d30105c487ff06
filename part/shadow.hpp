#pragma once

#include "core/units/region.hpp"
#include "part/image.hpp"

namespace ridgeline::part {

/// The rotational shadow S of a turned part: every (r, z) that some angle of it reaches
/// (design 2.3). Evidence, slab by slab: what free faces show is material; beside a turned face its
/// normal says; where nothing says, a circle is tried in the solid. A void on the axis is a bore
/// only where a turned face bounds it (1.8-g); a bore behind one that is not stays open as wide as
/// itself.
units::Region shadow_of(const Placed& part, const TurnedFaces& turned, const Image& image);

}  // namespace ridgeline::part
