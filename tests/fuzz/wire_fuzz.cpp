// Any values in the types of the IDL: requests as a service takes them, replies as a client does.

#include <algorithm>
#include <deque>
#include <vector>

#include "service/chunks.hpp"
#include "service/job_kind.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ridgeline;
using fuzz::Input;

/// The texts that a sample points to.
class Texts {
public:
  char* take(Input& input) { return wire::borrowed(texts_.emplace_back(input.text())); }

private:
  std::deque<std::string> texts_;
};

/// Cyclone DDS drops a sample with an enumerator beyond the last.
template <class T>
T up_to(T last, Input& input) {
  return static_cast<T>(input.number<std::uint8_t>() % (static_cast<unsigned>(last) + 1));
}

void fill(Input& input, Texts& texts, std::vector<double>& angles, ridgeline_wire_ChamferJob& job) {
  job.workpiece = texts.take(input);
  job.hole = texts.take(input);
  job.tool = texts.take(input);
  job.tool_axis = texts.take(input);
  job.dialect = texts.take(input);
  job.work_offset = texts.take(input);
  job.edge = up_to(ridgeline_wire_EDGE_OUTER, input);
  job.side = up_to(ridgeline_wire_SIDE_EXIT, input);
  job.width_kind = up_to(ridgeline_wire_WIDTH_FROM_CUTTING_AMOUNT, input);
  job.method = up_to(ridgeline_wire_METHOD_SECTION, input);
  job.direction = up_to(ridgeline_wire_DIRECTION_CONVENTIONAL, input);
  job.feed_at = up_to(ridgeline_wire_FEED_AT_CENTRE, input);
  job.positioning = up_to(ridgeline_wire_POSITIONING_INCREMENTAL, input);
  job.control_point = up_to(ridgeline_wire_CONTROL_CENTRE, input);
  job.given = input.number<std::uint32_t>();
  job.points = input.number<std::uint32_t>();
  job.passes = input.number<std::uint32_t>();
  job.program = input.number<std::int32_t>();
  job.decimals = input.number<std::int32_t>();
  for (double* number : {&job.width, &job.tolerance, &job.start_angle, &job.overlap, &job.feed,
                         &job.spindle_speed, &job.clearance})
    *number = input.number<double>();
  for (double& each : job.tool_axis_vector) each = input.number<double>();
  for (double& each : job.end_position) each = input.number<double>();
  angles.resize(input.number<std::uint8_t>() % 16);
  for (double& each : angles) each = input.number<double>();
  job.section_angle._buffer = angles.data();
  job.section_angle._length = job.section_angle._maximum =
      static_cast<std::uint32_t>(angles.size());
}

void take_request(Input& input) {
  Texts texts;
  std::vector<double> angles;
  ridgeline_wire_Request sample{};
  sample.timeout = input.number<double>();
  sample.header.requestId = wire::identity({{}, input.number<std::uint64_t>()});
  wire::copy(input.text(), sample.client);
  wire::copy(input.text(), sample.format);
  sample.call._d = up_to(ridgeline_wire_OPERATION_ECHO, input);
  if (sample.call._d == ridgeline_wire_OPERATION_CHAMFER)
    fill(input, texts, angles, sample.call._u.chamfer);
  else
    sample.call._u.job = texts.take(input);
  const wire::Request request = wire::request(sample);
  if (request.unusable && request.unusable->code() == ErrorCode::Internal) __builtin_trap();
  service::asks_for_change(request.text);
}

/// Samples that claim to be of one answer.
void take_replies(Input& input) {
  constexpr std::uint32_t most = 1 << 16;  // a larger answer is only slower
  wire::Assembler assembler;
  try {
    while (!input.is_empty()) {
      Texts texts;
      std::deque<std::vector<double>> values;
      std::deque<std::vector<std::uint32_t>> shapes;
      ridgeline_wire_Reply sample{};
      sample.chunk_index = input.number<std::uint8_t>();
      sample.chunk_count = input.number<std::uint8_t>();
      sample.numbers = input.number<std::uint64_t>() % most;
      sample.document_bytes = input.number<std::uint16_t>();
      sample.text_bytes = input.number<std::uint16_t>();
      sample.document = texts.take(input);
      sample.text = texts.take(input);
      std::vector<ridgeline_wire_Piece> pieces(input.number<std::uint8_t>() % 4);
      for (ridgeline_wire_Piece& piece : pieces) {
        piece.pointer = texts.take(input);
        piece.offset = input.number<std::uint64_t>();
        auto& shape = shapes.emplace_back(input.number<std::uint8_t>() % 4);
        for (std::uint32_t& each : shape) each = input.number<std::uint32_t>();
        auto& numbers = values.emplace_back(input.number<std::uint8_t>() % 32);
        for (double& each : numbers) each = input.number<double>();
        piece.shape._buffer = shape.data();
        piece.shape._length = static_cast<std::uint32_t>(shape.size());
        piece.values._buffer = numbers.data();
        piece.values._length = static_cast<std::uint32_t>(numbers.size());
      }
      sample.arrays._buffer = pieces.data();
      sample.arrays._length = static_cast<std::uint32_t>(pieces.size());
      if (assembler.add(sample)) {
        jobs::to_json(assembler.finish());
        return;
      }
    }
  } catch (const Error&) {
    // Samples that do not fit together are an error of their own.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  Input input(bytes, size);
  if (input.number<std::uint8_t>() % 2 == 0)
    take_request(input);
  else
    take_replies(input);
  return 0;
}
