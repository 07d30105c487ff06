#include "service/counters.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::service {

void Latencies::add(double seconds) {
  const double index = std::log(std::max(seconds, first) / first) / std::log(ratio);
  const auto last = static_cast<double>(classes_.size() - 1);
  ++classes_[static_cast<std::size_t>(std::min(index, last))];
  ++count_;
  max_ = std::max(max_, seconds);
}

double Latencies::quantile(double q) const {
  const double wanted = q * static_cast<double>(count_);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < classes_.size() && count_ > 0; ++i) {
    sum += classes_[i];
    if (static_cast<double>(sum) >= wanted && sum > 0) {
      return std::min(max_, first * std::pow(ratio, static_cast<double>(i + 1)));
    }
  }
  return max_;
}

void Counters::taken() {
  const std::scoped_lock lock(mutex_);
  ++requests_;
}

void Counters::duplicate() {
  const std::scoped_lock lock(mutex_);
  ++duplicates_;
}

void Counters::undelivered() {
  const std::scoped_lock lock(mutex_);
  ++undelivered_;
}

void Counters::answered(const std::string& code, double seconds, std::size_t bytes) {
  const std::scoped_lock lock(mutex_);
  ++answers_[code];
  bytes_ += bytes;
  latencies_.add(seconds);
}

void Counters::report(wire::InstanceStatus& status) const {
  const std::scoped_lock lock(mutex_);
  status.requests = requests_;
  status.duplicates = duplicates_;
  status.undelivered = undelivered_;
  status.bytes_sent = bytes_;
  const auto ok = answers_.find("ok");
  status.answers = {{"ok", ok == answers_.end() ? 0 : ok->second}};
  for (const auto& [code, count] : answers_) {
    if (code != "ok") status.answers.emplace_back(code, count);
  }
  status.latency_p50 = latencies_.quantile(0.5);
  status.latency_p99 = latencies_.quantile(0.99);
  status.latency_max = latencies_.max();
}

}  // namespace ridgeline::service
