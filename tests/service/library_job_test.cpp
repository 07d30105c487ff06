#include "service/library_job.hpp"

#include <gtest/gtest.h>

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;

class LibraryJob : public testing::Test {
protected:
  Json ask(const char* text) { return answer_library(Json::parse(text), library_).document; }
  std::string code(const char* text) { return ask(text).at("error").at("code"); }
  std::string field(const char* text) { return ask(text).at("error").value("field", "none"); }

  Library library_{":memory:", "north"};
};

constexpr char put_tool[] = R"({"job": "library", "operation": "put", "definition":
  {"kind": "tool", "number": 12, "name": "b6", "shape": "ball", "radius": 3}})";

TEST_F(LibraryJob, PutsGetsAndTellsTheRevision) {
  const Json put = ask(put_tool);
  EXPECT_EQ(put.at("status"), "ok");
  EXPECT_EQ(put.at("revision"), 1);
  EXPECT_EQ(put.at("name"), "b6");
  const Json got = ask(R"({"job":"library","operation":"get","kind":"tool","name":12})");
  EXPECT_EQ(got.at("definition").at("radius"), 3);
  EXPECT_EQ(got.at("instance"), "north");
  const Json list = ask(R"({"job":"library","operation":"list"})");
  ASSERT_EQ(list.at("definitions").size(), 1u);
  EXPECT_EQ(list.at("definitions")[0].at("number"), 12);
  EXPECT_TRUE(
      ask(R"({"job":"library","operation":"list","kind":"workpiece"})").at("definitions").empty());
}

TEST_F(LibraryJob, ExportImportsAgain) {
  ask(put_tool);
  Json exported = ask(R"({"job":"library","operation":"export"})");
  Library other(":memory:");
  const Json import = {
      {"job", "library"}, {"operation", "import"}, {"definitions", exported.at("definitions")}};
  EXPECT_EQ(answer_library(import, other).document.at("new"), 1);
  EXPECT_EQ(answer_library(import, other).document.at("new"), 0);
  EXPECT_EQ(other.find("tool", "12")->document, library_.find("tool", "12")->document);
}

TEST_F(LibraryJob, HistoryShowsRemovals) {
  ask(put_tool);
  EXPECT_EQ(
      ask(R"({"job":"library","operation":"remove","kind":"tool","name":"12"})").at("revision"), 2);
  const Json history = ask(R"({"job":"library","operation":"history","kind":"tool","name":"b6"})");
  ASSERT_EQ(history.at("revisions").size(), 2u);
  EXPECT_EQ(history.at("revisions")[0].at("definition").at("radius"), 3);
  EXPECT_EQ(history.at("revisions")[1].at("removed"), true);
  EXPECT_EQ(code(R"({"job":"library","operation":"get","kind":"tool","name":"b6"})"),
            "unknown_definition");
  EXPECT_EQ(ask(R"({"job":"library","operation":"get","kind":"tool","name":"b6","revision":1})")
                .at("definition")
                .at("number"),
            12);
}

TEST_F(LibraryJob, RefusesByCodeAndField) {
  EXPECT_EQ(field(R"({"job":"library","operation":"drop"})"), "/operation");
  EXPECT_EQ(field(R"({"job":"library"})"), "/operation");
  EXPECT_EQ(field(R"({"job":"chamfer","operation":"list"})"), "/job");
  EXPECT_EQ(field(R"({"job":"library","operation":"list","sort":1})"), "/sort");
  EXPECT_EQ(field(R"({"job":"library","operation":"put","definition":{"kind":"tool",
    "number":12,"shape":"ball","radius":-3}})"),
            "/definition/radius");
  EXPECT_EQ(field(R"({"job":"library","operation":"import","definitions":[{"kind":"saw"}]})"),
            "/definitions/0/kind");
  EXPECT_EQ(code(R"({"job":"library","operation":"import","definitions":7})"), "bad_input");
  EXPECT_EQ(code(R"({"job":"library","operation":"get","kind":"tool","name":"x"})"),
            "unknown_definition");
  EXPECT_EQ(answer_library(Json(7), library_).document.at("status"), "error");
}

TEST(TimeText, IsIso8601) {
  EXPECT_EQ(time_text(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(time_text(1'700'000'000'123'456'789), "2023-11-14T22:13:20.123Z");
}

}  // namespace
}  // namespace ridgeline::service
