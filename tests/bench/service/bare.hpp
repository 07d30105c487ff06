#pragma once

#include <memory>
#include <string>

#include "idl/domain.hpp"
#include "idl/topics.hpp"
#include "service/wire.hpp"

namespace ridgeline::bench {

/// The least that can answer on the topics of the service: one thread that takes a request and
/// writes its echo, or N bytes of numbers for the text "bulk N". Announces itself as "bare".
/// Returns when it is killed.
void answer_bare(unsigned domain);

/// The one client that "bare" answers: its writer is there before the first request.
inline constexpr char bare_client[] = "bench";

/// A requester of the plain topics, one request at a time.
class Requester {
public:
  Requester(unsigned domain, const std::string& instance, std::string client);

  /// Sends the request `number` and waits until all chunks of its answer are here. Returns their
  /// bytes.
  std::size_t ask(std::uint64_t number, const std::string& text, wire::CallKind kind);

private:
  std::string client_;
  std::shared_ptr<const dds::Domain> domain_;
  dds::Entity participant_, subscriber_, publisher_, reader_, writer_, condition_, waitset_;
};

/// Seconds to send `bytes` to another thread over a TCP connection on the loopback, in chunks, and
/// to hear that they are there.
double tcp_seconds(std::size_t bytes);

}  // namespace ridgeline::bench
