#include "jobs/predict_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jobs/motion.hpp"
#include "jobs/predict_case.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::StationError;
using Json = nlohmann::json;
using Points = std::vector<Eigen::Vector3d>;

constexpr double absent = std::numeric_limits<double>::quiet_NaN();  // prints as null

template <typename Of>
std::vector<double> column(const std::vector<StationError>& rows, const Of& of) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const StationError& row : rows) out.push_back(of(row));
  return out;
}

template <typename Of>
Points points(const std::vector<StationError>& rows, const Of& of) {
  Points out;
  out.reserve(rows.size());
  for (const StationError& row : rows) out.push_back(of(row));
  return out;
}

double error_of(const StationError& row) {
  return row.e.value_or(absent);
}

Array numbers_array(std::string pointer, std::vector<double> values) {
  const std::size_t size = values.size();
  return {std::move(pointer), {size}, std::move(values)};
}

// Least, greatest and rms of what is there.
Json range_document(const std::vector<double>& values) {
  double least = absent, most = absent, squares = 0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    least = count == 0 ? value : std::min(least, value);
    most = count == 0 ? value : std::max(most, value);
    squares += value * value;
    ++count;
  }
  if (count == 0) return {{"min", nullptr}, {"max", nullptr}, {"rms", nullptr}};
  return {{"min", least}, {"max", most}, {"rms", std::sqrt(squares / count)}};
}

Json stability_document(const std::vector<StationError>& rows) {
  Json out = Json::array();
  for (const StationError& row : rows) {
    out.push_back(row.stability ? Json(name(*row.stability)) : Json(nullptr));
  }
  return out;
}

void add_rows(const std::string& at, const std::vector<StationError>& rows, bool has_spread,
              Answer& answer) {
  answer.arrays.push_back(numbers_array(at + "/error", column(rows, error_of)));
  if (has_spread) {
    answer.arrays.push_back(numbers_array(at + "/spread", column(rows, [](const StationError& r) {
                                            return r.e ? r.spread : absent;
                                          })));
  }
  answer.arrays.push_back(points_array(
      at + "/force", points(rows, [](const StationError& r) { return r.peak_force; })));
  answer.arrays.push_back(points_array(
      at + "/mean_force", points(rows, [](const StationError& r) { return r.mean_force; })));
  answer.arrays.push_back(points_array(
      at + "/deflection", points(rows, [](const StationError& r) { return r.peak_deflection; })));
  answer.arrays.push_back(numbers_array(at + "/multiplier", column(rows, [](const StationError& r) {
                                          return r.multiplier ? std::abs(*r.multiplier) : absent;
                                        })));
}

Json summary(const AlongJob& job, const std::vector<StationError>& rows,
             const std::vector<double>& width) {
  int cutting = 0, fell_back = 0, not_converged = 0, unstable = 0, tested = 0;
  int low_pass_off = 0;
  double loops = 0, force = 0, deflection = 0;
  for (const StationError& row : rows) {
    cutting += row.e ? 1 : 0;
    fell_back += row.fell_back ? 1 : 0;
    not_converged += row.converged || job.options.method == cutting::Method::Rigid ? 0 : 1;
    tested += row.stability ? 1 : 0;
    unstable += row.stability && *row.stability != cutting::Stability::Stable ? 1 : 0;
    low_pass_off += row.low_pass_off ? 1 : 0;
    loops += row.loops;
    force = std::max(force, row.peak_force.norm());
    deflection = std::max(deflection, row.peak_deflection.norm());
  }
  Json document = {{"stations", rows.size()},
                   {"stations_cutting", cutting},
                   {"error", range_document(column(rows, error_of))},
                   {"force_peak", force},
                   {"deflection_peak", deflection},
                   {"loops_mean", loops / std::max<double>(1, static_cast<double>(rows.size()))},
                   {"fell_back", fell_back},
                   {"not_converged", not_converged},
                   {"low_pass_off", low_pass_off},
                   {"stability_tested", tested},
                   {"chattering", unstable}};
  if (!width.empty()) document["width"] = range_document(width);
  return document;
}

void warn(const AlongJob& job, const PredictedPath& path, std::vector<std::string>& warnings) {
  int fell_back = 0, chatter = 0;
  for (const StationError& row : path.result.before) {
    fell_back += row.fell_back ? 1 : 0;
    chatter += row.stability && *row.stability != cutting::Stability::Stable ? 1 : 0;
  }
  if (fell_back > 0) {
    warnings.push_back("at " + std::to_string(fell_back) +
                       " stations the iteration did not converge: the time domain answered there");
  }
  if (chatter > 0) {
    warnings.push_back("the cut chatters at " + std::to_string(chatter) +
                       " of the stations tested: the error there is not steady");
  }
  if (job.options.stability == cutting::StabilityTest::None) {
    warnings.emplace_back("stability was not tested: the error of a cut that chatters is not this");
  }
}

