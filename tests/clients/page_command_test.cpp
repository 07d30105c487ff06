#include <gtest/gtest.h>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

using Json = nlohmann::json;

/// The data that a page holds for its viewer.
Json data_of(const std::string& page) {
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) throw std::runtime_error("the page has no data element");
  const std::size_t end = page.find("</script>", at);
  return Json::parse(page.substr(at + begin.size(), end - at - begin.size()));
}

std::string page_of(const Json& job) {
  const Finished finished = ridgeline({"chamfer", "-", "--local", "--format", "html"}, job.dump());
  EXPECT_EQ(finished.status, 0) << finished.out.substr(0, 1000);
  return finished.out;
}

Json inline_job() {
  return Json::parse(read("clients/examples/inline.json"));
}

TEST(Page, HoldsTheReportOfTheResult) {
  const Json job = inline_job();
  const Json report = ridgeline({"chamfer", "-", "--local"}, job.dump()).json().at("report");
  const Json data = data_of(page_of(job));
  std::size_t compared = 0;
  for (const Json& row : data.at("report")) {
    if (!row.contains("key")) continue;
    EXPECT_EQ(row.at("value"), report.at(row.at("key").get<std::string>())) << row;
    ++compared;
  }
  EXPECT_EQ(compared, 12);
}

TEST(Page, NeedsNothingFromTheNetwork) {
  const std::string page = page_of(inline_job());
  for (const char* reference : {"src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
}

// Every move of a cycle but the first, from where the page begins, is a piece of its path.
TEST(Page, OfACycleHoldsItsMotion) {
  const std::string cycle = "clients/examples/cycles/taper.json";
  const Json motion = ridgeline({"macro", "make", cycle, "--local"}).json().at("motion");
  const Finished page = ridgeline({"macro", "make", cycle, "--local", "--format", "html"});
  ASSERT_EQ(page.status, 0) << page.out.substr(0, 1000);
  const Json drawn = data_of(page.out).at("motion");
  EXPECT_EQ(drawn.at("start"), motion.front().at("to"));
  EXPECT_EQ(drawn.at("kinds").size(), motion.size() - 1);  // lines alone
  EXPECT_EQ(drawn.at("moves").back(), motion.size() - 1);
}

// What the list of the page shows is the program's, unit by unit.
TEST(Page, OfUnitsHoldsEveryUnit) {
  const std::string job = "clients/examples/units_shaft.json";
  const Json program = ridgeline({"units", "plan", job, "--local"}).json();
  const Finished page = ridgeline({"units", "plan", job, "--local", "--format", "html"});
  ASSERT_EQ(page.status, 0) << page.out.substr(0, 1000);
  const Json list = data_of(page.out).at("units").at("list");
  ASSERT_EQ(list.size(), program.at("units").size());
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const char* key : {"number", "kind", "process", "state", "machining", "tools", "volume"})
      EXPECT_EQ(list[i].at(key), program.at("units")[i].at(key)) << i << " " << key;
}

// A name cannot end the data element, nor begin a comment that hides its end.
TEST(Page, KeepsNamesAsText) {
  Json job = inline_job();
  const std::string name = "</script><!--<script>alert(1)</script>";
  job["workpiece"]["name"] = name;
  const Json data = data_of(page_of(job));
  EXPECT_NE(data.at("title").get<std::string>().find(name), std::string::npos) << data.at("title");
}

}  // namespace
}  // namespace ridgeline::tests
