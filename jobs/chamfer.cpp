#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/nc/cl.hpp"
#include "jobs/chamfer_job.hpp"
#include "jobs/chamfer_macro.hpp"
#include "jobs/chamfer_page.hpp"
#include "jobs/chamfer_program.hpp"
#include "jobs/check.hpp"
#include "jobs/drawing.hpp"
#include "jobs/kinds.hpp"
#include "jobs/motion.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A solved job with the certificate of its program: the motion as the program says it, measured.
/// The motion of `result` is in `program`.
struct Solved {
  chamfer::Result result;
  nc::Program program;
  path::Motion rounded;
  verify::Subject subject;
  verify::Report report;
  double verify_seconds = 0;
};

Solved solve(const ChamferJob& job, double tolerance, const Progress& progress) {
  chamfer::Job core_job = job.job;
  core_job.tolerance = tolerance;
  Solved solved;
  solved.result = chamfer::solve(core_job, progress.part(0, 0.55));
  solved.program = job.program;
  solved.program.motion = std::move(solved.result.motion);
  solved.program.tool_axis = solved.result.tool_axis;
  const Clock::time_point begin = Clock::now();
  solved.rounded = nc::rounded(solved.program, progress.part(0.55, 0.65));
  solved.subject = subject_of(job, solved.result.tool_axis);
  solved.report = verify::measure(solved.subject, solved.rounded, progress.part(0.65, 1));
  solved.verify_seconds = seconds_since(begin);
  return solved;
}

/// A swept path that chooses its points keeps the width; a section path shows what the section
/// method gives, and a chosen number of points what so many give.
bool keeps_width(const ChamferJob& job) {
  return job.job.method == chamfer::Method::Swept && !job.job.points;
}

/// By how much the measured width misses the asked one.
double width_error(const Solved& solved) {
  const double W = solved.subject.width;
  return std::max(W - solved.report.width_min, solved.report.width_max - W);
}

/// Where the surfaces meet at a blunt angle, the width changes by more than the path does: solves
/// again with the tolerance that the width needs.
Solved solve_to_width(const ChamferJob& job, const Progress& progress) {
  double tolerance = job.job.tolerance;
  Solved solved = solve(job, tolerance, progress);
  if (!keeps_width(job)) return solved;
  constexpr int most_repeats = 3;
  constexpr double margin = 0.9;
  constexpr double least_share =
      1e-3;  // of the tolerance: what such chords miss, no finer ones mend
  const double limit = width_limit(job);
  for (int i = 0; i < most_repeats && width_error(solved) > limit; ++i) {
    tolerance *= margin * limit / width_error(solved);
    if (tolerance < least_share * job.job.tolerance) break;
    solved = solve(job, tolerance, progress);
  }
  return solved;
}

/// Throws the first failure of a program that must not be emitted.
void refuse_failures(const ChamferJob& job, const Solved& solved) {
  for (const Failure& failure : failures(job, solved.subject, solved.report)) {
    if (!is_width(failure) || keeps_width(job)) throw failure.error;
  }
}

nlohmann::json named(const std::string& name, const std::optional<int>& revision) {
  nlohmann::json document = {{"name", nullptr}, {"revision", nullptr}};
  if (!name.empty()) document["name"] = name;
  if (revision) document["revision"] = *revision;
  return document;
}

nlohmann::json report(const Solved& solved) {
  nlohmann::json document = report_document(solved.report);
  document["points"] = solved.result.centres.size();
  document["points_optimal"] = solved.result.points_optimal;
  document["chord_error"] = solved.result.chord_error;
  document["solve_seconds"] = solved.result.solve_seconds;
  document["verify_seconds"] = solved.verify_seconds;
  return document;
}

std::vector<std::string> warnings(const ChamferJob& job, const Solved& solved) {
  std::vector<std::string> all = job.warnings;
  for (const std::string& warning : solved.result.warnings) {
    if (std::ranges::find(all, warning) == all.end()) all.push_back(warning);
  }
  for (const std::string& warning : unchecked(solved.report)) {
    if (std::ranges::find(all, warning) == all.end()) all.push_back(warning);
  }
  return all;
}

