#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "idl/domain.hpp"
#include "service/counters.hpp"
#include "service/dispatch.hpp"
#include "service/library.hpp"
#include "service/replies.hpp"
#include "service/sharing.hpp"
#include "service/work.hpp"

namespace ridgeline::service {

struct ServerOptions {
  dds_domainid_t domain = 0;
  std::string instance;
  Work::Limits limits;
};

/// One instance of the service: takes requests in its own partition, answers them, says how it
/// stands.
class Server {
public:
  Server(const ServerOptions& options, Library& library);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Returns after stop(), when what was being computed is answered. Throws dds::Failure, and Error
  /// when another instance of the same name is there already.
  void run();
  /// From any thread: takes no more work. The second time what is being computed is cancelled.
  void stop();

private:
  /// Argument of the listener of a request reader.
  struct Inlet {
    Server* server;
    Channel channel;
  };
  static void on_requests(dds_entity_t reader, void* inlet) noexcept;
  void take_requests(dds_entity_t reader, Channel channel);
  dds::Entity request_reader(dds::Topic topic, Inlet& inlet);
  void take_cancels();
  void take_clients();
  void look_for_namesake();
  void announce();
  wire::InstanceStatus status() const;
  void tick();

  std::shared_ptr<const dds::Domain> domain_;
  dds::Entity participant_;
  std::string instance_;
  std::int64_t started_;
  Library& library_;
  Counters counters_;
  Sharing sharing_;
  Dispatch dispatch_;
  Replies replies_;
  Work work_;
  std::atomic<int> stops_ = 0;
  Clock::time_point next_trim_;

  dds::Entity subscriber_;  ///< in the partition of the instance
  dds::Entity instance_topic_;
  dds::Entity announcer_;
  dds::Entity instance_reader_;
  dds::Entity client_reader_;  ///< built-in topic: readers anywhere
  dds::Entity cancel_reader_;
  dds::Entity stop_;
  dds::Entity waitset_;
  Inlet compute_{this, Channel::Compute};
  Inlet change_{this, Channel::Change};
  dds::Entity request_reader_;
  dds::Entity change_reader_;
};

}  // namespace ridgeline::service
