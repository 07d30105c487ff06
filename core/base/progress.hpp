#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "core/base/error.hpp"

namespace ridgeline {

/// How long work tells how far it is and learns that it is no longer wanted. Long loops call `at`
/// often enough that a cancel takes effect within 100 ms.
struct Progress {
  std::function<void(double fraction, std::string_view stage)>
      report;  ///< may be empty; fraction in [0, 1]
  std::stop_token stop;

  /// Throws Error{Cancelled} when stop was requested.
  void at(double fraction, std::string_view stage) const {
    if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled by the requester");
    if (report) report(fraction, stage);
  }
};

}  // namespace ridgeline