std::vector<double> ways(const PredictedPath& path) {
  std::vector<double> out;
  for (std::size_t i = 0; i < path.stations.size(); ++i) {
    if (i == 0) {
      out.push_back(0);
      continue;
    }
    out.push_back(out.back() + (path.stations[i].centre - path.stations[i - 1].centre).norm());
  }
  return out;
}

Points centres_after(const PredictedPath& path) {
  Points out;
  for (std::size_t i = 0; i < path.stations.size(); ++i) {
    out.push_back(path.stations[i].centre - path.result.after[i].shift * path.stations[i].n);
  }
  return out;
}

Points shifts_of(const PredictedPath& path, const std::vector<StationError>& after) {
  Points out;
  for (std::size_t i = 0; i < after.size(); ++i) {
    out.push_back(-after[i].shift * path.stations[i].n);
  }
  return out;
}

void add_corrected(const AlongJob& job, const PredictedPath& path, Answer& answer) {
  const std::vector<StationError>& rows = path.result.after;
  answer.document["corrected"] = {{"report", summary(job, rows, path.width_after)},
                                  {"stability", stability_document(rows)}};
  const Points shift = shifts_of(path, rows);
  Points position = path.position;
  for (std::size_t i = 0; i < position.size(); ++i) position[i] += shift[i];
  answer.arrays.push_back(points_array("/corrected/position", position));
  answer.arrays.push_back(points_array("/corrected/centre", centres_after(path)));
  answer.arrays.push_back(points_array("/corrected/shift", shift));
  if (!path.finish.empty()) {
    answer.arrays.push_back(points_array("/corrected/finish_shift", shifts_of(path, path.finish)));
  }
  add_rows("/corrected", rows, job.options.uncertainty.has_value(), answer);
  if (!path.width_after.empty()) {
    answer.arrays.push_back(numbers_array("/corrected/width", path.width_after));
  }
}

}  // namespace

Answer path_answer(const AlongJob& job, const PredictedPath& path) {
  const std::vector<StationError>& rows = path.result.before;
  Answer answer;
  std::vector<std::string> warnings = job.warnings;
  warn(job, path, warnings);
  Json report = summary(job, rows, path.width);
  report["solve_seconds"] = path.result.solve_seconds;
  answer.document = {{"job", "predict"},
                     {"status", "ok"},
                     {"along", path.kind},
                     {"method", name(job.options.method)},
                     {"speed_rpm", job.rpm},
                     {"dynamics", document_of(job.tool)},
                     {"material", document_of(job.material)},
                     {"stability", stability_document(rows)},
                     {"report", report},
                     {"warnings", warnings}};
  if (path.wanted_width > 0) answer.document["width_asked"] = path.wanted_width;
  Points centre, normal;
  std::vector<double> feed;
  for (const cutting::Station& station : path.stations) {
    centre.push_back(station.centre);
    normal.push_back(station.n);
    feed.push_back(station.feed);
  }
  if (!path.parameter.empty()) answer.arrays.push_back(numbers_array("/parameter", path.parameter));
  answer.arrays.push_back(points_array("/position", path.position));
  answer.arrays.push_back(points_array("/centre", centre));
  answer.arrays.push_back(points_array("/normal", normal));
  answer.arrays.push_back(numbers_array("/way", ways(path)));
  answer.arrays.push_back(numbers_array("/feed_per_tooth", feed));
  add_rows("", rows, job.options.uncertainty.has_value(), answer);
  answer.arrays.push_back(numbers_array(
      "/loops", column(rows, [](const StationError& r) { return static_cast<double>(r.loops); })));
  if (!path.width.empty()) answer.arrays.push_back(numbers_array("/width", path.width));
  if (!path.result.after.empty()) add_corrected(job, path, answer);
  return answer;
}

