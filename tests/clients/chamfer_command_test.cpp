#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

using Json = nlohmann::json;

Json example(const std::string& name) {
  return Json::parse(read("clients/examples/" + name + ".json"));
}

Json source_case() {
  return Json::parse(R"({"job": "chamfer",
    "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30,
      "length": 100, "holes": [{"name": "H1", "shape": "circle", "radius": 5}]},
    "hole": "H1", "edge": "inner", "width": 0.5,
    "tool": {"number": 12, "shape": "lollipop", "radius": 3, "neck_radius": 1.5,
             "neck_length": 40}})");
}

Finished chamfer(const Json& job, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"chamfer", "-", "--local"});
  return ridgeline(options, job.dump());
}

Json result(const Json& job) {
  const Finished finished = chamfer(job);
  EXPECT_EQ(finished.status, 0) << finished.err;
  return finished.json();
}

/// The point of an array that belongs to a profile parameter.
std::vector<double> at(const Json& result, const char* array, double u) {
  const Json& parameter = result.at("parameter");
  for (std::size_t i = 0; i < parameter.size(); ++i)
    if (std::abs(parameter[i].get<double>() - u) < 1e-12) return result.at(array)[i];
  ADD_FAILURE() << "no point at u = " << u;
  return {NAN, NAN, NAN};
}

void expect_point(const std::vector<double>& p, const std::vector<double>& expected,
                  double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(p.at(i), expected[i], tolerance) << i;
}

// Values of design/chamfer.md section 10; both methods agree at these points.
TEST(Chamfer, CentresOfTheSourceCase) {
  for (const char* method : {"section", "swept"}) {
    Json job = source_case();
    job["method"] = method;
    job["points"] = 4;
    const Json r = result(job);
    ASSERT_EQ(r.at("centres").size(), 4);
    expect_point(at(r, "centres", 0), {2.789634, 0, 17.650182}, 5e-7);
    expect_point(at(r, "centres", 0.25), {0, 3.062835, 18.062835}, 5e-7);
    expect_point(at(r, "targets", 0), {5, 0, std::sqrt(375)}, 1e-12);
    EXPECT_EQ(r.at("method"), method);
  }
}

// Section 10: on the straight parts of an elongated hole x and z are constant.
TEST(Chamfer, StraightPartsOfAnElongatedHole) {
  Json job = source_case();
  job["workpiece"]["holes"][0] =
      Json::parse(R"({"name": "H1", "shape": "elongated", "radius": 3, "straight_along": 10})");
  job["tool"]["radius"] = 2;
  job["tool"]["neck_radius"] = 1.2;
  job["points"] = 400;
  const Json r = result(job);
  int on_straights = 0;
  for (std::size_t i = 0; i < r.at("targets").size(); ++i) {
    if (std::abs(r.at("targets")[i][1].get<double>()) > 4.9) continue;
    ++on_straights;
    EXPECT_NEAR(std::abs(r.at("centres")[i][0].get<double>()), 1.6583, 5e-5);
    EXPECT_NEAR(r.at("centres")[i][2].get<double>(), 18.617469, 5e-7);
  }
  EXPECT_GT(on_straights, 100);
}

// The ends of the chamfer are on the bore and on the wall, W apart, and D from the centre.
TEST(Chamfer, EndsLieOnTheirSurfaces) {
  Json job = source_case();
  job["method"] = "section";
  job["points"] = 37;
  const Json r = result(job);
  for (std::size_t i = 0; i < 37; ++i) {
    const std::vector<double> e = r.at("ends")[i];
    const std::vector<double> c = r.at("centres")[i];
    EXPECT_NEAR(std::hypot(e[0], e[2]), 20, 1e-11);
    EXPECT_NEAR(std::hypot(e[3], e[4]), 5, 1e-11);
    EXPECT_NEAR(std::hypot(e[0] - e[3], e[1] - e[4], e[2] - e[5]), 0.5, 1e-12);
    EXPECT_NEAR(std::hypot(e[0] - c[0], e[1] - c[1], e[2] - c[2]), 3, 1e-11);
    EXPECT_NEAR(std::hypot(e[3] - c[0], e[4] - c[1], e[5] - c[2]), 3, 1e-11);
  }
}

TEST(Chamfer, ReportNamesEverythingOfTheContract) {
  const Json r = result(source_case());
  EXPECT_EQ(r.at("job"), "chamfer");
  EXPECT_EQ(r.at("status"), "ok");
  EXPECT_EQ(r.at("workpiece").at("revision"), nullptr);
  EXPECT_EQ(r.at("tool").at("number"), 12);
  const Json& report = r.at("report");
  for (const char* key :
       {"points", "points_optimal", "chord_error", "width_min", "width_max", "overcut",
        "neck_clearance", "path_length", "cutting_time", "closing_error", "solve_seconds"})
    EXPECT_TRUE(report.at(key).is_number()) << key;
  EXPECT_EQ(report.at("holder_clearance"), nullptr);
  EXPECT_EQ(r.at("warnings").size(), 1);
  EXPECT_EQ(report.at("points"), r.at("centres").size());
  EXPECT_LE(report.at("chord_error"), 0.005);
  EXPECT_NEAR(report.at("width_min"), 0.5, 0.0075);
  EXPECT_NEAR(report.at("width_max"), 0.5, 0.0075);
  EXPECT_LE(report.at("points"), 1.03 * report.at("points_optimal").get<double>() + 1);
}

