#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "ridgeline.h"
#include "service/instance_status.hpp"

/// Between the IDL types and plain values: the only place that knows both, used by both ends.
namespace ridgeline::wire {

/// Names a request for as long as it lives, also when it is sent again or elsewhere.
struct RequestId {
  std::array<std::uint8_t, 16> writer{};  ///< GUID of an entity of the client
  std::uint64_t number = 0;               ///< the client's own count

  auto operator<=>(const RequestId&) const = default;
};

struct RequestIdHash {
  std::size_t operator()(const RequestId& id) const noexcept;
};

/// 32 hexadecimal digits, a dot and the number: what log lines and the library show.
std::string text(const RequestId& id);
RequestId request_id(const dds_SampleIdentity& identity);
dds_SampleIdentity identity(const RequestId& id);

/// The participant that a GUID belongs to: its first 12 bytes.
using Participant = std::array<std::uint8_t, 12>;
Participant participant_of(const RequestId& id);
Participant participant_of(const std::uint8_t (&guid)[16]);

enum class CallKind { Job, Chamfer, Echo };

/// A request as it was taken, with the typed chamfer as the JSON job that it stands for.
struct Request {
  RequestId id;
  std::string client;
  std::string format;
  double timeout = 0;  ///< [s]
  CallKind kind = CallKind::Job;
  std::string text;               ///< job document, or what to echo
  std::optional<Error> unusable;  ///< why it cannot be run at all
};

Request request(const ridgeline_wire_Request& sample);

/// The job document of a typed chamfer. Throws Error{BadInput} for numbers that are not finite and
/// enumerators that are not known.
nlohmann::json chamfer_job(const ridgeline_wire_ChamferJob& chamfer);

/// What a request asks, borrowed: write the sample while the arguments live.
struct Sent {
  const RequestId& id;
  const std::string& instance;
  const std::string& client;
  const std::string& format;
  double timeout = 0;  ///< [s]
};
using Call = std::pair<CallKind, const char*>;  ///< Job or Echo and its text
ridgeline_wire_Request borrow(const Sent& sent, const Call& call);
ridgeline_wire_Request borrow(const Sent& sent, const ridgeline_wire_ChamferJob& chamfer);

InstanceStatus instance_status(const ridgeline_wire_Instance& sample);

/// Calls write(const ridgeline_wire_Instance&) with a sample that borrows from `status`.
void with_sample(const InstanceStatus& status,
                 const std::function<void(const ridgeline_wire_Instance&)>& write);

/// Copies text into a bounded string of the IDL, cut to what it holds.
template <std::size_t N>
void copy(std::string_view text, char (&bounded)[N]) {
  const std::size_t length = std::min(text.size(), N - 1);
  text.copy(bounded, length);
  bounded[length] = '\0';
}

/// For members that C declares as char* and that are only read.
inline char* borrowed(const std::string& text) {
  return const_cast<char*>(text.c_str());
}
char* borrowed(std::string&& text) = delete;  ///< would be gone before the sample is written

}  // namespace ridgeline::wire
