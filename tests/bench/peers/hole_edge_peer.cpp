// Our chamfer of a hole edge beside the one that Open CASCADE makes on the solid, in one run. The
// two do different things: Open CASCADE's chamfer is a shape, ours the path of a tool that leaves
// it, measured. Both are asked for the same edge break on the same part. Prints one row a case:
//   hole_edge_peer [REPEATS]      (default 5)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "core/base/error.hpp"
#include "core/chamfer/job.hpp"
#include "core/verify/measure.hpp"
#include "tests/bench/peers/occt_chamfer.hpp"
#include "tests/bench/processor_time.hpp"

namespace {

using namespace ridgeline;

struct Case {
  const char* name;
  double R1, outer, R2, f, ball, leg;  // [mm]
  geometry::EdgeKind edge;
};

constexpr double tolerance = 0.002;  // [mm]

struct Ours {
  double seconds = 0, width_min = 0, width_max = 0;
  std::size_t points = 0;
};

chamfer::Job job_of(const Case& c, chamfer::Method method) {
  chamfer::Job job;
  job.workpiece.inner_radius = c.R1;
  job.workpiece.outer_radius = c.outer;
  job.workpiece.length = 12 * c.R2;
  geometry::Hole hole;
  hole.name = "H";
  hole.profile.R2 = c.R2;
  hole.position = {c.f, 0, 0};
  job.workpiece.holes = {hole};
  job.hole = hole.name;
  job.edge = c.edge;
  job.tool.shape = tool::ToolShape::Ball;
  job.tool.radius = c.ball;
  job.width = std::sqrt(2) * c.leg;  // [E 1]
  job.tolerance = tolerance;
  job.method = method;
  return job;
}

Ours ours(const Case& c, chamfer::Method method) {
  const chamfer::Job job = job_of(c, method);
  chamfer::validate(job);
  chamfer::Result result;
  const double seconds = bench::processor_seconds([&] { result = chamfer::solve(job); });
  verify::Subject subject;
  subject.workpiece = job.workpiece;
  subject.edge = edge_of(job.workpiece, job.workpiece.holes.front(), job.edge, job.side);
  subject.tool = job.tool;
  subject.tool_axis = result.tool_axis;
  subject.control_to_centre = tool::cutting_radius(job.tool);
  subject.width = job.width;
  subject.clearance = job.clearance;
  const verify::Report report = verify::measure(subject, result.motion);
  return {seconds, report.width_min, report.width_max, result.centres.size()};
}

/// The run of median time.
template <class F>
auto median(int repeats, F&& run, auto&& time) {
  std::vector<decltype(run())> runs;
  for (int i = 0; i < repeats; ++i) runs.push_back(run());
  std::sort(runs.begin(), runs.end(),
            [&](const auto& a, const auto& b) { return time(a) < time(b); });
  return runs[runs.size() / 2];
}

std::string row(const Ours& o, double W) {
  return fmt::format("{:.2f} ms, {} points, width {:+.1f} to {:+.1f} %", o.seconds * 1e3, o.points,
                     100 * (o.width_min / W - 1), 100 * (o.width_max / W - 1));
}

void compare(const Case& c, int repeats) {
  const double W = std::sqrt(2) * c.leg;
  const geometry::Workpiece tube = job_of(c, chamfer::Method::Swept).workpiece;
  const auto by_time = [](const Ours& o) { return o.seconds; };
  const Ours swept = median(
      repeats, [&] { return ours(c, chamfer::Method::Swept); }, by_time);
  const Ours section = median(
      repeats, [&] { return ours(c, chamfer::Method::Section); }, by_time);
  const bench::OcctChamfer occt = median(
      repeats, [&] { return bench::occt_chamfer(tube, c.edge, c.leg, tolerance); },
      [](const bench::OcctChamfer& o) { return o.chamfer_seconds; });
  const std::string theirs =
      occt.failure.empty()
          ? fmt::format("{:.1f} ms (and {:.0f} ms for the solid), width {:+.1f} to {:+.1f} %",
                        occt.chamfer_seconds * 1e3, occt.solid_seconds * 1e3,
                        100 * (occt.width_min / W - 1), 100 * (occt.width_max / W - 1))
          : fmt::format("{:.1f} ms: {}", occt.chamfer_seconds * 1e3, occt.failure);
  std::cout << fmt::format("| {} | {} | {} | {} | {:.1f} x | {} points, {:.2f} ms |\n", c.name,
                           row(swept, W), row(section, W), theirs,
                           occt.chamfer_seconds / swept.seconds, occt.sample_points,
                           occt.sample_seconds * 1e3);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  if (repeats < 1) {
    std::cerr << "usage: hole_edge_peer [REPEATS]     at least 1\n";
    return 2;
  }
  using geometry::EdgeKind;
  const Case cases[] = {
      {"bore 20, hole 8, offset 3, leg 0.30, inner", 10, 20, 4, 3, 2.9, 0.3, EdgeKind::Inner},
      {"bore 40, hole 10, leg 0.35, inner", 20, 30, 5, 0, 3, 0.35, EdgeKind::Inner},
      {"the same, outer", 20, 30, 5, 0, 3, 0.35, EdgeKind::Outer},
      {"bore 20, hole 10, offset 4, leg 0.35, inner", 10, 18, 5, 4, 2, 0.35, EdgeKind::Inner},
      {"bore 80, hole 6, offset 20, leg 0.20, inner", 40, 60, 3, 20, 2, 0.2, EdgeKind::Inner}};
  std::cout << "| part [mm] | swept | section | Open CASCADE's chamfer | against swept | its ridge "
               "at 0.002 mm |\n|---|---|---|---|---|---|\n";
  try {
    for (const Case& c : cases) compare(c, repeats);
  } catch (const Error& error) {
    std::cerr << name(error.code()) << ": " << error.what() << '\n';
    return 1;
  }
  return 0;
}
