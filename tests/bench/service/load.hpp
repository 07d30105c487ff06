#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

namespace ridgeline::bench {

using Clock = std::chrono::steady_clock;

struct Quantiles {
  double p50 = 0, p99 = 0;
};

inline Quantiles quantiles(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds[seconds.size() * 99 / 100]};
}

template <class F>
double seconds(F&& f) {
  const auto begin = Clock::now();
  f();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Latency of each ask with `in_flight` threads, and all asks a second.
struct Load {
  Quantiles latency;
  double rate = 0;
};
template <class F>
Load load(int in_flight, int count, F&& ask) {
  std::vector<std::vector<double>> times(static_cast<std::size_t>(in_flight));
  std::atomic<int> left = count;
  const double all = seconds([&] {
    std::vector<std::jthread> threads;
    for (auto& mine : times)
      threads.emplace_back([&] {
        while (left-- > 0) mine.push_back(seconds(ask));
      });
  });
  std::vector<double> together;
  for (const auto& mine : times) together.insert(together.end(), mine.begin(), mine.end());
  return {quantiles(together), count / all};
}

}  // namespace ridgeline::bench
