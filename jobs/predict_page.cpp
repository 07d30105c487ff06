#include "jobs/predict_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jobs/page.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::StationError;
using Json = nlohmann::json;
using Style = PageSeries::Style;
using Values = std::vector<double>;

constexpr double gap = std::numeric_limits<double>::quiet_NaN();
constexpr double micrometres = 1e3;
constexpr std::size_t most_samples = 6000;  // of a chart: several a pixel
constexpr std::string_view no_cut = "nothing is cut";

/// Component c of every sample.
template <typename Samples>
Values component(const Samples& samples, Eigen::Index c) {
  Values out;
  out.reserve(samples.size());
  for (const auto& sample : samples) out.push_back(sample[c]);
  return out;
}

/// The numbers of an array of a document; null is a gap.
Values numbers(const Json& array) {
  Values out;
  for (const Json& each : array) out.push_back(each.is_null() ? gap : each.get<double>());
  return out;
}

double number(const std::optional<double>& value) {
  return value.value_or(gap);
}

Values counted(std::size_t count) {
  Values out;
  for (std::size_t i = 1; i <= count; ++i) out.push_back(static_cast<double>(i));
  return out;
}

std::string word(const Json& value, std::string_view missing) {
  return value.is_string() ? value.get<std::string>() : std::string(missing);
}

Json page_data(std::string title, std::string subtitle, const Json& document) {
  return {{"job", "predict"},
          {"title", std::move(title)},
          {"subtitle", std::move(subtitle)},
          {"warnings", document.at("warnings")}};
}

}  // namespace

std::string engagement_page(const cutting::Prediction& prediction, const Eigen::Vector3d& n,
                            const Json& document) {
  const cutting::Forces& F = prediction.F;
  const cutting::Deflections& D = prediction.D;
  Values theta, across;
  for (std::size_t i = 0; i < D.size(); ++i) {
    theta.push_back(360.0 * static_cast<double>(i) / static_cast<double>(D.size()));
    across.push_back(D[i].dot(n.head<2>()));
  }
  Json data = page_data("Machining error of one engagement",
                        fmt::format("{:g} rev/min, {}, {}", document.at("speed_rpm").get<double>(),
                                    document.at("method").get<std::string>(),
                                    word(document.at("stability"), "stability not known")),
                        document);
  data["along"] = page_axis("angle of the tool \xCE\xB8 [degrees]", theta);
  data["charts"] = document_of(std::vector<PageChart>{
      {"Force on the tool",
       "N",
       {{"Fx", component(F, 0)}, {"Fy", component(F, 1)}, {"Fz", component(F, 2)}}},
      {"Deflection of the tool",
       "\xC2\xB5m",
       {{"Dx", component(D, 0)}, {"Dy", component(D, 1)}},
       micrometres},
      {"Deflection out of the surface, and the error that is left",
       "\xC2\xB5m",
       {{"deflection", across}, {"error", Values(D.size(), number(prediction.e)), Style::Guide}},
       micrometres}});
  Values history;
  for (const std::optional<double>& e : prediction.e_history) history.push_back(number(e));
  Json loops = document_of(std::vector<PageChart>{
      {"Error after each loop", "\xC2\xB5m", {{"error", history}}, micrometres}});
  loops[0]["x"] = page_axis("loop", counted(history.size()));
  if (history.size() > 1) data["charts"].push_back(loops[0]);
  data["report"] = page_rows(document, {{"e_mm", "error (+ material left)", "mm", no_cut.data()},
                                        {"stability", "stability", "", "not known"},
                                        {"speed_rpm", "spindle speed", "rev/min"},
                                        {"method", "method", ""},
                                        {"loops", "loops", ""},
                                        {"converged", "converged", ""},
                                        {"F_stats/max", "greatest Fx, Fy, Fz", "N"},
                                        {"F_stats/min", "least Fx, Fy, Fz", "N"},
                                        {"F_stats/mean", "mean Fx, Fy, Fz", "N"},
                                        {"D_stats/max", "greatest Dx, Dy", "mm"},
                                        {"D_stats/min", "least Dx, Dy", "mm"},
                                        {"cut_points", "cutting points of the edges", ""}});
  return page(data);
}

