#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "clients/client.hpp"
#include "clients/instances.hpp"
#include "idl/domain.hpp"
#include "service/chunks.hpp"

namespace ridgeline::client {

using Clock = std::chrono::steady_clock;
using Call = std::variant<wire::Call, const ridgeline_wire_ChamferJob*>;

/// Entities, instances and requests under way of one client.
class Client::Session {
public:
  explicit Session(const Options& options);
  ~Session();

  jobs::Answer ask(const Call& call, Channel channel, const std::string& format,
                   const Patience& patience);
  std::vector<wire::InstanceStatus> status(std::chrono::milliseconds wait);

private:
  /// A request under way. Under mutex_.
  struct Pending {
    wire::RequestId id;
    std::map<std::pair<dds_instance_handle_t, std::uint64_t>, wire::Assembler> answers;
    std::optional<wire::Assembler> complete;
    std::optional<Error> broken;
    std::optional<ProgressReport> progress;
    Clock::time_point heard;
    std::shared_ptr<Instance> instance;  ///< that has it
    std::optional<jobs::Answer> busy;    ///< the last refusal for want of room
    std::condition_variable changed;     ///< any of this, or an instance
  };
  using Lock = std::unique_lock<std::mutex>;

  static void on_replies(dds_entity_t reader, void* session) noexcept;
  static void on_progress(dds_entity_t reader, void* session) noexcept;
  void take_reply(const ridgeline_wire_Reply& sample, const dds_sample_info_t& info);
  void open();
  dds::Entity reader(dds::Topic topic, dds_on_data_available_fn on_data);
  void watch();
  void take_instances();
  void bury();
  void notify_all();

  jobs::Answer wait(Lock& lock, Pending& pending, const Call& call, Channel channel,
                    const std::string& format, const Patience& patience);
  std::optional<jobs::Answer> taken(Lock& lock, Pending& pending);
  std::shared_ptr<Instance> least_loaded(Lock& lock, Channel channel);
  bool has_live() const;
  void send(Lock& lock, Pending& pending, const std::shared_ptr<Instance>& to, const Call& call,
            Channel channel, const std::string& format, const Patience& patience);
  void release(Pending& pending);
  jobs::Answer cancelled(Lock& lock, Pending& pending);
  Error absent(const Pending& pending) const;

  Options options_;
  std::shared_ptr<const dds::Domain> domain_;
  dds::Entity participant_;
  std::string name_;

  std::mutex mutex_;               ///< all up to the entities, and the pending requests
  std::condition_variable found_;  ///< an instance
  std::unordered_map<wire::RequestId, std::shared_ptr<Pending>, wire::RequestIdHash> pending_;
  std::map<std::string, std::shared_ptr<Instance>> instances_;
  std::vector<std::shared_ptr<Instance>> gone_;  ///< until no request uses them
  wire::RequestId id_;                           ///< of the last request
  Clock::time_point last_live_;
  bool has_seen_any_ = false;

  dds::Entity instance_reader_;
  std::once_flag opened_;  ///< the next three
  dds::Entity subscriber_;
  dds::Entity reply_reader_;
  dds::Entity progress_reader_;
  dds::Entity stop_;
  dds::Entity waitset_;
  std::thread watcher_;
};

}  // namespace ridgeline::client
