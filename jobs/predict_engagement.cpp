#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <iterator>

#include "core/cutting/modal_fit.hpp"
#include "jobs/predict_kinds.hpp"
#include "jobs/predict_page.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::Method;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr Choices<StabilityTest, 2> tests{
    {{"time_domain", StabilityTest::TimeDomain}, {"none", StabilityTest::None}}};

// The last deflection of the segment before, itself predicted, from whatever it began with.
cutting::Deflections warm_start(const Value& value, const Progress& progress) {
  Object before(value);
  cutting::Engagement engagement;
  read_case(before.required("case"), engagement);
  engagement.S = before.number("speed_rpm", speed_range) / 60;
  if (const std::optional<Value> options = before.optional("options")) {
    read_options(*options, engagement);
  }
  cutting::Deflections start;
  if (const std::optional<Value> warm = before.optional("warm_from")) {
    start = warm_start(*warm, progress);
  }
  before.finish();
  return cutting::predict(engagement, Method::Iterate, start, progress).prediction.D;
}

template <int size>
Json statistics(const std::vector<Eigen::Matrix<double, size, 1>>& samples) {
  using Sample = Eigen::Array<double, size, 1>;
  Sample sum = Sample::Zero(), squares = Sample::Zero();
  Sample least = samples.front(), most = samples.front();
  for (const auto& sample : samples) {
    sum += sample.array();
    squares += sample.array().square();
    least = least.min(sample.array());
    most = most.max(sample.array());
  }
  const auto count = static_cast<double>(samples.size());
  const auto row = [](const Sample& values) {
    return std::vector<double>(values.data(), values.data() + size);
  };
  return {{"mean", row(sum / count)},
          {"rms", row((squares / count).sqrt())},
          {"max", row(most)},
          {"min", row(least)}};
}

template <int size>
Array samples_array(std::string pointer,
                    const std::vector<Eigen::Matrix<double, size, 1>>& samples) {
  Array array{std::move(pointer), {samples.size(), static_cast<std::size_t>(size)}, {}};
  for (const auto& sample : samples) {
    array.values.insert(array.values.end(), sample.data(), sample.data() + size);
  }
  return array;
}

Json optional_number(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

// A whole number prints as one: 3, not 3.0.
Json weight(double w) {
  if (std::trunc(w) == w) return static_cast<int>(w);
  return w;
}

Json history_document(const cutting::Prediction& p) {
  Json changes = Json::array();
  for (const auto& [loop, w1] : p.weight_changes) changes.push_back({loop, weight(w1)});
  Json e_history = Json::array();
  for (const std::optional<double>& e : p.e_history) e_history.push_back(optional_number(e));
  return {{"w1_final", weight(p.w1)},
          {"weight_changes", changes},
          {"A", p.A},
          {"e_hist", e_history},
          {"cutoff_Hz", optional_number(p.cutoff)},
          {"tc_s", p.contact_time},
          {"cut_points", p.cut_points}};
}

Json document_of(const cutting::Predicted& predicted) {
  const cutting::Prediction& p = predicted.prediction;
  Json document = {{"job", "predict"},
                   {"status", "ok"},
                   {"method", name(predicted.method)},
                   {"fell_back", predicted.fell_back},
                   {"e_mm", optional_number(p.e)},
                   {"loops", p.loops},
                   {"converged", p.converged},
                   {"F_stats", statistics<3>(p.F)},
                   {"D_stats", statistics<2>(p.D)}};
  document.update(history_document(p));
  if (predicted.revolutions > 0) {
    document["revolutions"] = predicted.revolutions;
    document["change"] = predicted.change;
  }
  if (p.e) document["side"] = *p.e >= 0 ? "material_left" : "overcut";
  return document;
}

std::string csv_of(const cutting::Prediction& p) {
  std::string out = "theta_deg,Fx_N,Fy_N,Fz_N,Dx_mm,Dy_mm\n";
  const auto N = static_cast<double>(p.F.size());
  for (std::size_t i = 0; i < p.F.size(); ++i) {
    out += text(360.0 * static_cast<double>(i) / N);
    for (const double number : {p.F[i].x(), p.F[i].y(), p.F[i].z(), p.D[i].x(), p.D[i].y()}) {
      out += "," + text(number + 0.0);  // no -0
    }
    out += "\n";
  }
  return out;
}

std::string drawing_of(const cutting::Prediction& p, double rpm) {
  constexpr std::array styles{"path", "ridge", "outline"};
  constexpr std::array force_names{"Fx", "Fy", "Fz"};
  constexpr std::array deflection_names{"Dx", "Dy"};
  Chart force{"Force on the tool", "theta [degrees]", "N", {70, 40}, {770, 240}, {}};
  Chart deflection{"Deflection of the tool", "theta [degrees]", "um", {70, 320}, {770, 520}, {}};
  const double step = 360.0 / static_cast<double>(p.F.size());
  for (std::size_t c = 0; c < 3; ++c) {
    Series one{force_names[c], styles[c], {}};
    for (std::size_t i = 0; i < p.F.size(); ++i) {
      one.points.emplace_back(step * static_cast<double>(i), p.F[i][static_cast<Eigen::Index>(c)]);
    }
    force.series.push_back(std::move(one));
  }
  for (std::size_t c = 0; c < 2; ++c) {
    Series one{deflection_names[c], styles[c], {}};
    for (std::size_t i = 0; i < p.D.size(); ++i) {
      one.points.emplace_back(step * static_cast<double>(i),
                              1e3 * p.D[i][static_cast<Eigen::Index>(c)]);
    }
    deflection.series.push_back(std::move(one));
  }
  const std::string e = p.e ? fmt::format("error {:.2f} um", *p.e * 1e3) : "no cut";
  Svg svg(800, 580, "Force and deflection over one revolution");
  draw(svg, force);
  draw(svg, deflection);
  svg.text({70, 570}, fmt::format("{:g} rev/min, {}", rpm, e));
  return std::move(svg).finish();
}

}  // namespace