std::string sweep_page(const Json& document) {
  const Values speeds = numbers(document.at("speed_rpm"));
  const Values e = numbers(document.at("e_mm"));
  const Json& stability = document.at("stability");
  Values chatter(e.size(), gap);
  Json labels = Json::array();
  int chattering = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const std::string found = word(stability[i], "stability not known");
    const bool chatters = stability[i].is_string() && found != "stable";
    if (chatters) chatter[i] = e[i];
    chattering += chatters ? 1 : 0;
    labels.push_back(fmt::format("{:g} rev/min: {}, {}, {} loops", speeds[i], found,
                                 document.at("method")[i].get<std::string>(),
                                 document.at("loops")[i].get<int>()));
  }
  Json data = page_data("Machining error against spindle speed",
                        fmt::format("{} speeds, {} chatter", speeds.size(), chattering), document);
  data["along"] = page_axis("spindle speed [rev/min]", speeds);
  data["along"]["labels"] = labels;
  data["charts"] = document_of(std::vector<PageChart>{
      {"Machining error (+ material left)",
       "\xC2\xB5m",
       {{"error", e}, {"chatters", chatter, Style::Dots}},
       micrometres},
      {"Loops until it converged", "", {{"loops", numbers(document.at("loops"))}}}});
  return page(data);
}

std::string lobes_page(const Values& speeds, const Values& limits, const Json& document) {
  const auto deepest = document.at("deepest_tried").get<double>();
  Values none(limits.size(), gap);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (std::isnan(limits[i])) none[i] = deepest;
  }
  Json data = page_data("Stability lobes",
                        fmt::format("depth \"{}\" at which a deviation from the steady cut begins "
                                    "to grow, up to {:g} mm",
                                    document.at("depth_of").get<std::string>(), deepest),
                        document);
  data["along"] = page_axis("spindle speed [rev/min]", speeds);
  std::vector<PageSeries> series{{"chatters above", limits}};
  if (std::ranges::any_of(none, [](double v) { return std::isfinite(v); })) {
    series.push_back({"stable to the deepest tried", none, Style::Dots});
  }
  data["charts"] =
      document_of(std::vector<PageChart>{{"Depth of cut where chatter begins", "mm", series}});
  return page(data);
}

namespace {

PageMotion motion_of(const AlongJob& job, const PredictedPath& path) {
  PageMotion drawn;
  drawn.names = {"cut", "rapid"};
  drawn.start = path.position.front();
  const double rate = job.rpm * cutting::teeth(job.course.cutter);
  const auto add = [&](std::size_t station, bool cuts) {
    drawn.kinds.push_back(cuts ? 0 : 1);
    drawn.to.push_back(path.position[station]);
    drawn.feeds.push_back(cuts ? path.stations[station].feed * rate : 0);
    drawn.moves.push_back(station);
  };
  for (std::size_t i = 1; i < path.position.size(); ++i) {
    add(i, !std::ranges::binary_search(path.entries, i));
  }
  if (path.is_closed) add(0, true);
  return drawn;
}

/// What the charts of a path share: which stations they show.
class Shown {
public:
  explicit Shown(const PredictedPath& path)
      : path_(path), step_(1 + path.stations.size() / most_samples) {}

