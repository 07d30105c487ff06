#pragma once

#include <numbers>

#include "core/chamfer/job.hpp"
#include "core/verify/measure.hpp"

namespace ridgeline::chamfer {

/// Bore 20, hole 8, axis offset 3, lollipop 5.8, as a commercial path service orders it; edge
/// break 0.3.
inline Job cross_hole() {
  Job job;
  job.workpiece.inner_radius = 10;
  job.workpiece.outer_radius = 16;
  job.workpiece.length = 60;
  geometry::Hole hole;
  hole.name = "H1";
  hole.profile.R2 = 4;
  hole.position = {3, 0, 0};
  job.workpiece.holes = {hole};
  job.hole = "H1";
  job.tool.radius = 2.9;
  job.tool.neck_radius = 1.2;
  job.tool.neck_length = 60;
  job.tool.shank_radius = 1.2;
  job.tool.stickout = 70;
  job.tool.holder_radius = 15;
  job.width = 0.3 * std::numbers::sqrt2;
  job.overlap = 0.1;
  return job;
}

inline verify::Report measured(const Job& job, const Result& result) {
  verify::Subject subject;
  subject.workpiece = job.workpiece;
  subject.edge = geometry::edge_of(job.workpiece, job.workpiece.holes[0], job.edge, job.side);
  subject.tool = job.tool;
  subject.tool_axis = result.tool_axis;
  subject.control_to_centre =
      job.control_point == ControlPoint::Tip ? tool::cutting_radius(job.tool) : 0;
  subject.width = job.width;
  subject.clearance = job.clearance;
  return verify::measure(subject, result.motion);
}

}  // namespace ridgeline::chamfer
