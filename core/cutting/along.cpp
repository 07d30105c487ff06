#include "core/cutting/along.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace ridgeline::cutting {
namespace {

// What all parts of a path share.
struct Path {
  const Course& course;
  const std::vector<Station>& stations;
  const Compliance& compliance;
  double S;
  const AlongOptions& options;
  const Progress& progress;
};

// Runs work(follower, index of a station) over all stations in parts of a fixed length, each begun
// cold, so that the result does not depend on the threads.
template <typename Work>
void in_parts(const Path& path, const Work& work) {
  const std::size_t count = path.stations.size();
  const auto part = static_cast<std::size_t>(std::max(path.options.part, 1));
  const std::size_t parts = (count + part - 1) / part;
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> stop{false};
  std::exception_ptr failure;
  std::mutex failing;
  const auto follow = [&](bool reports) {
    try {
      for (std::size_t p = next++; p < parts && !stop; p = next++) {
        Follower follower(path.course, path.compliance, path.S, path.options);
        for (std::size_t i = p * part; i < std::min((p + 1) * part, count) && !stop; ++i) {
          if (reports) {
            path.progress.at(static_cast<double>(done) / static_cast<double>(count), "predict");
          }
          work(follower, i);
          ++done;
        }
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int t = 1; t < path.options.threads && static_cast<std::size_t>(t) < parts; ++t) {
      helpers.emplace_back(follow, false);
    }
    follow(true);
  }
  if (failure) std::rethrow_exception(failure);
}

// Is the station one of those whose stability is tested?
bool is_tested(const AlongOptions& options, std::size_t i) {
  return options.stability != StabilityTest::None &&
         i % static_cast<std::size_t>(std::max(options.stability_every, 1)) == 0;
}

}  // namespace

std::vector<StationError> along(const Course& course, const std::vector<Station>& stations,
                                const Compliance& compliance, double S, const AlongOptions& options,
                                const Progress& progress) {
  std::vector<StationError> out(stations.size());
  in_parts({course, stations, compliance, S, options, progress},
           [&](Follower& follower, std::size_t i) {
             out[i] = follower.at(stations[i]);
             if (is_tested(options, i)) follower.test(stations[i], out[i]);
           });
  return out;
}

std::vector<StationError> corrected(const Course& course, const std::vector<Station>& stations,
                                    const Compliance& compliance, double S,
                                    const AlongOptions& options, const CorrectOptions& limits,
                                    const Progress& progress) {
  std::vector<StationError> out(stations.size());
  in_parts({course, stations, compliance, S, options, progress},
           [&](Follower& follower, std::size_t i) {
             out[i] = follower.corrected_at(stations[i], limits);
             if (is_tested(options, i)) follower.test(stations[i], out[i]);
           });
  return out;
}

}  // namespace ridgeline::cutting
