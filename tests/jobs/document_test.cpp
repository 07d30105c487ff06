#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

Answer example() {
  const Json columns = Json::parse(R"({"columns": [
    {"key": "kind", "names": ["rapid", "cut"]}, {"key": "to", "size": 3}, {"key": "feed"},
    {"key": "arc", "columns": [{"key": "centre", "size": 2}, {"key": "sense", "names": ["cw", "ccw"]}]}]})");
  Answer answer;
  answer.document = {{"status", "ok"}, {"report", Json::object()}, {"moves", columns}};
  answer.arrays = {
      {"/parameter", {2}, {0, 0.5}},
      {"/centres", {2, 3}, {1, 2, 3, 4, 5, 0.1}},
      {"/report/along", {0}, {}},
      {"/moves", {2, 8}, {0, 1, 2, 3, absent, absent, absent, absent, 1, 4, 5, 6, 300, 7, 8, 1}}};
  return answer;
}

TEST(Document, ArraysStandAtTheirPointers) {
  EXPECT_EQ(assemble(example()), Json::parse(R"({
    "status": "ok", "report": {"along": []},
    "parameter": [0.0, 0.5], "centres": [[1.0, 2.0, 3.0], [4.0, 5.0, 0.1]],
    "moves": [{"kind": "rapid", "to": [1.0, 2.0, 3.0]},
              {"kind": "cut", "to": [4.0, 5.0, 6.0], "feed": 300.0,
               "arc": {"centre": [7.0, 8.0], "sense": "ccw"}}]})"));
}

TEST(Document, TextReadsBackAsTheAssembledDocument) {
  EXPECT_EQ(Json::parse(to_json(example())), assemble(example()));
}

TEST(Document, RandomNumbersReadBackTheSame) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-300, 300);
  Array array{"/values", {1000, 2}, {}};
  for (int i = 0; i < 2000; ++i) array.values.push_back(std::pow(10, exponent(random)));
  const Answer answer{Json::object(), {array}, {}};
  std::vector<double> read;
  const Json document = Json::parse(to_json(answer));
  for (const Json& row : document.at("values"))
    for (const Json& number : row) read.push_back(number.get<double>());
  EXPECT_EQ(read, array.values);
}

TEST(Document, ShapesThatDoNotFitAreInternalErrors) {
  Answer answer{Json::object(), {{"/a", {2, 3}, {1, 2}}}, {}};
  EXPECT_THROW(assemble(answer), Error);
  EXPECT_THROW(to_json(answer), Error);
  answer = example();
  answer.arrays[3].values[0] = 2;  // there are two names only
  EXPECT_THROW(assemble(answer), Error);
  EXPECT_THROW(to_json(answer), Error);
}

TEST(Document, ErrorObjectLeavesOutWhatIsNotKnown) {
  EXPECT_EQ(refusal(Error(ErrorCode::Busy, "later")).document,
            Json::parse(R"({"status": "error", "error": {"code": "busy", "message": "later"}})"));
  const ErrorDetails details{"/width", "9", "3 mm", 0.25, Eigen::Vector3d(1, 2, 3)};
  const Answer answer = refusal(Error(ErrorCode::WidthTooLarge, "too wide", details));
  EXPECT_TRUE(is_error(answer));
  EXPECT_EQ(answer.document, Json::parse(R"({"status": "error", "error": {
    "code": "width_too_large", "message": "too wide", "field": "/width", "value": "9",
    "limit": "3 mm", "at": {"parameter": 0.25, "target": [1.0, 2.0, 3.0]}}})"));
}

TEST(Document, ErrorsInBrokenTextStillPrint) {
  const Answer answer = refusal(Error(ErrorCode::BadInput, "no \xFF"));
  EXPECT_NE(to_json(answer).find("no \xEF\xBF\xBD"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline::jobs
