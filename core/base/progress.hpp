#pragma once

#include <cstddef>
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

  /// Within a loop of `count` short steps, at step i: looks once in so many.
  void step(std::size_t i, std::size_t count, std::string_view stage) const {
    constexpr std::size_t between_looks = 1024;
    if (i % between_looks == 0) at(static_cast<double>(i) / static_cast<double>(count), stage);
  }

  /// For a part of this work: its 0 is `from`, its 1 `to`.
  Progress part(double from, double to) const {
    Progress part;
    part.stop = stop;
    if (report) {
      part.report = [whole = report, from, to](double fraction, std::string_view stage) {
        whole(from + fraction * (to - from), stage);
      };
    }
    return part;
  }
};

}  // namespace ridgeline
