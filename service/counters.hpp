#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "service/wire.hpp"

namespace ridgeline::service {

/// How long requests took, in classes of 5 % from 1 us to over an hour: bounded memory.
class Latencies {
public:
  void add(double seconds);
  /// Upper end of the class that holds the quantile; 0 without any.
  double quantile(double q) const;
  double max() const noexcept { return max_; }

private:
  static constexpr double first = 1e-6, ratio = 1.05;
  std::array<std::uint64_t, 460> classes_{};
  std::uint64_t count_ = 0;
  double max_ = 0;
};

/// What an instance did since its start. From any thread.
class Counters {
public:
  void taken();
  void duplicate();
  void undelivered();
  void answered(const std::string& code, double seconds, std::size_t bytes);
  /// Fills the counters of a status.
  void report(wire::InstanceStatus& status) const;

private:
  mutable std::mutex mutex_;
  std::uint64_t requests_ = 0, duplicates_ = 0, undelivered_ = 0, bytes_ = 0;
  std::map<std::string, std::uint64_t> answers_;
  Latencies latencies_;
};

}  // namespace ridgeline::service
