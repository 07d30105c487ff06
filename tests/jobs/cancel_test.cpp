// A cancel stops work of every kind soon: each long stage looks for it, and the more often the more
// there is to do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

struct Work {
  std::string name;
  Json document;
  std::string format = "json";
};

Json edge(const Json& also) {
  Json job = {{"job", "chamfer"},
              {"workpiece",
               {{"shape", "thick_walled_cylinder"},
                {"inner_radius", 20},
                {"outer_radius", 30},
                {"length", 100},
                {"holes", {{{"name", "H1"}, {"shape", "circle"}, {"radius", 5}}}}}},
              {"hole", "H1"},
              {"edge", "inner"},
              {"tool",
               {{"number", 12},
                {"shape", "lollipop"},
                {"radius", 3},
                {"neck_radius", 1.5},
                {"neck_length", 40}}},
              {"width", 0.5},
              {"feed", 1200}};
  job.update(also);
  return job;
}

Json chamfer_of(int points) {
  return edge({{"points", points}, {"overlap", 90}});
}

Json verify_of(int blocks) {
  std::string program = "%\nO1\nG90 G17 G54\nG0 X0. Y0. Z0.\n";
  for (int i = 0; i < blocks; ++i) {
    const double w = 2 * std::numbers::pi * i / blocks;
    program += "G1 X" + std::to_string(2.2 * std::cos(w)) + " Y" +
               std::to_string(2.2 * std::sin(w)) + " Z16. F1200.\n";
  }
  program += "G0 X0. Y0.\nM30\n%\n";
  return {{"job", "verify"}, {"program", program}, {"against", edge(Json::object())}};
}

Json macro_of(int rounds) {
  return {{"job", "macro"},
          {"program", "O1\n#1=0\nWHILE[#1LT" + std::to_string(rounds) +
                          "]DO1\nG1X[10*COS[#1]]Y[10*SIN[#1]]F500.\n#1=#1+1\nEND1\nM30\n"},
          {"limits", {{"kept", 1e6}}}};
}

/// What a run says, look by look.
struct Looks {
  std::vector<double> fractions;
  std::vector<std::string> stages;

  std::map<std::string, std::size_t> by_stage() const {
    std::map<std::string, std::size_t> counts;
    for (const std::string& stage : stages) ++counts[stage];
    return counts;
  }
};

/// Runs the work; asked to stop at look `stop_at` if that is not 0.
std::pair<Answer, Looks> run(const Work& work, std::size_t stop_at = 0) {
  Looks looks;
  std::stop_source source;
  const Progress progress{.report =
                              [&](double fraction, std::string_view stage) {
                                looks.fractions.push_back(fraction);
                                looks.stages.emplace_back(stage);
                                if (looks.stages.size() == stop_at) source.request_stop();
                              },
                          .stop = source.get_token()};
  Answer answer = jobs::answer(work.document.dump(), work.format, NoDefinitions(), progress);
  return {std::move(answer), std::move(looks)};
}

std::vector<Work> works() {
  std::vector<Work> all;
  for (const char* format : {"json", "nc", "cl", "csv", "html"}) {
    all.push_back({"chamfer", chamfer_of(2000), format});
  }
  all.push_back(
      {"chamfer in fitted arcs", edge({{"tolerance", 1e-3}, {"output", {{"arcs", true}}}})});
  all.push_back({"verify", verify_of(2000)});
  for (const char* format : {"json", "nc", "csv", "svg", "html", "trace"}) {
    all.push_back({"macro", macro_of(3000), format});
  }
  return all;
}

TEST(Cancel, StopsAtAnyLook) {
  for (const Work& work : works()) {
    const auto [whole, looks] = run(work);
    ASSERT_FALSE(is_error(whole)) << work.name << ' ' << work.format << whole.document.dump();
    const std::size_t count = looks.stages.size();
    for (std::size_t stop_at = 1; stop_at < count; stop_at += std::max<std::size_t>(1, count / 4)) {
      const auto [answer, until] = run(work, stop_at);
      ASSERT_TRUE(is_error(answer)) << work.name << ' ' << work.format << " at " << stop_at;
      EXPECT_EQ(answer.document.at("error").at("code"), "cancelled");
      EXPECT_EQ(until.stages.size(), stop_at)
          << work.name << ": went on after " << until.stages.back();
    }
  }
}

// Twice the work, twice the looks: no stage whose time grows with the work looks a fixed number of
// times.
TEST(Cancel, EveryStageLooksTheMoreOftenTheLonger) {
  const auto compare = [](const Work& small, const Work& large,
                          const std::vector<std::string>& stages) {
    const auto few = run(small).second.by_stage(), many = run(large).second.by_stage();
    for (const std::string& stage : stages) {
      ASSERT_TRUE(few.contains(stage)) << large.name << " never looks in stage " << stage;
      EXPECT_GE(many.at(stage), 3 * few.at(stage)) << large.name << ' ' << stage;
    }
  };
  compare({"chamfer", chamfer_of(5 * 1024)}, {"chamfer", chamfer_of(25 * 1024)},
          {"points", "chords", "order", "overlap", "blocks", "motion", "rounding", "moves", "tree",
           "closing", "length", "answer"});
  for (const char* format : {"nc", "cl", "csv"}) {
    compare({"chamfer", chamfer_of(5 * 1024), format}, {"chamfer", chamfer_of(25 * 1024), format},
            {"program"});
  }
  compare({"verify", verify_of(5 * 1024)}, {"verify", verify_of(25 * 1024)},
          {"dialect", "reading", "moves", "tree", "closing", "length"});
  compare({"macro", macro_of(5 * 1024)}, {"macro", macro_of(25 * 1024)}, {"macro", "answer"});
}

TEST(Cancel, ProgressNeverGoesBack) {
  for (const Work& work : {Work{"chamfer", chamfer_of(6000)}, Work{"verify", verify_of(6000)}}) {
    const Looks looks = run(work).second;
    for (std::size_t i = 1; i < looks.fractions.size(); ++i) {
      ASSERT_GE(looks.fractions[i], looks.fractions[i - 1] - 1e-12)
          << work.name << ": " << looks.stages[i - 1] << ", then " << looks.stages[i];
    }
    EXPECT_LE(looks.fractions.back(), 1);
  }
}

}  // namespace
}  // namespace ridgeline::jobs