Array ends_array(const chamfer::Result& result, const Progress& progress) {
  Array array{"/ends", {result.G1.size(), 6}, {}};
  array.values.reserve(6 * result.G1.size());
  for (std::size_t i = 0; i < result.G1.size(); ++i) {
    progress.step(i, result.G1.size(), "answer");
    const Eigen::Vector3d &a = result.G1[i], &b = result.G2[i];
    array.values.insert(array.values.end(), {a.x(), a.y(), a.z(), b.x(), b.y(), b.z()});
  }
  return array;
}

Answer document_of(const ChamferJob& job, const Solved& solved) {
  const chamfer::Job& j = job.job;
  const chamfer::Result& result = solved.result;
  nlohmann::json tool = named(j.tool.name, job.tool_revision);
  tool["number"] = j.tool.number == 0 ? nlohmann::json(nullptr) : nlohmann::json(j.tool.number);
  Answer answer;
  answer.document = {
      {"job", "chamfer"},
      {"status", "ok"},
      {"method", name(j.method)},
      {"workpiece", named(j.workpiece.name, job.workpiece_revision)},
      {"hole", j.hole},
      {"edge", name(j.edge)},
      {"side", name(j.side)},
      {"tool", tool},
      {"tool_axis", {result.tool_axis.x(), result.tool_axis.y(), result.tool_axis.z()}},
      {"width", j.width},
      {"tolerance", j.tolerance},
      {"report", report(solved)},
      {"warnings", warnings(job, solved)}};
  return answer;
}

/// The rows are the directions that centres of arcs refer to where the work plane is tilted.
void add_plane(const Solved& solved, Answer& answer) {
  const Eigen::Matrix3d axes = nc::plane_axes(solved.program);
  if (axes.isIdentity(0)) return;
  Json rows = Json::array();
  for (int n = 0; n < 3; ++n) rows.push_back({axes(0, n), axes(1, n), axes(2, n)});
  answer.document["plane_axes"] = rows;
}

void add_arrays(const Solved& solved, const Progress& progress, Answer& answer) {
  const chamfer::Result& result = solved.result;
  answer.arrays.push_back({"/parameter", {result.parameter.size()}, result.parameter});
  answer.arrays.push_back(points_array("/targets", result.targets, progress.part(0, 0.2)));
  answer.arrays.push_back(points_array("/centres", result.centres, progress.part(0.2, 0.4)));
  answer.arrays.push_back(ends_array(result, progress.part(0.4, 0.6)));
  answer.arrays.push_back(
      moves_array("/moves", solved.rounded, answer.document, progress.part(0.6, 1)));
}

std::string text_of(const ChamferJob& job, Solved solved, const nlohmann::json& document,
                    std::string_view format, const Progress& progress) {
  if (format == "nc") return nc::write(solved.program, progress);
  if (format == "cl")
    return nc::write_cl(std::move(solved.program), nc::cl_arc_tolerance, progress);
  if (format == "csv") return nc::write_csv(solved.rounded, progress);
  if (format == "macro") return chamfer_macro(job);
  if (format == "svg")
    return chamfer_drawing(job.job, solved.subject.edge, solved.result, progress);
  if (format == "html") {
    return chamfer_page(job, solved.result, solved.rounded, solved.subject, document, progress);
  }
  throw Error(ErrorCode::Internal, "a format that chamfer jobs list but do not write");
}

}  // namespace

Answer chamfer(const Request& request) {
  ChamferJob job = read_chamfer_job(Value(request.document), request.definitions);
  if (request.format == "macro") job.job.method = chamfer::Method::Section;  // all it can compute
  chamfer::validate(job.job);
  Solved solved = solve_to_width(job, request.progress.part(0, 0.8));
  refuse_failures(job, solved);
  const Progress rest = request.progress.part(0.8, 1);
  Answer answer = document_of(job, solved);
  if (job.job.arcs) add_plane(solved, answer);
  if (request.format == "json") {
    add_arrays(solved, rest, answer);
  } else {
    answer.text = text_of(job, std::move(solved), answer.document, request.format, rest);
  }
  return answer;
}

InlineProgram inline_program(const nlohmann::json& document, const Definitions& definitions,
                             const Progress& progress) {
  ChamferJob job = read_chamfer_job(Value(document), definitions);
  job.program.kind = nc::ProgramKind::Inline;
  chamfer::validate(job.job);
  const Solved solved = solve_to_width(job, progress.part(0, 0.8));
  refuse_failures(job, solved);
  return {nc::write(solved.program, progress.part(0.8, 1)), report(solved)};
}

}  // namespace ridgeline::jobs
