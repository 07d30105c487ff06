#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/macro/result.hpp"

/// Parametric cycles (document 003; design section 1): tapers, rounded edges and floors, half
/// rounds, walls along any outline, helical in-feed. One formula serves all of them: where the tip
/// of a ball, bull-nose or flat tool stands that touches a profile at a point with a given normal.
namespace ridgeline::macro {

enum class Family {
  Taper,           ///< slope of width w and angle theta at the top of a wall
  CornerR,         ///< top edge rounded with R
  BottomR,         ///< wall and floor joined with R
  HalfConvex,      ///< ridge of radius R
  HalfConcave,     ///< groove of radius R
  RTaperR,         ///< R1, slope, R2
  ComplexSide,     ///< taper along any outline, by cutter compensation
  ComplexCornerR,  ///< corner R along any outline, by cutter compensation
  HelicalSide,     ///< cylinder wall, in-feed along a helix
  HelicalCornerR,  ///< corner R of a cylinder, in-feed along a spiral
  Rotation,        ///< points turned about an axis
  Series           ///< sine, cosine and tangent by their series
};
enum class EdgeShape { Straight, Circle, Arc };
enum class WallSide { Outside, Inside };  ///< of a boss, of a hole
enum class LowerRound { Concave, Convex };

/// A closed or open outline in XY; arcs about `centre`.
struct OutlineMove {
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> centre;
  bool counter_clockwise = true;
};
struct Outline {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  std::vector<OutlineMove> moves;
  bool tool_left = true;     ///< the tool goes to the left of the direction of travel
  bool is_top_edge = false;  ///< the outline is the upper edge of the profile, not the wall's foot
};

/// A cycle with its parameters. mm; angles in degrees and feeds in mm/min, as in the programs that
/// are made of it. Section frame: y into the material, z up, top face z = 0, lower wall at y = 0.
struct Cycle {
  Family family = Family::Taper;
  EdgeShape edge = EdgeShape::Straight;
  int method = 2;  ///< 1: the section is traced, pass by pass along the edge; 2: along the edge

  double D = 10;  ///< tool diameter
  double r = 0;   ///< corner radius of the tool: 0 flat, D/2 ball

  double width = 0;  ///< w of a slope, horizontal
  double angle = 0;  ///< theta of a slope, from horizontal
  double R = 0;      ///< round; the upper one of R-taper-R
  double R2 = 0;     ///< the lower one of R-taper-R
  LowerRound lower = LowerRound::Concave;
  double depth = 0;               ///< H of a floor or of a helix below the top face
  std::optional<double> z_floor;  ///< of a half round; default -R

  double x_start = 0, x_end = 0, y_pos = 0;  ///< straight edges
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double R0 = 0;  ///< radius of the wall at y = 0
  WallSide side = WallSide::Outside;
  double angle_start = 0, angle_end = 360;
  std::optional<Outline> outline;

  // Steps. One that is absent follows from `cusp`.
  double cusp = 0.01;                  ///< wanted residual height
  std::optional<double> pitch;         ///< along X (method 1)
  std::optional<double> angle_step;    ///< along a circle (method 1)
  std::optional<double> slope_step;    ///< along the slope (method 2)
  std::optional<double> section_step;  ///< angle on a round (method 2)
  double turn_pitch = 1;               ///< of a helix, down each turn
  double turn_step = 5;                ///< of a helical corner R, angle on the round each turn
  std::optional<int> segments;         ///< of a helical corner R, each turn
  double chord_tolerance = 0.005;      ///< for `segments`

  double feed = 1000, approach_feed = 3000;
  double z_clear = 2;              ///< h: rapids and returns stay at least this high above z = 0
  double y_clear = 0;              ///< way from the wall before the tool goes up (method 1)
  double overrun = 0;              ///< of passes along X beyond both ends (method 2)
  bool zigzag = true;              ///< passes of method 2 alternate their direction
  bool counter_clockwise = false;  ///< circles of method 2 and helices
  int offset_number = 1;           ///< D register of the complex families

  double rotation = 0;                  ///< [deg]
  int rotation_axis = 2;                ///< 0 X, 1 Y, 2 Z
  std::vector<Eigen::Vector3d> points;  ///< to rotate
  int terms = 10;                       ///< of a series
  std::vector<double> angles;           ///< of a series [deg]
};

/// One contact of tool and profile, in the section. sign: +1 on the left of a half round's top,
/// -1 on its right, 0 on its axis; 1 elsewhere.
struct Station {
  double param = 0;  ///< y on a slope, q [rad] on a round
  double q = 0;      ///< slope angle from horizontal [rad]
  Eigen::Vector2d contact = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< to the tool
  Eigen::Vector2d tip = Eigen::Vector2d::Zero();
  bool reachable = true;  ///< the tip does not cross the middle of a groove
};

/// A station placed along the edge.
struct CyclePoint {
  double along = 0;  ///< x, or the angle on the circle [deg]
  Station station;
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  double tip_radius = 0;  ///< on circles
};

/// A point of a helix or spiral.
struct HelixPoint {
  int index = 0;
  double angle = 0;  ///< travelled [deg]
  double q = 0;      ///< on the round [deg]
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  double tip_radius = 0;
};

/// Compensation value and height of one pass of the complex families.
struct OffsetPass {
  double param = 0;
  double z_tip = 0;
  double offset = 0;  ///< < 0: the tool centre is on the other side of the outline
};

struct RotatedPoint {
  Eigen::Vector3d in, about_x, about_y, about_z;
};
struct SeriesValue {
  double angle = 0;  ///< [deg]
  double sine = 0, cosine = 0;
  std::optional<double> tangent;  ///< absent where the cosine is 0
};

/// What a cycle gives.
struct CycleResult {
  std::vector<Station> stations;   ///< of the section, in cutting order
  std::vector<CyclePoint> points;  ///< at the ends of the edge (see cycle_points)
  std::vector<HelixPoint> helix;
  std::vector<OffsetPass> offsets;
  std::vector<RotatedPoint> rotated;
  std::vector<SeriesValue> series;
  std::vector<double> passes;  ///< places of the passes along the edge (method 1): x or angle
  double cusp = 0;             ///< residual height normal to the surface
  std::vector<std::string> warnings;  ///< rest material
  Result motion;
};

/// Checks the parameters of a cycle. Throws Error{BadInput} with the name of the parameter in
/// details().field, its value and the limit.
void validate(const Cycle& cycle);

/// Stations, points, cusp and motion. Throws Error{BadInput}, Error{Unsupported}, Error{Cancelled}.
CycleResult solve(const Cycle& cycle, const Progress& progress = {});

}  // namespace ridgeline::macro
