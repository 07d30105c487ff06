#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/angle.hpp"
#include "core/nc/reader.hpp"
#include "jobs/chamfer_job.hpp"
#include "jobs/check.hpp"
#include "jobs/kinds.hpp"

namespace ridgeline::jobs {
namespace {

/// The directions that the job's tool axis can mean: "hole" and "bore" leave the sense open.
std::vector<Eigen::Vector3d> tool_axes(const chamfer::Job& job) {
  if (const auto* axis = std::get_if<Eigen::Vector3d>(&job.tool_axis)) return {*axis};
  const auto hole = std::ranges::find(job.workpiece.holes, job.hole, &geometry::Hole::name);
  const bool is_bore = std::get<chamfer::Access>(job.tool_axis) == chamfer::Access::Bore;
  const Eigen::Vector3d axis = is_bore ? job.workpiece.axis : hole->axis;
  return {axis, -axis};
}

struct Measured {
  std::optional<verify::Report> report;  ///< absent: there is nothing to measure
  std::vector<Failure> failed;
};

/// A motion that never meets the edge is a failure of the program, not of the request.
Measured measure(const ChamferJob& job, const path::Motion& motion, const Eigen::Vector3d& axis,
                 const Progress& progress) {
  const verify::Subject subject = subject_of(job, axis);
  try {
    const verify::Report report = verify::measure(subject, motion, progress);
    return {report, failures(job, subject, report)};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::BadInput) throw;
    return {std::nullopt, {{Error(ErrorCode::VerificationFailed, error.what()), std::nullopt}}};
  }
}

/// The angle between two directions [rad].
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

constexpr double same_axis = radians(0.01);  // a tilted plane is given in angles of 0.001 degrees

/// With the axis that the program itself sets, else with the sense that fails least.
Measured measure_best(const ChamferJob& job, const nc::Reading& reading, const Progress& progress) {
  std::optional<Measured> best;
  for (const Eigen::Vector3d& axis : tool_axes(job.job)) {
    if (reading.tool_axis && angle_between(*reading.tool_axis, axis) > same_axis) continue;
    Measured measured =
        measure(job, reading.motion, axis, best ? progress.part(0.5, 1) : progress.part(0, 0.5));
    const auto badness = [](const Measured& m) { return std::pair(!m.report, m.failed.size()); };
    const bool is_better = !best || badness(measured) < badness(*best);
    if (is_better) best = std::move(measured);
    if (best->failed.empty()) break;
  }
  if (best) return *std::move(best);
  const Eigen::Vector3d& axis = *reading.tool_axis;
  ErrorDetails details;
  details.value = "[" + text(axis.x()) + ", " + text(axis.y()) + ", " + text(axis.z()) + "]";
  details.limit = "the job's tool axis within 0.01 degrees";
  Measured measured = measure(job, reading.motion, axis, progress);
  measured.failed.insert(
      measured.failed.begin(),
      Failure{Error(ErrorCode::VerificationFailed,
                    "the program's tool axis is " + details.value + ", must be " + details.limit,
                    details),
              std::nullopt});
  return measured;
}

/// Klartext counts datums: its 1 is the others' G54.
bool is_same_offset(const std::string& read, const std::string& asked) {
  if (read == asked) return true;
  const bool is_counted = asked.size() == 3 && asked.starts_with("G5") && asked[2] >= '4';
  return is_counted && read == std::string(1, static_cast<char>(asked[2] - 3));
}

/// What differs between the program and the job without making the cut wrong.
std::vector<std::string> warnings(const ChamferJob& job, const nc::Reading& reading,
                                  const std::optional<verify::Report>& report) {
  std::vector<std::string> all;
  if (report) all = unchecked(*report);
  const int tool = job.job.tool.number;
  if (reading.tool_number && tool != 0 && *reading.tool_number != tool) {
    all.push_back("the program calls tool " + std::to_string(*reading.tool_number) +
                  ", the job says " + std::to_string(tool));
  }
  if (!reading.work_offset.empty() &&
      !is_same_offset(reading.work_offset, job.program.work_offset)) {
    all.push_back("the program works in " + reading.work_offset + ", the job says " +
                  job.program.work_offset);
  }
  if (reading.spindle_clockwise && *reading.spindle_clockwise != job.program.spindle_clockwise) {
    all.emplace_back("the program turns the spindle against the tool's cutting sense");
  }
  if (reading.unmeasured_line) {
    all.push_back("the rapids from line " + std::to_string(*reading.unmeasured_line) +
                  " on are not measured: another plane, offset or tool length than the cut's");
  }
  if (report && report->rapid_clearance < job.job.clearance) {
    all.push_back("rapids come within " + text(report->rapid_clearance) +
                  " mm of the part, the job asks for " + text(job.job.clearance) + " mm");
  }
  return all;
}

nlohmann::json failure_document(const Failure& failure, const nc::Reading& reading) {
  nlohmann::json document = refusal(failure.error).document.at("error");
  if (failure.move) document["line"] = reading.lines.at(*failure.move);
  return document;
}

}  // namespace

Answer verify(const Request& request) {
  Object object{Value(request.document)};
  object.required("job");
  const Value program = object.required("program");
  const ChamferJob job = read_chamfer_job(object.required("against"), request.definitions);
  object.finish();
  const nc::Reading reading = nc::read(program.string(), {}, request.progress.part(0, 0.3));
  const Measured measured = measure_best(job, reading, request.progress.part(0.3, 1));

  Answer answer;
  answer.document = {
      {"job", "verify"},
      {"status", measured.failed.empty() ? "ok" : "failed"},
      {"report", measured.report ? report_document(*measured.report) : nlohmann::json()},
      {"failures", nlohmann::json::array()},
      {"limits",
       {{"width", job.job.width},
        {"width_error", width_limit(job)},
        {"overcut", width_limit(job)},
        {"clearance", 0}}},
      {"warnings", warnings(job, reading, measured.report)}};
  for (const Failure& failure : measured.failed) {
    answer.document["failures"].push_back(failure_document(failure, reading));
  }
  return answer;
}

}  // namespace ridgeline::jobs
