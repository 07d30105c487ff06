#include "jobs/chamfer_comments.hpp"

#include "core/base/angle.hpp"
#include "jobs/chamfer_job.hpp"

namespace ridgeline::jobs {
namespace {

/// Enough digits for a person; a cutting amount gives an irrational width.
std::string rounded(double number) {
  constexpr double steps = 1e6;
  return text(std::round(number * steps) / steps);
}

std::string revision(const std::optional<int>& revision) {
  return revision ? " rev " + std::to_string(*revision) : " (inline)";
}

std::string section_angle(const chamfer::SectionAngle& angle) {
  if (const auto* constant = std::get_if<chamfer::ConstantAngle>(&angle)) {
    return rounded(degrees(constant->delta)) + " deg";
  }
  return std::holds_alternative<chamfer::Bisector>(angle) ? "bisector" : "table";
}

std::string tool_line(const ChamferJob& job) {
  const tool::Tool& tool = job.job.tool;
  std::string line = "tool";
  if (tool.number != 0) line += " T" + std::to_string(tool.number);
  if (!tool.name.empty()) line += " " + tool.name;
  line += revision(job.tool_revision) + ", ball radius " + rounded(tool.radius);
  if (tool.wear != 0) line += ", wear " + rounded(tool.wear);
  return line;
}

std::string passes_line(const chamfer::Job& job) {
  std::string line = std::string(name(job.direction)) + " milling, feed " + rounded(job.feed * 60) +
                     " mm/min at the " +
                     (job.feed_at == chamfer::FeedAt::Contact ? "contact" : "ball centre");
  if (job.pass_widths.size() > 1) {
    line += ", passes of width";
    for (const double width : job.pass_widths) line += " " + rounded(width);
  }
  if (job.spring_pass) line += ", spring pass";
  return line;
}

}  // namespace

std::vector<std::string> comments_of(const ChamferJob& job) {
  const chamfer::Job& j = job.job;
  return {
      "Ridgeline: chamfer of a hole edge, lengths in mm",
      "workpiece " + (j.workpiece.name.empty() ? std::string("without name") : j.workpiece.name) +
          revision(job.workpiece_revision) + ", hole " + j.hole,
      std::string(name(j.edge)) + " edge, " + std::string(name(j.side)) + " side, width " +
          rounded(j.width) + ", tolerance " + rounded(j.tolerance),
      "method " + std::string(name(j.method)) + ", section angle " + section_angle(j.section_angle),
      tool_line(job),
      passes_line(j),
      std::string("coordinates are of the ") +
          (j.control_point == chamfer::ControlPoint::Tip ? "tool tip" : "ball centre"),
  };
}

}  // namespace ridgeline::jobs