  template <typename Of>
  Values of(const std::vector<StationError>& rows, const Of& value) const {
    Values out;
    for (std::size_t i = 0; i < rows.size(); i += step_) out.push_back(value(rows[i]));
    return out;
  }
  Values some(const Values& all) const {
    Values out;
    for (std::size_t i = 0; i < all.size(); i += step_) out.push_back(all[i]);
    return out;
  }
  /// Length along the path, gaps between cuts included.
  Values way() const {
    Values all{0};
    for (std::size_t i = 1; i < path_.position.size(); ++i) {
      all.push_back(all.back() + (path_.position[i] - path_.position[i - 1]).norm());
    }
    return some(all);
  }

private:
  const PredictedPath& path_;
  std::size_t step_;
};

double error_of(const StationError& row) {
  return number(row.e);
}

bool chatters(const StationError& row) {
  return row.stability && *row.stability != cutting::Stability::Stable;
}

PageChart error_chart(const AlongJob& job, const PredictedPath& path, const Shown& shown) {
  const std::vector<StationError>& rows = path.result.before;
  PageChart chart{"Machining error (+ material left)",
                  "\xC2\xB5m",
                  {{"predicted", shown.of(rows, error_of)}},
                  micrometres};
  if (!path.result.after.empty()) {
    chart.series.push_back({"after correction", shown.of(path.result.after, error_of)});
  }
  if (job.options.uncertainty) {
    const auto beside = [&](double sign) {
      return shown.of(rows,
                      [sign](const StationError& r) { return r.e ? *r.e + sign * r.spread : gap; });
    };
    chart.series.push_back({"+ spread", beside(1), Style::Guide});
    chart.series.push_back({"- spread", beside(-1), Style::Guide});
  }
  if (std::ranges::any_of(rows, chatters)) {
    chart.series.push_back(
        {"chatters",
         shown.of(rows, [](const StationError& r) { return chatters(r) ? number(r.e) : gap; }),
         Style::Dots});
  }
  return chart;
}

PageChart width_chart(const PredictedPath& path, const Shown& shown) {
  PageChart chart{"Width of the chamfer", "mm", {{"predicted", shown.some(path.width)}}};
  if (!path.width_after.empty()) {
    chart.series.push_back({"after correction", shown.some(path.width_after)});
  }
  chart.series.push_back(
      {"asked", Values(chart.series.front().values.size(), path.wanted_width), Style::Guide});
  return chart;
}

std::vector<PageChart> charts_of(const AlongJob& job, const PredictedPath& path,
                                 const Shown& shown) {
  const std::vector<StationError>& rows = path.result.before;
  std::vector<PageChart> charts{error_chart(job, path, shown)};
  if (!path.width.empty()) charts.push_back(width_chart(path, shown));
  charts.push_back(
      {"Greatest force on the tool",
       "N",
       {{"force", shown.of(rows, [](const StationError& r) { return r.peak_force.norm(); })}}});
  charts.push_back(
      {"Greatest deflection of the tool",
       "\xC2\xB5m",
       {{"deflection",
         shown.of(rows, [](const StationError& r) { return r.peak_deflection.norm(); })}},
       micrometres});
  const auto is_tested = [](const StationError& r) { return r.multiplier.has_value(); };
  if (std::ranges::any_of(rows, is_tested)) {
    const Values growth = shown.of(
        rows, [](const StationError& r) { return r.multiplier ? std::abs(*r.multiplier) : gap; });
    charts.push_back(
        {"Growth of a deviation in a revolution (1: chatter begins)",
         "",
         {{"multiplier", growth, Style::Dots}, {"limit", Values(growth.size(), 1), Style::Guide}}});
  }
  return charts;
}

Json report_rows(const Json& document) {
  Json rows = page_rows(document, {{"material/name", "material", ""},
                                   {"speed_rpm", "spindle speed", "rev/min"},
                                   {"method", "method", ""},
                                   {"width_asked", "asked width", "mm"}});
  const Json report = page_rows(
      document, {{"report/stations", "stations", ""},
                 {"report/stations_cutting", "stations that make the surface", ""},
                 {"report/error/min", "least error", "mm", no_cut.data()},
                 {"report/error/max", "greatest error", "mm", no_cut.data()},
                 {"report/error/rms", "error, rms", "mm", no_cut.data()},
                 {"corrected/report/error/rms", "error after correction, rms", "mm", no_cut.data()},
                 {"report/width/min", "least width", "mm", no_cut.data()},
                 {"report/width/max", "greatest width", "mm", no_cut.data()},
                 {"corrected/report/width/min", "least width after correction", "mm"},
                 {"corrected/report/width/max", "greatest width after correction", "mm"},
                 {"report/force_peak", "greatest force", "N"},
                 {"report/deflection_peak", "greatest deflection", "mm"},
                 {"report/stability_tested", "stations tested for chatter", ""},
                 {"report/chattering", "of them chatter", ""},
                 {"report/not_converged", "stations that did not converge", ""},
                 {"report/fell_back", "stations by the time domain", ""}});
  rows.insert(rows.end(), report.begin(), report.end());
  return rows;
}

}  // namespace

std::string path_page(const AlongJob& job, const PredictedPath& path, const Json& document,
                      const Json& scene) {
  const Shown shown(path);
  const Values way = shown.way();
  Json data =
      page_data(fmt::format("Machining error along a {}", path.kind),
                fmt::format("{:g} rev/min, {}{}", job.rpm, document.at("method").get<std::string>(),
                            path.result.after.empty() ? "" : ", corrected"),
                document);
  data["motion"] = document_of(motion_of(job, path));
  data["along"] = page_axis("way along the path [mm]", way, way);
  data["charts"] = document_of(charts_of(job, path, shown));
  data["color"] = 0;  // the path shows the error
  data["report"] = report_rows(document);
  data.update(scene);
  return page(data);
}

}  // namespace ridgeline::jobs
