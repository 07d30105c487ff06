#include "jobs/check.hpp"

#include <cmath>

#include "jobs/text.hpp"

namespace ridgeline::jobs {
namespace {

/// For people: digits beyond are noise.
double to_nanometre(double length) {
  constexpr double steps = 1e6;
  return std::round(length * steps) / steps;
}

Failure failure(ErrorCode code, const std::string& what, double value, const std::string& limit,
                const std::optional<verify::Place>& place) {
  ErrorDetails details;
  details.value = text(to_nanometre(value)) + " mm";
  details.limit = limit;
  if (place) details.target = place->point;
  const std::string message = what + " is " + details.value + ", must be " + limit;
  return {Error(code, message, details),
          place ? std::optional(place->move) : std::optional<std::size_t>()};
}

Failure width_failure(const std::string& what, double value, double u, const std::string& limit) {
  ErrorDetails details;
  details.value = text(to_nanometre(value)) + " mm";
  details.limit = limit;
  details.parameter = u;
  const std::string message = what + " is " + details.value + ", must be " + limit;
  return {Error(ErrorCode::VerificationFailed, message, details), std::nullopt};
}

nlohmann::json place_document(const std::optional<verify::Place>& place) {
  if (!place) return nullptr;
  return {{"move", place->move}, {"point", {place->point.x(), place->point.y(), place->point.z()}}};
}

nlohmann::json number_or_null(const std::optional<double>& number) {
  if (!number || !std::isfinite(*number)) return nullptr;
  return *number;
}

}  // namespace

verify::Subject subject_of(const ChamferJob& job, const Eigen::Vector3d& tool_axis) {
  const chamfer::Job& j = job.job;
  const auto hole = std::ranges::find(j.workpiece.holes, j.hole, &geometry::Hole::name);
  if (hole == j.workpiece.holes.end()) {
    throw Error(ErrorCode::Internal, "the job's hole is not in its workpiece");
  }
  verify::Subject subject;
  subject.workpiece = j.workpiece;
  subject.edge = geometry::edge_of(j.workpiece, *hole, j.edge, j.side);
  subject.tool = j.tool;
  subject.tool_axis = tool_axis;
  subject.control_to_centre =
      j.control_point == chamfer::ControlPoint::Tip ? tool::cutting_radius(j.tool) : 0;
  subject.width = j.width;
  subject.clearance = j.clearance;
  return subject;
}

std::vector<Failure> failures(const ChamferJob& job, const verify::Subject& subject,
                              const verify::Report& report) {
  std::vector<Failure> failed;
  const std::string clear = "greater than 0 mm";
  if (report.neck_clearance && !(*report.neck_clearance > 0)) {
    failed.push_back(failure(ErrorCode::NeckCollision, "clearance of neck and shank",
                             *report.neck_clearance, clear, report.neck_at));
  }
  if (report.holder_clearance && !(*report.holder_clearance > 0)) {
    failed.push_back(failure(ErrorCode::HolderCollision, "clearance of the holder",
                             *report.holder_clearance, clear, report.holder_at));
  }
  const double limit = width_limit(job);
  if (!(report.overcut <= limit)) {
    failed.push_back(failure(ErrorCode::ToolTooLarge, "the cut outside the chamfer", report.overcut,
                             "at most " + text(limit) + " mm deep", report.overcut_at));
  }
  if (!(report.rapid_clearance > 0)) {
    failed.push_back(failure(ErrorCode::VerificationFailed, "clearance of rapids",
                             report.rapid_clearance, clear, report.rapid_at));
  }
  const std::string width = text(subject.width) + " mm within " + text(limit) + " mm";
  if (!(report.width_min >= subject.width - limit)) {
    failed.push_back(
        width_failure("the least width", report.width_min, report.width_min_at, width));
  }
  if (!(report.width_max <= subject.width + limit)) {
    failed.push_back(
        width_failure("the greatest width", report.width_max, report.width_max_at, width));
  }
  return failed;
}

bool is_width(const Failure& failure) {
  return failure.error.code() == ErrorCode::VerificationFailed &&
         failure.error.details().parameter.has_value();
}

nlohmann::json report_document(const verify::Report& report) {
  return {{"width_min", report.width_min},
          {"width_max", report.width_max},
          {"width_min_at", report.width_min_at},
          {"width_max_at", report.width_max_at},
          {"overcut", report.overcut},
          {"overcut_at", place_document(report.overcut_at)},
          {"neck_clearance", number_or_null(report.neck_clearance)},
          {"neck_at", place_document(report.neck_at)},
          {"holder_clearance", number_or_null(report.holder_clearance)},
          {"holder_at", place_document(report.holder_at)},
          {"rapid_clearance", number_or_null(report.rapid_clearance)},
          {"rapid_at", place_document(report.rapid_at)},
          {"closing_error", report.closing_error},
          {"path_length", report.path_length},
          {"cutting_time", report.cutting_time}};
}

std::vector<std::string> unchecked(const verify::Report& report) {
  std::vector<std::string> warnings;
  if (!report.neck_clearance) {
    warnings.emplace_back("neck and shank of the tool are not described: not checked");
  }
  if (!report.holder_clearance) {
    warnings.emplace_back("the holder of the tool is not described: not checked");
  }
  return warnings;
}

}  // namespace ridgeline::jobs
