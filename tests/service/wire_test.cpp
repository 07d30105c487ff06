#include "service/wire.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "service/chunks.hpp"
#include "service/counters.hpp"
#include "service/job_kind.hpp"
#include "tests/support/typed_chamfer.hpp"

namespace ridgeline::wire {
namespace {

using Json = nlohmann::json;

RequestId some_id() {
  RequestId id;
  for (std::size_t i = 0; i < 16; ++i) id.writer[i] = static_cast<std::uint8_t>(i * 17);
  id.number = 0x1234567890abcdef;
  return id;
}

TEST(RequestId, SurvivesTheWire) {
  EXPECT_EQ(request_id(identity(some_id())), some_id());
  EXPECT_EQ(text(some_id()), "00112233445566778899aabbccddeeff.1311768467294899695");
}

/// All samples of an answer, given in an order of the test's choice.
jobs::Answer passed(const Chunks& chunks, const std::vector<std::uint32_t>& order) {
  Assembler assembler;
  int completed = 0;
  for (const std::uint32_t index : order)
    chunks.with_sample(index, some_id(), "north", [&](const ridgeline_wire_Reply& sample) {
      EXPECT_EQ(request_id(sample.header.relatedRequestId), some_id());
      EXPECT_EQ(sample.chunk_count, chunks.count());
      std::size_t bytes =
          std::string_view(sample.document).size() + std::string_view(sample.text).size();
      for (std::uint32_t i = 0; i < sample.arrays._length; ++i)
        bytes += sample.arrays._buffer[i].values._length * sizeof(double);
      EXPECT_LE(bytes, chunk_bytes);
      completed += assembler.add(sample) ? 1 : 0;
    });
  EXPECT_EQ(completed, 1);
  return assembler.finish();
}

std::vector<std::uint32_t> in_order(const Chunks& chunks) {
  std::vector<std::uint32_t> order(chunks.count());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  return order;
}

jobs::Answer answer_of(std::size_t points, std::size_t text, std::size_t words) {
  jobs::Answer answer;
  answer.document = {{"job", "chamfer"}, {"status", "ok"}, {"words", Json::array()}};
  for (std::size_t i = 0; i < words; ++i) answer.document["words"].push_back("w\u00f6rd");
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const char* pointer : {"/parameter", "/centres", "/empty"}) {
    const std::size_t columns = pointer == std::string("/parameter") ? 1 : 3;
    const std::size_t rows = pointer == std::string("/empty") ? 0 : points;
    jobs::Array array{pointer, {rows, columns}, {}};
    for (std::size_t i = 0; i < rows * columns; ++i) array.values.push_back(normal(random));
    answer.arrays.push_back(std::move(array));
  }
  for (std::size_t i = 0; i < text; ++i) answer.text += static_cast<char>('a' + i % 26);
  return answer;
}

struct Size {
  const char* name;
  std::size_t points, text, words;
  std::uint32_t chunks;  ///< at least
};
void PrintTo(const Size& size, std::ostream* out) {
  *out << size.name;
}
class AnswerOfSize : public testing::TestWithParam<Size> {};

TEST_P(AnswerOfSize, ComesWholeInAnyOrderAndTwice) {
  const Size& size = GetParam();
  const jobs::Answer answer = answer_of(size.points, size.text, size.words);
  const Chunks chunks(answer, 3);
  EXPECT_GE(chunks.count(), size.chunks);
  std::vector<std::uint32_t> order = in_order(chunks);
  for (int round = 0; round < 3; ++round) {
    const jobs::Answer back = passed(chunks, order);
    EXPECT_EQ(back.document, answer.document);
    EXPECT_TRUE(back.text == answer.text);
    ASSERT_EQ(back.arrays.size(), answer.arrays.size());
    for (const jobs::Array& array : back.arrays) {
      const auto same = std::ranges::find(answer.arrays, array.pointer, &jobs::Array::pointer);
      ASSERT_NE(same, answer.arrays.end());
      EXPECT_EQ(array.shape, same->shape);
      EXPECT_TRUE(array.values == same->values);
    }
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    order.insert(order.begin(), order.front());  // twice
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, AnswerOfSize,
                         testing::Values(Size{"small", 3, 10, 2, 1}, Size{"nothing", 0, 0, 0, 1},
                                         Size{"exactly one chunk", chunk_bytes / 8, 0, 0, 2},
                                         Size{"many numbers", 100'000, 0, 0, 16},
                                         Size{"long text", 0, 1'000'000, 0, 5},
                                         Size{"long document", 0, 0, 200'000, 7},
                                         Size{"all", 30'000, 500'000, 100'000, 10}));

TEST(Chunks, KeepNumbersThatAreNoNumbers) {
  jobs::Answer answer;
  answer.document = {{"status", "ok"}};
  answer.arrays.push_back({"/x", {3}, {std::nan(""), INFINITY, -0.0}});
  const Chunks chunks(answer, 1);
  const jobs::Answer back = passed(chunks, {0});
  EXPECT_TRUE(std::isnan(back.arrays[0].values[0]));
  EXPECT_EQ(back.arrays[0].values[1], INFINITY);
  EXPECT_TRUE(std::signbit(back.arrays[0].values[2]));
}

TEST(Chunks, AnErrorIsReadableWithoutJson) {
  const Chunks chunks(jobs::refusal({ErrorCode::WidthTooLarge,
                                     "too wide",
                                     {.field = "/width",
                                      .value = "9",
                                      .limit = "at most 5 mm",
                                      .parameter = {},
                                      .target = {}}}),
                      1);
  EXPECT_EQ(chunks.code(), "width_too_large");
  chunks.with_sample(0, some_id(), "north", [](const ridgeline_wire_Reply& sample) {
    EXPECT_EQ(sample.status, ridgeline_wire_STATUS_ERROR);
    EXPECT_EQ(sample.error.number, static_cast<int>(ErrorCode::WidthTooLarge));
    EXPECT_STREQ(sample.error.field, "/width");
    EXPECT_STREQ(sample.error.limit, "at most 5 mm");
  });
}

template <class F>
void expect_refused(F&& change) {
  const Chunks chunks(answer_of(10, 10, 2), 1);
  chunks.with_sample(0, some_id(), "north", [&](const ridgeline_wire_Reply& sample) {
    ridgeline_wire_Reply other = sample;
    std::vector<ridgeline_wire_Piece> pieces(sample.arrays._buffer,
                                             sample.arrays._buffer + sample.arrays._length);
    other.arrays._buffer = pieces.data();
    change(other);
    EXPECT_THROW(
        {
          Assembler assembler;
          if (assembler.add(other)) assembler.finish();
        },
        Error);
  });
}

TEST(Assembler, RefusesSamplesThatDoNotFit) {
  expect_refused([](ridgeline_wire_Reply& sample) { sample.chunk_count = 0; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.chunk_count = 0xffffffff; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.chunk_index = 1; });
  expect_refused([](ridgeline_wire_Reply& sample) { --sample.document_bytes; });
  expect_refused([](ridgeline_wire_Reply& sample) { ++sample.text_bytes; });
  expect_refused([](ridgeline_wire_Reply& sample) { ++sample.numbers; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.numbers = ~0ULL; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.arrays._length = 0; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.arrays._buffer[1].offset = 29; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.arrays._buffer[1].offset = ~0ULL; });
  expect_refused([](ridgeline_wire_Reply& sample) { sample.arrays._buffer[0].shape._length = 0; });
  const std::string broken = "{]";
  expect_refused([&](ridgeline_wire_Reply& sample) { sample.document = borrowed(broken); });
}

TEST(ChamferJob, AClearedStructAsksWithTheDefaults) {
  EXPECT_EQ(chamfer_job(typed_chamfer()), Json::parse(R"({
    "job": "chamfer", "workpiece": "tube-40", "hole": "H1", "tool": 12, "edge": "inner",
    "side": "entry", "width": 0.5, "method": "swept", "direction": "climb", "feed_at": "contact",
    "section_angle": "bisector",
    "output": {"positioning": "absolute", "control_point": "tip", "arcs": false}})"));
}

TEST(ChamferJob, EveryFieldArrives) {
  ridgeline_wire_ChamferJob c = typed_chamfer();
  char axis[] = "hole", dialect[] = "siemens", offset[] = "G55", tool[] = "lollipop 6";
  double angles[] = {0, 45, 90, 50};
  c.tool = tool;
  c.edge = ridgeline_wire_EDGE_OUTER;
  c.side = ridgeline_wire_SIDE_EXIT;
  c.width_kind = ridgeline_wire_WIDTH_FROM_CUTTING_AMOUNT;
  c.given = ~0U & ~static_cast<unsigned>(ridgeline_wire_GIVEN_TOOL_AXIS_VECTOR);
  c.method = ridgeline_wire_METHOD_SECTION;
  c.direction = ridgeline_wire_DIRECTION_CONVENTIONAL;
  c.feed_at = ridgeline_wire_FEED_AT_CENTRE;
  c.tolerance = 0.01;
  c.points = 90;
  c.section_angle = {4, 4, angles, false};
  c.tool_axis = axis;
  c.start_angle = 30;
  c.overlap = 6;
  c.passes = 2;
  c.feed = 200;
  c.spindle_speed = 6000;
  c.clearance = 12;
  c.end_position[0] = 1, c.end_position[1] = 2, c.end_position[2] = 3;
  c.program = 9101;
  c.dialect = dialect;
  c.positioning = ridgeline_wire_POSITIONING_INCREMENTAL;
  c.arcs = true;
  c.decimals = 3;
  c.work_offset = offset;
  c.control_point = ridgeline_wire_CONTROL_CENTRE;
  EXPECT_EQ(chamfer_job(c), Json::parse(R"({
    "job": "chamfer", "workpiece": "tube-40", "hole": "H1", "tool": "lollipop 6", "edge": "outer",
    "side": "exit", "cutting_amount": 0.5, "method": "section", "direction": "conventional",
    "feed_at": "centre", "section_angle": [[0, 45], [90, 50]], "tolerance": 0.01, "points": 90,
    "start_angle": 30, "overlap": 6, "passes": 2, "feed": 200, "spindle_speed": 6000,
    "clearance": 12, "end_position": [1, 2, 3], "tool_axis": "hole",
    "output": {"program": 9101, "dialect": "siemens", "positioning": "incremental", "arcs": true,
               "decimals": 3, "work_offset": "G55", "control_point": "centre"}})"));
  c.given = ridgeline_wire_GIVEN_TOOL_AXIS_VECTOR;
  c.tool_axis_vector[2] = -1;
  c.section_angle._length = 1;
  EXPECT_EQ(chamfer_job(c).at("tool_axis"), Json::parse("[0, 0, -1]"));
  EXPECT_EQ(chamfer_job(c).at("section_angle"), 0);
}

template <class F>
std::string refused_field(F&& change) {
  ridgeline_wire_ChamferJob c = typed_chamfer();
  change(c);
  try {
    chamfer_job(c);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    return error.details().field;
  }
  return "accepted";
}

TEST(ChamferJob, RefusesNumbersThatAreNone) {
  double angles[] = {0, 45, std::nan("")};
  EXPECT_EQ(refused_field([](auto& c) { c.width = std::nan(""); }), "/width");
  EXPECT_EQ(refused_field([](auto& c) { c.width = INFINITY; }), "/width");
  EXPECT_EQ(refused_field([](auto& c) {
              c.given = ridgeline_wire_GIVEN_FEED;
              c.feed = -INFINITY;
            }),
            "/feed");
  EXPECT_EQ(refused_field([&](auto& c) {
              c.section_angle = {3, 3, angles, false};
            }),
            "/section_angle");
  EXPECT_EQ(refused_field([&](auto& c) { c.section_angle = {2, 2, angles, false}; }), "accepted");
}

TEST(JobKind, IsReadWithoutTheRest) {
  EXPECT_EQ(service::job_kind(R"({"job": "library", )"), "library");
  EXPECT_EQ(service::job_kind(R"({"a": {"job": "x"}, "b": [{"job": "y"}], "job": "z"})"), "z");
  EXPECT_EQ(service::job_kind(R"({"job": {"job": "x"}})"), "");
  EXPECT_EQ(service::job_kind(R"(["job", "x"])"), "");
  EXPECT_EQ(service::job_kind("nonsense"), "");
  EXPECT_TRUE(service::asks_for_change(R"({"job": "library", "operation": "put"})"));
  EXPECT_FALSE(service::asks_for_change(R"({"job": "library", "operation": "get"})"));
  EXPECT_FALSE(service::asks_for_change(R"({"job": "chamfer", "operation": "put"})"));
  EXPECT_TRUE(service::asks_for_change(R"({"operation": "log_level", "job": "service"})"));
}

TEST(Latencies, QuantilesAreWithinTheirClass) {
  service::Latencies latencies;
  EXPECT_EQ(latencies.quantile(0.5), 0);
  for (int i = 1; i <= 1000; ++i) latencies.add(i * 1e-4);
  EXPECT_NEAR(latencies.quantile(0.5), 0.05, 0.05 * 0.051);
  EXPECT_NEAR(latencies.quantile(0.99), 0.099, 0.099 * 0.051);
  EXPECT_EQ(latencies.quantile(1), 0.1);
  EXPECT_EQ(latencies.max(), 0.1);
  latencies.add(1e9);
  latencies.add(0);
  EXPECT_EQ(latencies.max(), 1e9);
}

}  // namespace
}  // namespace ridgeline::wire