PredictJob read_predict_job(Object& job) {
  PredictJob out;
  read_case(job.required("case"), out.engagement);
  if (const std::optional<Value> options = job.optional("options")) {
    read_options(*options, out.engagement);
  }
  out.method = read_method(job);
  out.test = job.choice("stability", tests, StabilityTest::TimeDomain);
  return out;
}

Json stability_document(const PredictJob& job, std::vector<std::string>& warnings,
                        const Progress& progress) {
  if (job.test == StabilityTest::None) return nullptr;
  const auto& [cut, compliance, S, options, time, fall_back] = job.engagement;
  try {
    if (cutting::is_measured(compliance)) {
      warnings.emplace_back("stability is that of the modes fitted to the measured response");
    }
    return name(cutting::stability(cut, cutting::with_modes(compliance), S, progress));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::NotConverged) throw;
    warnings.push_back("stability is not known. " + std::string(error.what()));
    return nullptr;
  }
}

Answer predict_engagement(Object& job, const Request& request) {
  PredictJob read = read_predict_job(job);
  const double rpm = job.number("speed_rpm", speed_range);
  read.engagement.S = rpm / 60;
  const std::optional<Value> warm = job.optional("warm_from");
  job.finish();

  cutting::Deflections start;
  if (warm) start = warm_start(*warm, request.progress);
  const Clock::time_point begin = Clock::now();
  const cutting::Predicted predicted =
      cutting::predict(read.engagement, read.method, start, request.progress);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();

  Answer answer;
  if (request.format == "csv") answer.text = csv_of(predicted.prediction);
  if (request.format == "svg") answer.text = drawing_of(predicted.prediction, rpm);
  answer.document = document_of(predicted);
  std::vector<std::string> warnings;
  answer.document["speed_rpm"] = rpm;
  answer.document["stability"] = stability_document(read, warnings, request.progress);
  answer.document["solve_seconds"] = seconds;
  answer.document["warnings"] = warnings;
  if (request.format == "html") {
    answer.text = engagement_page(predicted.prediction, read.engagement.cut.n, answer.document);
  }
  answer.arrays.push_back(samples_array<3>("/F", predicted.prediction.F));
  answer.arrays.push_back(samples_array<2>("/D", predicted.prediction.D));
  return answer;
}

}  // namespace ridgeline::jobs
