#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/chamfer/job.hpp"
#include "core/cutting/wedge.hpp"
#include "jobs/chamfer_job.hpp"
#include "jobs/chamfer_page.hpp"
#include "jobs/check.hpp"
#include "jobs/predict_motion.hpp"
#include "jobs/predict_page.hpp"
#include "jobs/predict_path.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::ChamferPoint;

// The path of a chamfer job made ready: its points as stations of the last pass.
struct ChamferPath {
  chamfer::Result result;
  geometry::Edge edge;
  CutRange cut;  // the pass in the motion
  std::vector<ChamferPoint> points;
  std::vector<cutting::Station> stations;
};

// Directions round a closed loop.
std::vector<Eigen::Vector3d> loop_directions(const std::vector<Eigen::Vector3d>& centres) {
  std::vector<Eigen::Vector3d> out;
  const std::size_t count = centres.size();
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back((centres[(i + 1) % count] - centres[(i + count - 1) % count]).normalized());
  }
  return out;
}

// Where the polyline of an earlier pass is nearest to a point: the groove that it left there.
Eigen::Vector3d nearest_on(const std::vector<Eigen::Vector3d>& line, const Eigen::Vector3d& point) {
  Shifts places{line, line, true};
  return shift_at(places, point);
}

// Ball centres of an earlier pass.
std::vector<Eigen::Vector3d> centres_of(const path::Motion& motion, const CutRange& cut,
                                        const Eigen::Vector3d& to_centre) {
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t i = cut.from; i < cut.to; ++i) centres.push_back(motion.moves[i].to + to_centre);
  return centres;
}

// Positions of the program are those of its control point.
Eigen::Vector3d to_centre(const ChamferJob& job, const Eigen::Vector3d& tool_axis) {
  if (job.job.control_point == chamfer::ControlPoint::Centre) return Eigen::Vector3d::Zero();
  return tool::cutting_radius(job.job.tool) * tool_axis;
}

/// The last pass of a job, or the one before its spring pass.
enum class Pass { Last, BeforeSpring };

ChamferPath path_of(const ChamferJob& job, const chamfer::Result& result, Pass pass, double S,
                    const cutting::Cutter& cutter) {
  ChamferPath path;
  path.result = result;
  path.edge = subject_of(job, result.tool_axis).edge;
  std::vector<CutRange> passes = cut_ranges(result.motion);
  if (pass == Pass::BeforeSpring && passes.size() > 1) passes.pop_back();
  if (passes.empty()) throw Error(ErrorCode::Internal, "a chamfer without a cut");
  path.cut = passes.back();
  std::vector<Eigen::Vector3d> earlier;
  if (passes.size() > 1) {
    earlier =
        centres_of(result.motion, passes[passes.size() - 2], to_centre(job, result.tool_axis));
  }
  const double teeth_per_second = S * cutting::teeth(cutter);
  const std::vector<Eigen::Vector3d> directions = loop_directions(result.centres);
  for (std::size_t i = 0; i < result.centres.size(); ++i) {
    const path::Move& move = result.motion.moves[std::min(path.cut.from + i, path.cut.to - 1)];
    ChamferPoint point{result.targets[i],
                       result.centres[i],
                       result.G1[i],
                       result.G2[i],
                       directions[i],
                       move.feed / teeth_per_second,
                       {}};
    if (!(point.feed >= 1e-6 && point.feed <= cutter.r / 2)) {
      refuse({.field = "/along/feed",
              .value = text(point.feed) + " mm a tooth",
              .limit = "1e-6 mm to half the radius a tooth at this spindle_speed"});
    }
    if (!earlier.empty()) point.earlier_centre = nearest_on(earlier, point.centre);
    path.stations.push_back(cutting::chamfer_station(path.edge, point, cutter.r));
    path.points.push_back(std::move(point));
  }
  return path;
}

/// The spring pass goes over what the pass before left: that stood off by its error, not where its
/// path was. Where it was drawn in, and left nothing to cut, its own error stays, and its chatter
/// where it chattered.
ChamferPath over(ChamferPath path, const std::vector<cutting::StationError>& errors,
                 double radius) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    path.points[i].earlier_centre.reset();
    if (errors[i].e) {
      path.points[i].earlier_centre = path.points[i].centre + *errors[i].e * path.stations[i].n;
    }
    path.stations[i] = cutting::chamfer_station(path.edge, path.points[i], radius);
  }
  return path;
}

