#pragma once

#include <optional>
#include <span>

#include "part/model.hpp"

namespace ridgeline::part {

/// A free-form surface that is really a plane, cylinder, cone or sphere within 1e-4 mm, from points
/// on it with their normals; nullopt when it is none. The samples must spread over the face.
std::optional<Surface> recognised(std::span<const Sample> samples);

}  // namespace ridgeline::part
