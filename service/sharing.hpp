#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "idl/topics.hpp"
#include "service/library.hpp"

namespace ridgeline::service {

/// Shares the library with all other instances: publishes every change that the file holds, whoever
/// made it, and takes theirs. So each instance holds all, one that comes later gets all, and the
/// loss of any one loses nothing.
class Sharing {
public:
  Sharing(const dds::Entity& participant, Library& library);
  ~Sharing();
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;

  /// Publishes what is new in the file and waits a moment for the instances that are there now to
  /// have it.
  void publish();

  struct Summary {
    std::uint64_t changes = 0;
    std::uint64_t digest = 0;  ///< equal when two libraries hold the same changes
    std::uint64_t conflicts = 0;
  };
  Summary summary() const;

private:
  void run();
  void publish_new();
  bool take();
  void merge();

  Library& library_;
  dds::Entity topic_;
  dds::Entity writer_;
  dds::Entity reader_;
  dds::Entity stop_;
  dds::Entity data_;
  dds::Entity waitset_;
  std::vector<Change> taken_;  ///< not yet in the file; of the thread alone
  std::mutex publishing_;      ///< published_ and the order of writes
  std::int64_t published_ = 0;
  mutable std::mutex summary_mutex_;
  Summary summary_;
  std::thread thread_;
};

}  // namespace ridgeline::service
