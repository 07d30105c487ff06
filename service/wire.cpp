#include "service/wire.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "jobs/refuse.hpp"
#include "jobs/text.hpp"

namespace ridgeline::wire {
namespace {

using Json = nlohmann::json;

double finite(double value, const char* field) {
  if (!std::isfinite(value)) {
    jobs::refuse({.code = ErrorCode::BadInput,
                  .field = field,
                  .value = fmt::format("{}", value),
                  .limit = "a finite number",
                  .message = {}});
  }
  return value;
}

Json finite3(const double (&values)[3], const char* field) {
  return {finite(values[0], field), finite(values[1], field), finite(values[2], field)};
}

/// The name of an enumerator; the first is 0.
template <std::size_t N, class E>
const char* name_of(const char* const (&names)[N], E value, const char* field) {
  const auto index = static_cast<std::size_t>(value);
  if (index >= N) {
    jobs::refuse({.code = ErrorCode::BadInput,
                  .field = field,
                  .value = std::to_string(static_cast<long>(value)),
                  .limit = fmt::format("an enumerator from 0 to {}", N - 1),
                  .message = {}});
  }
  return names[index];
}

Json section_angle(const dds_sequence_double& angles) {
  if (angles._length == 0) return "bisector";
  for (std::uint32_t i = 0; i < angles._length; ++i) finite(angles._buffer[i], "/section_angle");
  if (angles._length == 1) return angles._buffer[0];
  if (angles._length % 2 != 0) {
    jobs::refuse({.code = ErrorCode::BadInput,
                  .field = "/section_angle",
                  .value = fmt::format("{} numbers", angles._length),
                  .limit = "none, one angle, or pairs of phi and angle",
                  .message = {}});
  }
  Json table = Json::array();
  for (std::uint32_t i = 0; i < angles._length; i += 2) {
    table.push_back({angles._buffer[i], angles._buffer[i + 1]});
  }
  return table;
}

Json output(const ridgeline_wire_ChamferJob& c) {
  Json output = Json::object();
  if ((c.given & ridgeline_wire_GIVEN_PROGRAM) != 0) output["program"] = c.program;
  if ((c.given & ridgeline_wire_GIVEN_DECIMALS) != 0) output["decimals"] = c.decimals;
  if (*c.dialect != '\0') output["dialect"] = jobs::valid_utf8(c.dialect);
  if (*c.work_offset != '\0') output["work_offset"] = jobs::valid_utf8(c.work_offset);
  output["positioning"] =
      name_of({"absolute", "incremental"}, c.positioning, "/output/positioning");
  output["control_point"] = name_of({"tip", "centre"}, c.control_point, "/output/control_point");
  output["arcs"] = c.arcs;
  return output;
}

}  // namespace

std::size_t RequestIdHash::operator()(const RequestId& id) const noexcept {
  std::uint64_t words[2];
  std::memcpy(words, id.writer.data(), sizeof words);
  std::uint64_t hash = words[0] * 0x9e3779b97f4a7c15 ^ words[1];
  hash = (hash ^ id.number) * 0xff51afd7ed558ccd;
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

std::string text(const RequestId& id) {
  std::string text;
  for (const std::uint8_t byte : id.writer) text += fmt::format("{:02x}", byte);
  return text + '.' + std::to_string(id.number);
}

RequestId request_id(const dds_SampleIdentity& identity) {
  RequestId id;
  const dds_GUID_t& guid = identity.writer_guid;
  std::copy_n(guid.guidPrefix, 12, id.writer.begin());
  std::copy_n(guid.entityId.entityKey, 3, id.writer.begin() + 12);
  id.writer[15] = guid.entityId.entityKind;
  id.number = static_cast<std::uint64_t>(static_cast<std::uint32_t>(identity.sequence_number.high))
                  << 32 |
              identity.sequence_number.low;
  return id;
}

dds_SampleIdentity identity(const RequestId& id) {
  dds_SampleIdentity identity{};
  dds_GUID_t& guid = identity.writer_guid;
  std::copy_n(id.writer.begin(), 12, guid.guidPrefix);
  std::copy_n(id.writer.begin() + 12, 3, guid.entityId.entityKey);
  guid.entityId.entityKind = id.writer[15];
  identity.sequence_number.high = static_cast<std::int32_t>(id.number >> 32);
  identity.sequence_number.low = static_cast<std::uint32_t>(id.number);
  return identity;
}

Participant participant_of(const RequestId& id) {
  Participant participant;
  std::copy_n(id.writer.begin(), participant.size(), participant.begin());
  return participant;
}

Participant participant_of(const std::uint8_t (&guid)[16]) {
  Participant participant;
  std::copy_n(guid, participant.size(), participant.begin());
  return participant;
}

Json chamfer_job(const ridgeline_wire_ChamferJob& c) {
  const auto is_given = [&c](std::uint32_t bit) { return (c.given & bit) != 0; };
  Json job = {{"job", "chamfer"},
              {"workpiece", jobs::valid_utf8(c.workpiece)},
              {"hole", jobs::valid_utf8(c.hole)},
              {"tool", jobs::valid_utf8(c.tool)},
              {"edge", name_of({"inner", "outer"}, c.edge, "/edge")},
              {"side", name_of({"entry", "exit"}, c.side, "/side")},
              {"method", name_of({"swept", "section"}, c.method, "/method")},
              {"direction", name_of({"climb", "conventional"}, c.direction, "/direction")},
              {"feed_at", name_of({"contact", "centre"}, c.feed_at, "/feed_at")},
              {"section_angle", section_angle(c.section_angle)},
              {"output", output(c)}};
  const std::string_view tool = c.tool;
  if (!tool.empty() && tool.size() <= 9 && tool.find_first_not_of("0123456789") == tool.npos) {
    job["tool"] = std::stoi(c.tool);
  }
  job[name_of({"width", "cutting_amount"}, c.width_kind, "/width_kind")] =
      finite(c.width, "/width");
  if (is_given(ridgeline_wire_GIVEN_TOLERANCE)) {
    job["tolerance"] = finite(c.tolerance, "/tolerance");
  }
  if (is_given(ridgeline_wire_GIVEN_POINTS)) job["points"] = c.points;
  if (is_given(ridgeline_wire_GIVEN_START_ANGLE)) {
    job["start_angle"] = finite(c.start_angle, "/start_angle");
  }
  if (is_given(ridgeline_wire_GIVEN_OVERLAP)) job["overlap"] = finite(c.overlap, "/overlap");
  if (is_given(ridgeline_wire_GIVEN_PASSES)) job["passes"] = c.passes;
  if (is_given(ridgeline_wire_GIVEN_FEED)) job["feed"] = finite(c.feed, "/feed");
  if (is_given(ridgeline_wire_GIVEN_SPINDLE_SPEED)) {
    job["spindle_speed"] = finite(c.spindle_speed, "/spindle_speed");
  }
  if (is_given(ridgeline_wire_GIVEN_CLEARANCE)) {
    job["clearance"] = finite(c.clearance, "/clearance");
  }
  if (is_given(ridgeline_wire_GIVEN_END_POSITION)) {
    job["end_position"] = finite3(c.end_position, "/end_position");
  }
  if (is_given(ridgeline_wire_GIVEN_TOOL_AXIS_VECTOR)) {
    job["tool_axis"] = finite3(c.tool_axis_vector, "/tool_axis");
  } else if (*c.tool_axis != '\0') {
    job["tool_axis"] = jobs::valid_utf8(c.tool_axis);
  }
  return job;
}

Request request(const ridgeline_wire_Request& sample) {
  Request request{.id = request_id(sample.header.requestId),
                  .client = sample.client,
                  .format = sample.format[0] == '\0' ? "json" : sample.format,
                  .timeout = sample.timeout,
                  .kind = CallKind::Job,
                  .text = {},
                  .unusable = {}};
  try {
    switch (sample.call._d) {
      case ridgeline_wire_OPERATION_JOB: request.text = sample.call._u.job; break;
      case ridgeline_wire_OPERATION_CHAMFER:
        request.kind = CallKind::Chamfer;
        request.text = chamfer_job(sample.call._u.chamfer).dump();
        break;
      case ridgeline_wire_OPERATION_ECHO:
        request.kind = CallKind::Echo;
        request.text = sample.call._u.echo;
        break;
    }
    if (!(request.timeout > 0 && request.timeout < 1e7)) {
      jobs::refuse({.code = ErrorCode::BadInput,
                    .field = "timeout",
                    .value = fmt::format("{}", sample.timeout),
                    .limit = "greater than 0 and less than 1e7 s",
                    .message = {}});
    }
  } catch (const Error& error) {
    request.unusable = error;
  }
  return request;
}

namespace {

ridgeline_wire_Request header(const Sent& sent) {
  ridgeline_wire_Request sample{};
  sample.header.requestId = identity(sent.id);
  copy(sent.instance, sample.header.instanceName);
  copy(sent.client, sample.client);
  copy(sent.format, sample.format);
  sample.timeout = sent.timeout;
  return sample;
}

}  // namespace

ridgeline_wire_Request borrow(const Sent& sent, const Call& call) {
  ridgeline_wire_Request sample = header(sent);
  char* const text = const_cast<char*>(call.second);
  if (call.first == CallKind::Echo) {
    sample.call._d = ridgeline_wire_OPERATION_ECHO;
    sample.call._u.echo = text;
  } else {
    sample.call._d = ridgeline_wire_OPERATION_JOB;
    sample.call._u.job = text;
  }
  return sample;
}

ridgeline_wire_Request borrow(const Sent& sent, const ridgeline_wire_ChamferJob& chamfer) {
  ridgeline_wire_Request sample = header(sent);
  sample.call._d = ridgeline_wire_OPERATION_CHAMFER;
  sample.call._u.chamfer = chamfer;
  return sample;
}

}  // namespace ridgeline::wire
