// Chamfers the inner edge of a cross hole with Ridgeline's libraries and measures what the path
// cuts: a tube of 40 mm bore, a hole of 10 mm beside its axis, a lollipop cutter of 6 mm. Lengths
// mm, feeds mm/s, angles rad.

#include <cstdio>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "core/chamfer/job.hpp"
#include "core/verify/measure.hpp"

namespace {

using namespace ridgeline;

chamfer::Job tube_job() {
  geometry::Hole hole;
  hole.name = "H1";
  hole.profile.R2 = 5;
  hole.position = {3, 0, 0};

  chamfer::Job job;
  job.workpiece.inner_radius = 20;
  job.workpiece.outer_radius = 30;
  job.workpiece.length = 100;
  job.workpiece.holes = {hole};
  job.hole = hole.name;
  job.tool.shape = tool::ToolShape::Lollipop;
  job.tool.radius = 3;
  job.tool.neck_radius = 1.5;
  job.tool.neck_length = 40;
  job.width = 0.5;
  job.tolerance = 0.002;
  return job;
}

/// What the motion cuts, measured by code that does not know the solver.
verify::Report measured(const chamfer::Job& job, const chamfer::Result& result) {
  verify::Subject subject;
  subject.workpiece = job.workpiece;
  subject.edge = geometry::edge_of(job.workpiece, job.workpiece.holes.front(), job.edge, job.side);
  subject.tool = job.tool;
  subject.tool_axis = result.tool_axis;
  subject.control_to_centre = tool::cutting_radius(job.tool);
  subject.width = job.width;
  subject.clearance = job.clearance;
  return verify::measure(subject, result.motion);
}

}  // namespace

int main() {
  try {
    const chamfer::Job job = tube_job();
    chamfer::validate(job);
    const chamfer::Result result = chamfer::solve(job);
    const verify::Report report = measured(job, result);
    std::printf("Ridgeline %s: %zu points, width %.4f to %.4f mm, overcut %g mm\n",
                version().data(), result.centres.size(), report.width_min, report.width_max,
                report.overcut);
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", name(error.code()).data(), error.what());
    return 1;
  }
}
