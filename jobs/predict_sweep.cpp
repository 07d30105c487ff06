#include <algorithm>
#include <cmath>

#include "jobs/in_parallel.hpp"
#include "jobs/predict_kinds.hpp"
#include "jobs/predict_page.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_speeds = 100'000;

// What one speed gives.
struct AtSpeed {
  std::optional<double> e;
  int loops = 0;
  bool converged = false;
  cutting::Method method = cutting::Method::Iterate;
  Json stability;
  std::vector<std::string> warnings;
};

// A vibration that outgrows the tool has no error; the other speeds have theirs.
AtSpeed outgrown(const PredictJob& job) {
  AtSpeed out;
  out.method = cutting::Method::TimeDomain;
  if (job.test != StabilityTest::None) out.stability = name(cutting::Stability::Unstable);
  return out;
}

AtSpeed at_speed(PredictJob job, double rpm, const Progress& progress) try {
  job.engagement.S = rpm / 60;
  AtSpeed out;
  const cutting::Predicted predicted = cutting::predict(job.engagement, job.method, {}, progress);
  out.e = predicted.prediction.e;
  out.loops = predicted.prediction.loops;
  out.converged = predicted.prediction.converged;
  out.method = predicted.method;
  out.stability = stability_document(job, out.warnings, progress);
  return out;
} catch (const Error& error) {
  if (error.code() != ErrorCode::NotConverged) throw;
  return outgrown(job);
}

std::string csv_of(const std::vector<double>& speeds, const std::vector<AtSpeed>& rows) {
  std::string out = "speed_rpm,e_mm,stability,method,loops,converged\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const AtSpeed& row = rows[i];
    out += text(speeds[i]) + "," + (row.e ? text(*row.e) : "") + "," +
           (row.stability.is_null() ? "" : row.stability.get<std::string>()) + "," +
           std::string(name(row.method)) + "," + std::to_string(row.loops) + "," +
           (row.converged ? "true" : "false") + "\n";
  }
  return out;
}

// Error against speed; speeds that chatter stand out.
std::string drawing_of(const std::vector<double>& speeds, const std::vector<AtSpeed>& rows) {
  Chart chart{"Machining error against spindle speed",
              "spindle speed [rev/min]",
              "um",
              {20, 30},
              {880, 420},
              {}};
  Series stable{"error", "path", {}};
  std::vector<Series> chatter;
  bool was_stable = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].e) continue;
    const Eigen::Vector2d point(speeds[i], *rows[i].e * 1e3);
    stable.points.push_back(point);
    const bool is_stable = rows[i].stability.is_null() || rows[i].stability == "stable";
    if (!is_stable && was_stable) chatter.push_back({chatter.empty() ? "chatter" : "", "band", {}});
    if (!is_stable) chatter.back().points.push_back(point);
    was_stable = is_stable;
  }
  chart.series.push_back(std::move(stable));
  for (Series& run : chatter) {
    const double mark = 0.004 * (speeds.back() - speeds.front());  // a speed alone is seen too
    run.points.insert(run.points.begin(), run.points.front() - Eigen::Vector2d(mark, 0));
    run.points.push_back(run.points.back() + Eigen::Vector2d(mark, 0));
    chart.series.push_back(std::move(run));
  }
  Svg svg(900, 460, "Machining error against spindle speed");
  draw(svg, chart);
  return std::move(svg).finish();
}

Answer answer_of(const std::vector<double>& speeds, const std::vector<AtSpeed>& rows,
                 std::string_view format) {
  Answer answer;
  if (format == "csv") answer.text = csv_of(speeds, rows);
  if (format == "svg") answer.text = drawing_of(speeds, rows);
  Json e = Json::array(), stability = Json::array(), methods = Json::array();
  Json loops = Json::array(), converged = Json::array();
  std::vector<std::string> warnings;
  for (const AtSpeed& row : rows) {
    e.push_back(row.e ? Json(*row.e) : Json(nullptr));
    loops.push_back(row.loops);
    converged.push_back(row.converged);
    methods.push_back(name(row.method));
    stability.push_back(row.stability);
    if (warnings.empty()) warnings = row.warnings;
  }
  answer.document = {{"job", "predict"},       {"status", "ok"},
                     {"speed_rpm", speeds},    {"e_mm", e},
                     {"loops", loops},         {"converged", converged},
                     {"stability", stability}, {"method", methods},
                     {"warnings", warnings}};
  if (format == "html") answer.text = sweep_page(answer.document);
  return answer;
}

}  // namespace

std::vector<double> read_speeds(const Value& value) {
  if (!value.json().is_object()) {
    std::vector<double> speeds = value.numbers(speed_range);
    if (speeds.empty() || speeds.size() > most_speeds) {
      value.refuse("1 to " + std::to_string(most_speeds) + " speeds");
    }
    return speeds;
  }
  Object range(value);
  const double from = range.number("from", speed_range);
  const double to = range.number("to", between(from, speed_range.max, speed_range.unit));
  const double step = range.number("step", above(0, speed_range.max, speed_range.unit));
  range.finish();
  const double count = std::floor((to - from) / step + 1e-9) + 1;
  if (!(count <= static_cast<double>(most_speeds))) {
    range.refuse("step",
                 "so large that there are at most " + std::to_string(most_speeds) + " speeds");
  }
  std::vector<double> speeds;
  speeds.reserve(static_cast<std::size_t>(std::max(count, 0.0)));
  for (int i = 0; i < static_cast<int>(count); ++i) speeds.push_back(from + i * step);
  return speeds;
}

Answer predict_sweep(Object& job, const Request& request) {
  job.exclude("speeds_rpm", "speed_rpm");
  const PredictJob read = read_predict_job(job);
  const std::vector<double> speeds = read_speeds(job.required("speeds_rpm"));
  job.finish();

  std::vector<AtSpeed> rows(speeds.size());
  in_parallel(speeds.size(), request.progress, "speeds", [&](std::size_t i) {
    rows[i] = at_speed(read, speeds[i], {.report = {}, .stop = request.progress.stop});
  });
  return answer_of(speeds, rows, request.format);
}

}  // namespace ridgeline::jobs
