#pragma once

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ridgeline {

/// Why a request could not be answered. The numbers go over the wire: append, never renumber.
/// name(code) is the `code` of the JSON error object.
enum class ErrorCode {
  BadInput = 1,                  ///< a field is missing, unknown, not finite or out of its range
  UnknownWorkpiece = 2,          ///< no such name in the library
  UnknownHole = 3,               ///< the workpiece has no hole of that name
  UnknownTool = 4,               ///< no such number or name in the library
  InconsistentEccentricity = 5,  ///< the given f and the positions disagree
  TangentIntersection = 6,       ///< the ridge has a corner: hole and body touch tangentially
  HoleMissesBody = 7,            ///< the hole does not break through the surface asked for
  WidthTooLarge = 8,             ///< the chamfer leaves its surfaces or eats through the wall
  ToolTooLarge = 9,              ///< the ball cannot enter, or gouges elsewhere
  NeckCollision = 10,            ///< the neck or shank touches the body
  HolderCollision = 11,          ///< the holder touches the body
  SweptNotReached = 12,          ///< the swept solution did not converge
  ToleranceTooSmall = 13,        ///< would need more points than the limit
  Internal = 14,                 ///< a bug: an invariant does not hold
  Unsupported = 15,              ///< well formed, but this combination is not offered
  Timeout = 16,                  ///< no answer within the time set
  Cancelled = 17,                ///< the requester cancelled
  Busy = 18,                     ///< the queue is full
  NoService = 19,                ///< no live instance
  Storage = 20,                  ///< the library file cannot be read or written
  UnknownDefinition = 21,        ///< the library has no such definition
  Alarm = 22,                    ///< a macro program stopped with an alarm
  NotConverged = 23,             ///< an iteration gave up and no fall-back was allowed
  VerificationFailed = 24,       ///< a measured path does not keep what the job asks
  UnknownMaterial = 25,          ///< no such material in the library
  BadFile = 26,                  ///< a file is not of the format that it should be
  NotTurned = 27,                ///< a product is no turned part
  SeveralSolids = 28,            ///< a file holds several parts and none of them stands out
  AbsurdSize = 29,               ///< a part far larger or smaller than any machine: a wrong unit
};

/// Stable name on the wire and in JSON, e.g. "bad_input".
std::string_view name(ErrorCode code) noexcept;

/// The code of a name; nullopt when there is none.
std::optional<ErrorCode> error_code(std::string_view name) noexcept;

/// What the error object says beyond its message. Empty members are left out.
struct ErrorDetails {
  std::string field = {};                ///< JSON pointer of the offending field, e.g. "/width"
  std::string value = {};                ///< its value as text
  std::string limit = {};                ///< the limit that it breaks, as text with unit
  std::optional<double> parameter = {};  ///< profile parameter u in [0, 1) of the place
  std::optional<Eigen::Vector3d> target = {};  ///< target point P there [mm, work frame]
};

/// The one exception type of the core. The message names the field or quantity, its value, unit and
/// the limit it breaks.
class Error : public std::runtime_error {
public:
  Error(ErrorCode code, const std::string& message, ErrorDetails details = {})
      : std::runtime_error(message), code_(code), details_(std::move(details)) {}
  ErrorCode code() const noexcept { return code_; }
  const ErrorDetails& details() const noexcept { return details_; }

private:
  ErrorCode code_;
  ErrorDetails details_;
};

}  // namespace ridgeline
