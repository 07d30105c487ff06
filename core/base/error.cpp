#include "core/base/error.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ridgeline {
namespace {

constexpr std::array<std::pair<ErrorCode, std::string_view>, 29> names{{
    {ErrorCode::BadInput, "bad_input"},
    {ErrorCode::UnknownWorkpiece, "unknown_workpiece"},
    {ErrorCode::UnknownHole, "unknown_hole"},
    {ErrorCode::UnknownTool, "unknown_tool"},
    {ErrorCode::InconsistentEccentricity, "inconsistent_eccentricity"},
    {ErrorCode::TangentIntersection, "tangent_intersection"},
    {ErrorCode::HoleMissesBody, "hole_misses_body"},
    {ErrorCode::WidthTooLarge, "width_too_large"},
    {ErrorCode::ToolTooLarge, "tool_too_large"},
    {ErrorCode::NeckCollision, "neck_collision"},
    {ErrorCode::HolderCollision, "holder_collision"},
    {ErrorCode::SweptNotReached, "swept_not_reached"},
    {ErrorCode::ToleranceTooSmall, "tolerance_too_small"},
    {ErrorCode::Internal, "internal"},
    {ErrorCode::Unsupported, "unsupported"},
    {ErrorCode::Timeout, "timeout"},
    {ErrorCode::Cancelled, "cancelled"},
    {ErrorCode::Busy, "busy"},
    {ErrorCode::NoService, "no_service"},
    {ErrorCode::Storage, "storage"},
    {ErrorCode::UnknownDefinition, "unknown_definition"},
    {ErrorCode::Alarm, "alarm"},
    {ErrorCode::NotConverged, "not_converged"},
    {ErrorCode::VerificationFailed, "verification_failed"},
    {ErrorCode::UnknownMaterial, "unknown_material"},
    {ErrorCode::BadFile, "bad_file"},
    {ErrorCode::NotTurned, "not_turned"},
    {ErrorCode::SeveralSolids, "several_solids"},
    {ErrorCode::AbsurdSize, "absurd_size"},
}};

}  // namespace

std::string_view name(ErrorCode code) noexcept {
  const auto* found =
      std::ranges::find(names, code, &std::pair<ErrorCode, std::string_view>::first);
  return found == names.end() ? "internal" : found->second;
}

std::optional<ErrorCode> error_code(std::string_view name) noexcept {
  const auto* found =
      std::ranges::find(names, name, &std::pair<ErrorCode, std::string_view>::second);
  if (found == names.end()) return std::nullopt;
  return found->first;
}

}  // namespace ridgeline
