#pragma once

#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

/// Core-circle radius a = D/2 - r of the tool.
inline double core_radius(const Cycle& cycle) {
  return cycle.D / 2 - cycle.r;
}

/// (U): station of contact C with slope angle q [rad]; side as Station's sign.
Station station_at(const Cycle& cycle, double param, double q, const Eigen::Vector2d& contact,
                   double side = 1);

/// Places from `from` to `to` by `step`, as multiples of the step; the last exactly at `to`. A step
/// that divides the range within 1e-6 of itself gives no extra place (design section 1.5.1).
std::vector<double> places(double from, double to, double step);

/// Step along the edge (method 1): [mm] or [deg]; along the slope [mm]; on a round [deg].
double pass_step(const Cycle& cycle);
double slope_step(const Cycle& cycle);
double section_step(const Cycle& cycle);

/// All stations of the section, in cutting order.
std::vector<Station> section_stations(const Cycle& cycle);

/// Half the angle of a half round that is cut, from its axis [rad].
double half_round_limit(const Cycle& cycle);
/// Angle from which a bull-nose tool reaches a groove [rad].
double groove_reach(const Cycle& cycle);

/// Lengths of R-taper-R: t1 = R1 tan(t/2), t2, H = w tan t.
struct RTaperRLengths {
  double t1 = 0, t2 = 0, H = 0;
  double q_end = 0;  ///< slope angle where the lower round ends [rad]
  Eigen::Vector2d K1 = Eigen::Vector2d::Zero(), K2 = Eigen::Vector2d::Zero();  ///< centres
};
RTaperRLengths r_taper_r(const Cycle& cycle);

/// The guide's distances of the straight taper (1): A(-D/2, h), B(b, h), C(-D/2, -c).
struct TaperTriangle {
  double b = 0, c = 0;
};
TaperTriangle taper_triangle(const Cycle& cycle);

/// Section coordinates to the workpiece: straight edges (along, y_pos + y, z); circles of radius
/// R0 - y outside and R0 + y inside.
Eigen::Vector3d placed(const Cycle& cycle, double along, const Eigen::Vector2d& section);
Eigen::Vector3d placed_direction(const Cycle& cycle, double along, const Eigen::Vector2d& section);
double radius_at(const Cycle& cycle, double y);

/// Residual height between passes, normal to the surface (design section 1.4).
double cusp_height(const Cycle& cycle);
/// Taper circle (1): at the lower edge alone, leading order.
double lower_edge_cusp(const Cycle& cycle);
/// Method 1 between passes p apart at slope q [rad]; straight edges.
double cusp_across(double a, double r, double q, double p);
/// Method 2 along a slope by ds; on a convex and a concave round by dq [rad].
double cusp_slope(double r, double q, double ds);
double cusp_convex(double R, double r, double dq);
double cusp_concave(double R, double r, double dq);

}  // namespace ridgeline::macro
