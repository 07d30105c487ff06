#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "idl/topics.hpp"
#include "service/wire.hpp"

namespace ridgeline::client {

enum class Channel { Compute, Change };

/// One run of an instance, as a client sees it, with the writers into its partition. They are made
/// when they are first needed: who only looks at the status need not be allowed to write.
class Instance {
public:
  Instance(const dds::Entity& participant, wire::InstanceStatus first)
      : name(first.name), status(std::move(first)), participant_(participant) {}

  /// Can a request leave and its reply come back: is each end matched with the other's?
  bool is_ready(Channel channel, const dds::Entity& reply_reader);
  /// Writes a request that is worth nothing after `life`. False: no room now, try again.
  bool write(Channel channel, const ridgeline_wire_Request& request,
             std::chrono::milliseconds life);
  void cancel(const wire::RequestId& id);

  const std::string name;  ///< as in `status`, but for those who do not hold the mutex

  // Under the mutex of the session:
  wire::InstanceStatus status;
  bool is_alive = true;
  int outstanding = 0;  ///< requests of this client that it has
  std::uint64_t sent = 0;
  std::chrono::steady_clock::time_point busy_until{};  ///< it said that its queue is full

private:
  struct Way {
    std::mutex mutex;
    dds::Entity writer;
    bool is_ready = false;
    std::chrono::milliseconds life{0};
  };
  void open(Way& way, Channel channel);
  Way& way(Channel channel);

  const dds::Entity& participant_;
  std::mutex mutex_;  ///< making the publisher and the writer of cancels
  dds::Entity publisher_;
  Way compute_, change_;
  dds::Entity cancel_writer_;
};

}  // namespace ridgeline::client
