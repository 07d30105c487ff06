#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "core/nc/g_code_block.hpp"

/// What the G code reader knows of words that need no state. G codes are in tenths: G54.1 is 541.
namespace ridgeline::nc {

/// G codes that do not change where the tool goes; uses up the words that belong to them.
bool is_harmless_g(int code, Block& block, Dialect dialect);

/// Says why a G code is not read.
[[noreturn]] void refuse_g(int code, const Spot& spot);

/// Names of Siemens that do not change where the tool goes.
bool is_harmless_name(std::string_view name);

/// CYCLE800 in mode 57; `axes` is absent for CYCLE800(), which goes back.
struct SwivelPlane {
  std::optional<Eigen::Matrix3d> axes;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};
SwivelPlane swivel_plane(const Name& name, const Spot& spot);

}  // namespace ridgeline::nc
