#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/progress.hpp"

namespace ridgeline::jobs {

/// Runs work(i) for every i below count, each once, on as many threads as the machine has, at most
/// 8. The calling thread reports; the first error ends all and is thrown.
template <typename Work>
void in_parallel(std::size_t count, const Progress& progress, std::string_view stage,
                 const Work& work) {
  constexpr unsigned most_threads = 8;
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> stop{false};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&](bool reports) {
    try {
      for (std::size_t i = next++; i < count && !stop; i = next++) {
        if (reports) progress.at(static_cast<double>(done) / static_cast<double>(count), stage);
        work(i);
        ++done;
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  {
    const unsigned threads =
        std::min(std::max(std::thread::hardware_concurrency(), 1U), most_threads);
    std::vector<std::jthread> helpers;
    for (unsigned t = 1; t < threads && t < count; ++t) helpers.emplace_back(run, false);
    run(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ridgeline::jobs