// Time and length of the report are those of the moves.
TEST(Chamfer, MovesAddUpToTheReport) {
  const Json r = result(source_case());
  double length = 0, seconds = 0;
  std::vector<double> before;
  int cuts = 0;
  for (const Json& move : r.at("moves")) {
    const std::vector<double> to = move.at("to");
    const bool is_rapid = move.at("kind") == "rapid";
    EXPECT_EQ(move.at("feed") == 0.0, is_rapid);
    if (!before.empty()) {
      const double d = std::hypot(to[0] - before[0], to[1] - before[1], to[2] - before[2]);
      length += d;
      if (!is_rapid) seconds += d / (move.at("feed").get<double>() / 60);
    }
    cuts += move.at("kind") == "cut" ? 1 : 0;
    before = to;
  }
  EXPECT_EQ(r.at("moves")[0].at("kind"), "rapid");
  EXPECT_GE(cuts, r.at("report").at("points").get<int>());
  EXPECT_GE(length, r.at("report").at("path_length").get<double>() * 0.5);
  EXPECT_NEAR(seconds, r.at("report").at("cutting_time").get<double>(), 0.05 * seconds);
}

TEST(Chamfer, ProgramPassesItsOwnVerification) {
  const TemporaryFolder folder;
  for (const char* name :
       {"inline", "valve_port", "tube_outer", "slot_two_passes", "drain_oblique"}) {
    SCOPED_TRACE(name);
    const std::string library = folder.file("library.db");
    ridgeline(
        {"library", "import", "clients/examples/library.json", "--local", "--library", library});
    const std::string job = std::string("clients/examples/") + name + ".json";
    const std::string program = folder.file(std::string(name) + ".nc");
    const Finished made = ridgeline(
        {"chamfer", job, "--local", "--library", library, "--format", "nc", "-o", program});
    ASSERT_EQ(made.status, 0) << made.out << made.err;
    EXPECT_EQ(made.out, "");
    const Finished verified =
        ridgeline({"verify", program, "--job", job, "--local", "--library", library});
    EXPECT_EQ(verified.status, 0) << verified.out;
    EXPECT_EQ(verified.json().at("failures").size(), 0);
  }
}

// A hole 0.05 mm beside the program: one side is cut wider, the other narrower.
TEST(Chamfer, ShiftedProgramFailsVerificationByItsWidth) {
  const TemporaryFolder folder;
  const std::string nc = chamfer(source_case(), {"--format", "nc"}).out;
  Json elsewhere = source_case();
  elsewhere["workpiece"]["holes"][0]["position"] = {0.05, 0, 0};
  const std::string program = folder.write("program.nc", nc);
  const std::string other_job = folder.write("other.json", elsewhere.dump());
  const Finished failed = ridgeline({"verify", program, "--job", other_job, "--local"});
  EXPECT_EQ(failed.status, 4) << failed.out;
  const Json document = failed.json();
  EXPECT_EQ(document.at("status"), "failed");
  EXPECT_EQ(document.at("failures")[0].at("code"), "verification_failed");
  EXPECT_GT(document.at("report").at("width_max"), 0.52);
  EXPECT_LT(document.at("report").at("width_min"), 0.48);
}

TEST(Chamfer, FormatsGoToTheFileAlone) {
  const TemporaryFolder folder;
  for (const char* format : {"nc", "cl", "csv", "svg", "json"}) {
    const std::string file = folder.file(std::string("result.") + format);
    const Finished finished = chamfer(source_case(), {"--format", format, "-o", file});
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_GT(read(file).size(), 500) << format;
  }
}

TEST(Chamfer, NamesGiveTheRevisionsUsed) {
  const TemporaryFolder folder;
  const std::string library = folder.file("library.db");
  ridgeline(
      {"library", "import", "clients/examples/library.json", "--local", "--library", library});
  const Finished finished =
      ridgeline({"chamfer", "clients/examples/valve_port.json", "--local", "--library", library});
  ASSERT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.json().at("workpiece"), Json::parse(R"({"name": "valve-20", "revision": 1})"));
  EXPECT_EQ(finished.json().at("tool").at("revision"), 1);
  EXPECT_NEAR(finished.json().at("width"), 0.3 * std::numbers::sqrt2, 1e-15);
}

TEST(Chamfer, ExamplesAreJobs) {
  for (const char* name :
       {"inline", "valve_port", "tube_outer", "slot_two_passes", "drain_oblique"})
    EXPECT_EQ(example(name).at("job"), "chamfer");
}

}  // namespace
}  // namespace ridgeline::tests
