#pragma once

#include <ctime>

namespace ridgeline::bench {

/// Processor time that `work` takes in this process [s]: what others do on the machine is not in
/// it.
double processor_seconds(auto&& work) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

}  // namespace ridgeline::bench
