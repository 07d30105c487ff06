#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cutting/lobes.hpp"
#include "jobs/in_parallel.hpp"
#include "jobs/predict_kinds.hpp"
#include "jobs/predict_page.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using cutting::Engaging;

constexpr Choices<Engaging, 2> engagings{
    {{"moving", Engaging::Moving}, {"frozen", Engaging::Frozen}}};

/// What "depths" asks: the member of the engagement that is varied, and its range.
struct Depths {
  std::string key;
  cutting::DepthRange range;
};

Depths read_depths(const Value& value, const Json& engagement) {
  Object object(value);
  Depths depths;
  const bool square = engagement.contains("ap");
  constexpr Choices<const char*, 3> keys{{{"c", "c"}, {"a", "a"}, {"ap", "ap"}}};
  depths.key = object.choice("of", keys, square ? "ap" : "c");
  if (!engagement.contains(depths.key)) {
    object.refuse(
        "of", "a member of /case/engagement: \"ap\" or \"a\" of a square mill, \"c\" of a ball");
  }
  depths.range.from = object.number("from", between(1e-4, 1e3, "mm"));
  depths.range.to = object.number("to", above(depths.range.from, 1e3, "mm"));
  depths.range.steps = object.integer("steps", 1, 1000, 20);
  object.finish();
  return depths;
}

// The engagement at another depth, read as if the job had it.
cutting::Cut cut_at_depth(const Json& given, const std::string& key, double depth) {
  Json changed = given;
  changed["engagement"][key] = depth;
  cutting::Engagement engagement;
  read_case(Value(changed, "/case"), engagement);
  return engagement.cut;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string csv_of(const std::vector<double>& speeds, const std::vector<double>& limits) {
  std::string out = "speed_rpm,depth_limit_mm\n";
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    out += text(speeds[i]) + "," + (std::isnan(limits[i]) ? "" : text(limits[i])) + "\n";
  }
  return out;
}

// Where no depth up to the deepest chatters, the border is drawn at the top.
std::string drawing_of(const std::vector<double>& speeds, const std::vector<double>& limits,
                       const Depths& depths) {
  Chart chart{"Stability lobes", "spindle speed [rev/min]", "mm", {20, 30}, {880, 440}, {}};
  Series border{"chatters above", "ridge", {}};
  Series deepest{"deepest tried", "axis", {}};
  Series floor{"", "axis", {}};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    border.points.emplace_back(speeds[i], std::isnan(limits[i]) ? depths.range.to : limits[i]);
    deepest.points.emplace_back(speeds[i], depths.range.to);
    floor.points.emplace_back(speeds[i], 0);
  }
  chart.series = {std::move(border), std::move(deepest), std::move(floor)};
  Svg svg(900, 480, "Stability lobes");
  draw(svg, chart);
  svg.text({20, 465}, "depth of cut \"" + depths.key +
                          "\" at which a deviation from the steady cut begins to grow");
  return std::move(svg).finish();
}

}  // namespace

Answer predict_lobes(Object& job, const Request& request) {
  job.exclude("speeds_rpm", "speed_rpm");
  const Value given = job.required("case");
  const PredictJob read = read_predict_job(job);
  const std::vector<double> speeds = read_speeds(job.required("speeds_rpm"));
  const Json& engagement = given.json().at("engagement");
  const Depths depths = read_depths(job.required("depths"), engagement);
  const Engaging engaging = job.choice("engaging", engagings, Engaging::Moving);
  job.finish();
  cut_at_depth(given.json(), depths.key, depths.range.from);
  cut_at_depth(given.json(), depths.key, depths.range.to);

  std::vector<double> limits(speeds.size(), none);
  in_parallel(speeds.size(), request.progress, "lobes", [&](std::size_t i) {
    const auto cut_of = [&](double depth) { return cut_at_depth(given.json(), depths.key, depth); };
    limits[i] = cutting::chatter_depth(cut_of, read.engagement.compliance, speeds[i] / 60,
                                       depths.range, engaging)
                    .value_or(none);
  });

  Answer answer;
  if (request.format == "csv") answer.text = csv_of(speeds, limits);
  if (request.format == "svg") answer.text = drawing_of(speeds, limits, depths);
  answer.document = {{"job", "predict"},
                     {"status", "ok"},
                     {"depth_of", depths.key},
                     {"deepest_tried", depths.range.to},
                     {"engaging", name_of(engagings, engaging)},
                     {"warnings", Json::array()}};
  if (request.format == "html") answer.text = lobes_page(speeds, limits, answer.document);
  answer.arrays.push_back({"/speed_rpm", {speeds.size()}, speeds});
  answer.arrays.push_back({"/depth_limit", {limits.size()}, limits});
  return answer;
}

}  // namespace ridgeline::jobs