void keep_finish(const std::vector<cutting::StationError>& finish,
                 std::vector<cutting::StationError>& spring) {
  for (std::size_t i = 0; i < spring.size(); ++i) {
    if (!spring[i].e && finish[i].e) {
      spring[i] = finish[i];
      spring[i].shift = 0;  // that of the finishing pass
    }
    const std::optional<cutting::Stability>& told = finish[i].stability;
    if (told && *told != cutting::Stability::Stable) spring[i].stability = told;
  }
}

// Widths that the errors at the two borders leave, the tool moved as it was.
std::vector<double> widths(const ChamferPath& path,
                           const std::vector<cutting::StationError>& errors) {
  std::vector<double> out;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::vector<std::optional<double>>& border = errors[i].border;
    const bool cuts = border.size() == 2 && border[0] && border[1];
    out.push_back(cuts ? cutting::chamfer_width(path.edge, path.points[i], *border[0], *border[1])
                       : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

/// One pass of a job and what it leaves, as it is and, if asked for, corrected.
struct PredictedPass {
  ChamferPath path;
  AlongResult result;
};

/// The pass before the spring pass. Corrected, it keeps what it leaves standing, which the spring
/// pass takes off; where it cuts too deep no later pass can help, and it is drawn back itself.
PredictedPass finishing_pass(ChamferPath path, const AlongJob& along, const Progress& progress) {
  AlongJob as_it_is = along;
  as_it_is.correct.reset();
  PredictedPass pass{std::move(path), {}};
  pass.result = run_along(as_it_is, pass.path.stations, progress.part(0, along.correct ? 0.5 : 1));
  if (!along.correct) return pass;
  refuse_chatter(pass.path.stations, pass.result.before, along.course.cutter.r);
  cutting::CorrectOptions limits = *along.correct;
  limits.only_overcut = true;
  pass.result.after = corrected(along, pass.path.stations, limits, progress.part(0.5, 1));
  return pass;
}

/// The spring pass over the finishing pass as it is and, if asked for, over the corrected one.
PredictedPass spring_pass(const ChamferPath& path, const AlongJob& along, const AlongResult& finish,
                          const Progress& progress) {
  AlongJob as_it_is = along;
  as_it_is.correct.reset();
  const double radius = along.course.cutter.r;
  PredictedPass pass{over(path, finish.before, radius), {}};
  pass.result = run_along(as_it_is, pass.path.stations, progress.part(0, along.correct ? 0.5 : 1));
  keep_finish(finish.before, pass.result.before);
  if (!along.correct) return pass;
  refuse_chatter(pass.path.stations, pass.result.before, radius);
  pass.result.after = corrected(along, over(path, finish.after, radius).stations, *along.correct,
                                progress.part(0.5, 1));
  keep_finish(finish.after, pass.result.after);
  return pass;
}

path::Motion shifted_pass(const ChamferPath& path, const std::vector<Eigen::Vector3d>& position,
                          const std::vector<cutting::StationError>& after) {
  Shifts shifts{position, {}, true};
  for (std::size_t i = 0; i < path.stations.size(); ++i) {
    shifts.shift.emplace_back(-after[i].shift * path.stations[i].n);
  }
  return shifted(path.result.motion, path.cut, shifts, path.result.tool_axis);
}

double greatest_shift(const std::vector<cutting::StationError>& after) {
  double greatest = 0;
  for (const cutting::StationError& row : after) greatest = std::max(greatest, std::abs(row.shift));
  return greatest;
}

/// The program of the corrected path, `finish` the pass before a spring pass. Its own clearances
/// are measured: a shift brings neck and holder nearer too.
nc::Program corrected_program(const ChamferJob& job, const ChamferPath& path,
                              const PredictedPath& predicted,
                              const std::optional<PredictedPass>& finish) {
  nc::Program program = job.program;
  program.tool_axis = path.result.tool_axis;
  program.motion = shifted_pass(path, predicted.position, predicted.result.after);
  double greatest = greatest_shift(predicted.result.after);
  if (finish) {  // up to where the spring pass is led in, the motion is the finishing pass's
    const path::Motion before =
        shifted_pass(finish->path, predicted.position, finish->result.after);
    const std::size_t end = lead_of(before, path.cut);
    for (std::size_t i = 0; i < end; ++i) program.motion.moves[i] = before.moves[i];
    greatest = std::max(greatest, greatest_shift(finish->result.after));
  }
  program.comments.push_back("CORRECTED FOR TOOL DEFLECTION, GREATEST SHIFT " +
                             text(std::round(greatest * 1e4) / 1e4));
  return program;
}

void refuse_collisions(const ChamferJob& job, const nc::Program& program,
                       const Progress& progress) {
  const verify::Subject subject = subject_of(job, program.tool_axis);
  const verify::Report report = verify::measure(subject, nc::rounded(program, progress), progress);
  for (const Failure& failure : failures(job, subject, report)) {
    const ErrorCode code = failure.error.code();
    const bool is_cut = is_width(failure) || code == ErrorCode::ToolTooLarge;  // meant to differ
    if (!is_cut) throw failure.error;
  }
}

AlongSource source_of(const ChamferJob& job) {
  return {.tool = job.job.tool,
          .dynamics = job.tool_dynamics,
          .material = job.material,
          .material_at = "/along/workpiece/material",
          .rpm = job.program.spindle_speed};
}

}  // namespace

Answer predict_chamfer(Object& job, const Value& along, const Request& request) {
  ChamferJob chamfer_job = read_chamfer_job(along, request.definitions);
  chamfer::validate(chamfer_job.job);
  const AlongSource source = source_of(chamfer_job);
  AlongJob read = read_along(job, source, request.definitions);
  job.finish();
  if (chamfer_job.job.arcs) {
    chamfer_job.job.arcs = false;
    read.warnings.emplace_back("the path is predicted, and corrected, as straight blocks");
  }
  const chamfer::Result solved = chamfer::solve(chamfer_job.job, request.progress.part(0, 0.1));
  read.course.tool_axis = solved.tool_axis;
  const auto pass_of = [&](Pass pass) {
    return path_of(chamfer_job, solved, pass, read.S(), read.course.cutter);
  };
  ChamferPath path = pass_of(Pass::Last);
  std::optional<PredictedPass> finish;
  AlongResult result;
  if (chamfer_job.job.spring_pass) {
    finish = finishing_pass(pass_of(Pass::BeforeSpring), read, request.progress.part(0.1, 0.55));
    PredictedPass last = spring_pass(path, read, finish->result, request.progress.part(0.55, 1));
    path = std::move(last.path);
    result = std::move(last.result);
    result.solve_seconds += finish->result.solve_seconds;
  } else {
    result = run_along(read, path.stations, request.progress.part(0.1, 1));
  }
  PredictedPath predicted;
  predicted.kind = "chamfer";
  predicted.is_closed = true;
  predicted.wanted_width = chamfer_job.job.width;
  predicted.parameter = path.result.parameter;
  predicted.stations = path.stations;
  const Eigen::Vector3d offset = to_centre(chamfer_job, path.result.tool_axis);
  for (const Eigen::Vector3d& centre : path.result.centres) {
    predicted.position.push_back(centre - offset);
  }
  predicted.result = std::move(result);
  if (finish) predicted.finish = finish->result.after;
  predicted.width = widths(path, predicted.result.before);

  std::optional<nc::Program> program;
  if (read.correct) {
    predicted.width_after = widths(path, predicted.result.after);
    program = corrected_program(chamfer_job, path, predicted, finish);
    refuse_collisions(chamfer_job, *program, request.progress.part(1, 1));
  }
  Answer answer = path_answer(read, predicted);
  if (request.format == "csv") answer.text = path_csv(predicted);
  if (request.format == "svg") answer.text = path_drawing(read, predicted);
  if (request.format == "html") {
    answer.text = path_page(
        read, predicted, answer.document,
        chamfer_scene(chamfer_job, path.result, subject_of(chamfer_job, path.result.tool_axis)));
  }
  if (request.format == "nc") answer.text = nc::write(program.value(), request.progress.part(1, 1));
  return answer;
}

}  // namespace ridgeline::jobs
