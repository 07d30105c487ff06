#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "idl/topics.hpp"
#include "service/chunks.hpp"

namespace ridgeline::service {

using Clock = std::chrono::steady_clock;

enum class Delivery { Sent, Undelivered };

/// An answer on its way to the client that asked.
struct Outgoing {
  wire::RequestId id;
  std::string client;
  std::shared_ptr<const wire::Chunks> chunks;
  Clock::time_point give_up;           ///< when its client has been unreachable until then
  std::function<void(Delivery)> done;  ///< called once, from any thread
  std::uint32_t next_chunk = 0;
};

/// Sends answers. Each client has a publisher and writers in a partition of its own, so that no
/// client sees or delays the replies of another. No write blocks: what a client cannot take yet
/// waits in its queue, where its answers take turns chunk by chunk. An answer waits until a reader
/// of the participant that asked is matched.
class Replies {
public:
  Replies(const dds::Entity& participant, std::string instance);
  ~Replies();
  Replies(const Replies&) = delete;
  Replies& operator=(const Replies&) = delete;

  /// Makes the writers of a client before its first request comes.
  void open(const std::string& client);
  /// Sends at once if the client can take it, from the calling thread. Not from a listener.
  void send(Outgoing outgoing);
  /// Leaves it to the sender's thread.
  void post(Outgoing outgoing);
  void progress(const std::string& client, const ridgeline_wire_Progress& progress);

  /// Is a reader of that participant in the client's partition?
  bool reaches(const std::string& client, const wire::Participant& participant) const;
  /// Looks who is still there and closes what nobody has used for a while. Call it regularly.
  void refresh();
  /// Waits until everything is sent and acknowledged, up to `limit`.
  bool drain(std::chrono::milliseconds limit);
  std::size_t clients() const;

private:
  struct Link;
  using Links = std::map<std::string, std::shared_ptr<Link>>;

  std::shared_ptr<Link> link(const std::string& client);
  std::shared_ptr<Link> find(const std::string& client) const;
  void notify();
  void hand_over(Outgoing outgoing, bool at_once);
  enum class Step { Waits, Advanced, Finished, GaveUp };
  Step advance(Link& link, Outgoing& outgoing);
  bool turn(Link& link);
  bool turn_all();
  void run();

  const dds::Entity& participant_;
  std::string instance_;
  dds::Entity reply_topic_;
  dds::Entity progress_topic_;
  mutable std::mutex mutex_;  ///< links_, inbox_, stopping_
  std::condition_variable wake_;
  Links links_;
  std::deque<Outgoing> inbox_;
  bool stopping_ = false;
  std::thread sender_;
};

}  // namespace ridgeline::service
