#include "jobs/predict_along.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "jobs/predict_case.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::StabilityTest;
using Clock = std::chrono::steady_clock;

constexpr Choices<StabilityTest, 3> tests{{{"floquet", StabilityTest::Floquet},
                                           {"time_domain", StabilityTest::TimeDomain},
                                           {"none", StabilityTest::None}}};

constexpr double along_alpha = 1e-4;  // a warm start accepted at 0.01 is the old station's state
constexpr int along_loops = 100;      // what has not converged by then chatters, or nearly
constexpr int along_revolutions = 40;

cutting::CorrectOptions read_correct(const Value& value) {
  cutting::CorrectOptions correct;
  Object object(value);
  correct.residual = object.number("residual", between(1e-6, 1, "mm"), correct.residual);
  correct.relative = object.number("relative", between(0, 1, "of the error"), correct.relative);
  correct.max_shifts = object.integer("max_shifts", 1, 50, correct.max_shifts);
  correct.largest_shift =
      object.number("largest_shift", between(0.001, 1, "of the radius"), correct.largest_shift);
  enum class Aim { Surface, Width };
  constexpr Choices<Aim, 2> aims{{{"surface", Aim::Surface}, {"width", Aim::Width}}};
  correct.by_borders = object.choice("aim", aims, Aim::Surface) == Aim::Width;
  object.finish();
  return correct;
}

Material read_material_of(Object& job, const AlongSource& source, const Definitions& definitions) {
  if (const std::optional<Value> material = job.optional("material")) {
    return resolve_material(*material, definitions);
  }
  if (source.material) return find_material(*source.material, source.material_at, definitions);
  job.refuse("material",
             "a name of the library or a coefficient set: nothing says what is being cut");
}

void read_options_of(Object& job, AlongJob& out) {
  cutting::Engagement engagement;
  engagement.options.alpha = along_alpha;
  engagement.options.max_loops = along_loops;
  engagement.options.mixing = cutting::Mixing::Secants;
  engagement.time.max_revolutions = along_revolutions;
  if (const std::optional<Value> options = job.optional("options")) {
    read_options(*options, engagement);
  }
  out.options.iterate = engagement.options;
  out.options.time = engagement.time;
  out.options.fall_back = engagement.fall_back;
  out.options.method = read_method(job);
  out.options.stability = job.choice("stability", tests, StabilityTest::Floquet);
  out.options.stability_every = job.integer("stability_every", 1, 1'000'000, 0);
  constexpr int part = 128;
  out.options.part = part;
  out.options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
}

// About 1024 a revolution, a whole number each tooth pitch that a fast transform likes: then one
// tooth stands for all.
int usual_samples(int teeth) {
  constexpr int wanted = 1024;
  const auto is_smooth = [](int n) {
    for (const int prime : {2, 3, 5}) {
      while (n % prime == 0) n /= prime;
    }
    return n == 1;
  };
  int pitch = (wanted + teeth - 1) / teeth;
  while (!is_smooth(pitch)) ++pitch;
  return pitch * teeth;
}

void read_course(Object& job, const AlongSource& source, AlongJob& out) {
  const int elements = job.integer("nq", 8, 1024, 256);
  const std::optional<Value> given = job.optional("dynamics");
  const nlohmann::json& own = source.dynamics;
  out.tool = cutting_tool(source.tool, given ? *given : Value(own, "/tool/dynamics"), elements);
  out.compliance = out.tool.compliance;
  out.course.cutter = out.tool.cutter;
  out.course.coefficients = out.material.coefficients;
  out.course.spindle = source.tool.spindle;
  constexpr double most_places = 1 << 22;  // what a chip search may look at
  out.course.samples = job.integer("N", 16, 65536, usual_samples(source.tool.flutes));
  if (static_cast<double>(out.course.samples) * out.tool.cutter.elements > most_places) {
    job.refuse("N",
               "so small that N times the elements of a tooth is at most " + text(most_places));
  }
  out.course.earlier_teeth = job.integer("npast", 1, 16, 1);
  if (job.boolean("stock_limit", false)) out.course.chip_end = cutting::ChipEnd::StockLimited;
}

void read_uncertainty_of(Object& job, AlongJob& out) {
  if (const std::optional<Value> given = job.optional("uncertainty")) {
    out.options.uncertainty = read_uncertainty(*given);
  } else {
    out.options.uncertainty = out.material.uncertainty;
  }
}

}  // namespace

AlongJob read_along(Object& job, const AlongSource& source, const Definitions& definitions) {
  AlongJob out;
  out.material = read_material_of(job, source, definitions);
  read_course(job, source, out);
  read_options_of(job, out);
  read_uncertainty_of(job, out);
  if (!source.rpm || job.has("speed_rpm")) {
    out.rpm = job.number("speed_rpm", speed_range);
  } else {
    out.rpm = *source.rpm;
    if (!contains(speed_range, out.rpm)) {
      job.refuse("speed_rpm", "given where the path has no spindle speed");
    }
  }
  if (const std::optional<Value> correct = job.optional("correct")) {
    if (!correct->json().is_boolean()) {
      out.correct = read_correct(*correct);
    } else if (correct->boolean()) {
      out.correct.emplace();
    }
  }
  out.warnings = out.tool.warnings;
  if (out.material.is_estimate) {
    out.warnings.push_back("the cutting coefficients of " + shortened(out.material.name) +
                           " are an estimate");
  }
  return out;
}

void choose_tests(AlongJob& job, std::size_t stations) {
  if (job.options.stability_every < 1) {
    job.options.stability_every = static_cast<int>((stations + most_tests - 1) / most_tests);
  }
}

void refuse_chatter(const std::vector<cutting::Station>& stations,
                    const std::vector<cutting::StationError>& errors, double radius) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto& stability = errors[i].stability;
    if (!stability || *stability == cutting::Stability::Stable) continue;
    ErrorDetails details;
    details.field = "/correct";
    details.value = name(*stability);
    details.limit = "a stable cut: another spindle_speed, a smaller width or a stiffer tool";
    details.target = Eigen::Vector3d(stations[i].centre - radius * stations[i].n);
    throw Error(ErrorCode::NotConverged,
                "correction: the cut is " + details.value +
                    " there, so that its error is not steady and no path takes it away; must be " +
                    details.limit,
                details);
  }
}

std::vector<cutting::StationError> predicted(AlongJob job,
                                             const std::vector<cutting::Station>& stations,
                                             const Progress& progress) {
  choose_tests(job, stations.size());
  return cutting::along(job.course, stations, job.compliance, job.S(), job.options, progress);
}

std::vector<cutting::StationError> corrected(AlongJob job,
                                             const std::vector<cutting::Station>& stations,
                                             const cutting::CorrectOptions& limits,
                                             const Progress& progress) {
  choose_tests(job, stations.size());
  std::vector<cutting::StationError> out = cutting::corrected(
      job.course, stations, job.compliance, job.S(), job.options, limits, progress);
  refuse_chatter(stations, out, job.course.cutter.r);
  return out;
}

AlongResult run_along(AlongJob job, const std::vector<cutting::Station>& stations,
                      const Progress& progress) {
  const Clock::time_point begin = Clock::now();
  AlongResult out;
  const double half = job.correct ? 0.5 : 1;
  out.before = predicted(job, stations, progress.part(0, half));
  if (job.correct) {
    refuse_chatter(stations, out.before, job.course.cutter.r);
    out.after = corrected(job, stations, *job.correct, progress.part(half, 1));
  }
  out.solve_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return out;
}

}  // namespace ridgeline::jobs
