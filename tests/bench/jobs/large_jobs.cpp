#include "tests/bench/jobs/large_jobs.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

namespace ridgeline::bench {
namespace {

using Json = nlohmann::json;

constexpr double feed = 1200;

Json edge(double scale, const Json& also) {
  Json job = {{"job", "chamfer"},
              {"workpiece",
               {{"shape", "thick_walled_cylinder"},
                {"inner_radius", 20 * scale},
                {"outer_radius", 30 * scale},
                {"length", 100 * scale},
                {"holes", {{{"name", "H1"}, {"shape", "circle"}, {"radius", 5 * scale}}}}}},
              {"hole", "H1"},
              {"edge", "inner"},
              {"tool",
               {{"number", 12},
                {"shape", "lollipop"},
                {"radius", 3},
                {"neck_radius", 1.5},
                {"neck_length", 40 * scale}}},
              {"width", 0.5},
              {"feed", feed}};
  job.update(also);
  return job;
}

/// Once round the edge of edge(1), badly: for `verify` it is its length that counts.
std::string round_program(int points) {
  std::string text = "%\nO1\nG90 G17 G54\nG0 X0. Y0. Z0.\n";
  for (int i = 0; i < points; ++i) {
    const double w = 2 * std::numbers::pi * i / points;
    text += "G1 X" + std::to_string(2.2 * std::cos(w)) + " Y" + std::to_string(2.2 * std::sin(w)) +
            " Z16. F1200.\n";
  }
  return text + "G0 X0. Y0.\nM30\n%\n";
}

Json verified(int points) {
  return {
      {"job", "verify"}, {"program", round_program(points)}, {"against", edge(1, Json::object())}};
}

Json looping(int rounds) {
  return {{"job", "macro"},
          {"program", "O1\n#1=0\nWHILE[#1LT" + std::to_string(rounds) +
                          "]DO1\nG1X[10*COS[#1]]Y[10*SIN[#1]]F500.\n#1=#1+1\nEND1\nM30\n"},
          {"limits", {{"kept", 2e6}}}};
}

Json cycle() {
  return {{"job", "cycle"},
          {"family", "taper straight"},
          {"method", 2},
          {"params",
           {{"D", 6},
            {"r", 3},
            {"width", 300},
            {"angle_deg", 45},
            {"pitch_along_slope", 0.002},
            {"x_start", 12},
            {"x_end", -12},
            {"y_pos", 0},
            {"feed", 1600}}}};
}

Json predicted(const Json& along, const Json& also) {
  Json job = {
      {"job", "predict"},
      {"along", along},
      {"material",
       {{"name", "aluminium"}, {"Ktc", 796.1}, {"Krc", 168.8}, {"Kte", 27.7}, {"Kre", 30.8}}},
      {"dynamics", {{"modes", {{2200, 0.03, 4000}}}}}};
  job.update(also);
  return job;
}

/// Ball in a slope, a groove beside it.
Json engagement(const Json& also) {
  Json job = Json::parse(R"({
    "job": "predict",
    "case": {
      "tool": {"kind": "ball", "r": 6, "z": 2, "helix_deg": 30, "nq": 256},
      "N": 1024, "feed_per_tooth": 0.2,
      "coef": {"Ktc": 796.1, "Krc": 168.8, "Kte": 27.7, "Kre": 30.8},
      "engagement": {"normal": [-1, 0, 1], "c": 0.23, "grooves": [[-0.34648, 0, -0.34648]]},
      "modes_x": [[1100, 0.03, 2000]], "modes_y": [[1100, 0.03, 2000]]}})");
  job.update(also);
  return job;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

Json units(const std::string& part) {
  return {{"job", "units"}, {"product_step", text_of(RIDGELINE_TESTS "/parts/" + part)}};
}

}  // namespace

std::vector<LargeJob> large_jobs() {
  std::vector<LargeJob> jobs;
  const Json points = edge(1, {{"points", 2'000'000}});
  for (const char* format : {"json", "nc", "cl", "csv", "svg"}) {
    jobs.push_back({"chamfer of 2,000,000 points", points, format});
  }
  jobs.push_back({"chamfer of 20,000 points", edge(1, {{"points", 20'000}}), "html"});
  jobs.push_back({"chamfer by the tolerance", edge(1, {{"tolerance", 1e-8}})});
  jobs.push_back({"chamfer in three passes",
                  edge(1, {{"points", 500'000}, {"passes", 2}, {"spring_pass", true}})});
  jobs.push_back(
      {"chamfer of 60,000 arcs", edge(1, {{"points", 60'000}, {"output", {{"arcs", true}}}})});
  jobs.push_back(
      {"chamfer in fitted arcs", edge(1, {{"tolerance", 5e-6}, {"output", {{"arcs", true}}}})});
  jobs.push_back({"verify of 800,000 blocks", verified(800'000)});
  for (const char* format : {"json", "nc", "csv", "svg", "trace"}) {
    jobs.push_back({"macro of 1,000,000 moves", looping(1'000'000), format});
  }
  for (const char* format : {"json", "nc", "csv", "svg"}) {
    jobs.push_back({"cycle of 150,000 lines", cycle(), format});
  }
  const Json cut = edge(1, {{"points", 200}, {"spindle_speed", 8000}});
  jobs.push_back({"predict 200 points", predicted(cut, Json::object())});
  jobs.push_back({"predict 200 points", predicted(cut, {{"correct", true}}), "nc"});
  const Json few = edge(1, {{"points", 12}, {"spindle_speed", 8000}});
  jobs.push_back({"predict 12 points in time", predicted(few, {{"method", "time_domain"}})});
  jobs.push_back({"predict one engagement in time",
                  engagement({{"speed_rpm", 9000}, {"method", "time_domain"}})});
  jobs.push_back({"predict 57 speeds",
                  engagement({{"speeds_rpm", {{"from", 2000}, {"to", 16000}, {"step", 250}}}})});
  for (const char* format : {"json", "svg", "html"}) {
    jobs.push_back({"units of a cross tube", units("own_cross_tube.step"), format});
  }
  for (const char* part : {"tie_rod.step", "own_flanged_shaft.step", "own_hard_shaft.step"}) {
    jobs.push_back({std::string("units of ") + part, units(part)});
  }
  return jobs;
}

}  // namespace ridgeline::bench
