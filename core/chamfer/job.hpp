#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/progress.hpp"
#include "core/chamfer/section.hpp"
#include "core/geometry/workpiece.hpp"
#include "core/path/motion.hpp"
#include "core/tool/tool.hpp"

namespace ridgeline::chamfer {

enum class Direction { Climb, Conventional };
enum class FeedAt { Contact, Centre };
enum class ControlPoint { Tip, Centre };
/// The axes that arcs refer to when the tool axis is not a machine axis: those of a tilted work
/// plane, or of the work frame, there about any axis or (HEIDENHAIN helices) about Z only.
enum class ArcFrame { WorkPlane, WorkFrame, WorkFrameXY };
/// Access along A2 or along A1; the sense that is free is chosen.
enum class Access { Hole, Bore };

/// Everything that decides a motion. mm, rad, mm/s, s. Frame: work.
struct Job {
  geometry::Workpiece workpiece;
  std::string hole;
  geometry::EdgeKind edge = geometry::EdgeKind::Inner;
  geometry::Side side = geometry::Side::Entry;
  tool::Tool tool;
  double width = 0;
  double tolerance = 0.005;
  SectionAngle section_angle = Bisector{};
  Method method = Method::Swept;
  std::optional<int> points;  ///< that many equal steps of the profile parameter from start_angle
  std::variant<Eigen::Vector3d, Access> tool_axis = Eigen::Vector3d(0, 0, 1);  ///< tip to spindle
  Direction direction = Direction::Climb;
  double start_angle = 0;
  double overlap = 0;               ///< angle past the seam (JSON default 5 degrees)
  std::vector<double> pass_widths;  ///< ascending, the last is `width`; empty: one pass
  bool spring_pass = false;
  double feed = 5;
  std::optional<double> lead_in_feed;  ///< first radial move; default: feed / 2
  FeedAt feed_at = FeedAt::Contact;
  double clearance = 10;  ///< rapids stay this far from the body
  std::optional<double> lead_radius;
  std::optional<Eigen::Vector3d> end_position;
  bool arcs = false;
  ArcFrame arc_frame = ArcFrame::WorkPlane;
  int decimals = 4;
  ControlPoint control_point = ControlPoint::Tip;
};

/// What a job gives. Work frame; cutting order.
struct Result {
  std::vector<double> parameter;         ///< u of each cutting point
  std::vector<Eigen::Vector3d> targets;  ///< P
  std::vector<Eigen::Vector3d> centres;  ///< C
  std::vector<Eigen::Vector3d> G1, G2;   ///< chamfer borders
  Eigen::Vector3d tool_axis;             ///< resolved, unit, tip to spindle
  path::Motion motion;                   ///< of the control point, unrounded
  int points_optimal = 0;                ///< N_opt of design section 6
  double chord_error = 0;                ///< certified [mm]
  double solve_seconds = 0;
  std::vector<std::string> warnings;  ///< e.g. a part of the tool that is not described
};

/// Checks every value; throws Error{BadInput} with the JSON pointer of the job's field. Runs once.
void validate(const Job& job);

/// The path of the whole edge with its approach and retract. Throws the codes of design section 8.
Result solve(const Job& job, const Progress& progress = {});

}  // namespace ridgeline::chamfer