std::string path_csv(const PredictedPath& path) {
  const std::vector<double> way = ways(path);
  const bool corrected = !path.result.after.empty();
  const bool chamfer = !path.width.empty();
  std::string out =
      "way_mm,x_mm,y_mm,z_mm,error_mm,spread_mm,Fx_N,Fy_N,Fz_N,Dx_mm,Dy_mm,Dz_mm,stability,"
      "multiplier,loops";
  if (chamfer) out += ",width_mm";
  if (corrected) out += ",shift_x_mm,shift_y_mm,shift_z_mm,error_after_mm";
  if (corrected && chamfer) out += ",width_after_mm";
  if (!path.finish.empty()) out += ",finish_shift_x_mm,finish_shift_y_mm,finish_shift_z_mm";
  const Points shift = shifts_of(path, path.result.after);
  const Points finish_shift = shifts_of(path, path.finish);
  const auto cell = [&out](double value) {  // + 0: no -0
    out += std::isnan(value) ? "," : "," + text(value + 0.0);
  };
  for (std::size_t i = 0; i < path.stations.size(); ++i) {
    const StationError& row = path.result.before[i];
    out += "\n" + text(way[i]);
    for (const double value : path.position[i]) cell(value);
    cell(error_of(row));
    cell(row.e ? row.spread : absent);
    for (const double value : row.peak_force) cell(value);
    for (const double value : row.peak_deflection) cell(value);
    out += row.stability ? "," + std::string(name(*row.stability)) : ",";
    cell(row.multiplier ? std::abs(*row.multiplier) : absent);
    out += "," + std::to_string(row.loops);
    if (chamfer) cell(path.width[i]);
    if (!corrected) continue;
    const StationError& after = path.result.after[i];
    for (const double value : shift[i]) cell(value);
    cell(error_of(after));
    if (chamfer) cell(path.width_after[i]);
    if (path.finish.empty()) continue;
    for (const double value : finish_shift[i]) cell(value);
  }
  return out + "\n";
}

namespace {

Series series_of(std::string name, std::string style, const std::vector<double>& x,
                 const std::vector<double>& y, double scale) {
  Series out{std::move(name), std::move(style), {}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isnan(y[i])) out.points.emplace_back(x[i], scale * y[i]);
  }
  return out;
}

Chart error_chart(const AlongJob& job, const PredictedPath& path, const std::vector<double>& way) {
  const std::vector<StationError>& rows = path.result.before;
  Chart chart{"Machining error (+ material left)",
              "way along the path [mm]",
              "um",
              {20, 30},
              {880, 260},
              {}};
  chart.series.push_back(series_of("predicted", "path", way, column(rows, error_of), 1e3));
  if (job.options.uncertainty) {
    for (const double sign : {-1.0, 1.0}) {
      chart.series.push_back(series_of(
          sign < 0 ? "spread" : "", "dimension", way,
          column(rows,
                 [sign](const StationError& r) { return r.e ? *r.e + sign * r.spread : absent; }),
          1e3));
    }
  }
  if (!path.result.after.empty()) {
    chart.series.push_back(
        series_of("after correction", "ridge", way, column(path.result.after, error_of), 1e3));
  }
  return chart;
}

Chart width_chart(const PredictedPath& path, const std::vector<double>& way) {
  Chart chart{"Width of the chamfer", "way along the path [mm]", "mm", {20, 290}, {880, 520}, {}};
  chart.series.push_back(series_of("predicted", "path", way, path.width, 1));
  const std::vector<double> wanted(way.size(), path.wanted_width);
  chart.series.push_back(series_of("asked", "axis", way, wanted, 1));
  if (!path.width_after.empty()) {
    chart.series.push_back(series_of("after correction", "ridge", way, path.width_after, 1));
  }
  return chart;
}

Chart force_chart(const PredictedPath& path, const std::vector<double>& way) {
  const std::vector<StationError>& rows = path.result.before;
  Chart chart{
      "Greatest force on the tool", "way along the path [mm]", "N", {20, 290}, {880, 520}, {}};
  chart.series.push_back(
      series_of("force", "path", way,
                column(rows, [](const StationError& r) { return r.peak_force.norm(); }), 1));
  return chart;
}

}  // namespace

std::string path_drawing(const AlongJob& job, const PredictedPath& path) {
  const std::vector<double> way = ways(path);
  Svg svg(900, 560, "Machining error along the path");
  draw(svg, error_chart(job, path, way));
  draw(svg, path.width.empty() ? force_chart(path, way) : width_chart(path, way));
  int chatter = 0, tested = 0;
  for (const StationError& row : path.result.before) {
    tested += row.stability ? 1 : 0;
    chatter += row.stability && *row.stability != cutting::Stability::Stable ? 1 : 0;
  }
  svg.text({20, 545}, fmt::format("{:g} rev/min; stability: {} of {} stations tested chatter",
                                  job.rpm, chatter, tested));
  return std::move(svg).finish();
}

}  // namespace ridgeline::jobs
