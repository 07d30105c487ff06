#pragma once

#include <vector>

#include "core/geometry/profile.hpp"

namespace ridgeline::geometry {

/// The ridge of a hole that breaks out of the side of a cylinder of radius R1 (design: section 2).
/// Where x' + f = +-R1 the generators of the wall touch the cylinder, and the ridges of the two
/// sides meet: they are one closed curve, of two where the hole is wider than the cylinder.
///
/// Along it, with w = 2 pi u, the profile parameter swings to and fro over the part of the profile
/// that meets the cylinder,
///     v = middle + half sin(w),
/// on the upper side of the cylinder where cos(w) > 0, on the lower where cos(w) < 0. Near the ends
/// the height goes as the root of the way to the end, the way as cos(w)^2: so P is smooth in u.
struct BreakOut {
  double middle = 0, half = 0;  ///< of the profile parameter v
  double R1 = 0, f = 0;         ///< [mm]
  double plus = -1;             ///< v in [0, 1/2] where x' + f = R1; -1: nowhere
  double minus = -1;            ///< v in [0, 1/2] where x' + f = -R1; -1: nowhere
  bool mirrored = false;        ///< the part of the profile with y' < 0 (plus and minus)
};

/// Does a hole of this half width break out of a cylinder that its axis passes at f?
bool breaks_out(const Profile& profile, double f, double R1);

/// For a hole that breaks out. `upper`: of two curves the one at y' > 0.
BreakOut break_out(const Profile& profile, double f, double R1, bool upper);

/// Profile parameter at u.
double profile_parameter(const BreakOut& curve, double u);

/// Height over the cylinder's axis across x' at u: sqrt(R1^2 - (x' + f)^2) with the sign of cos(w),
/// to full relative accuracy up to the ends.
double height_across(const BreakOut& curve, const Profile& profile, double u);

/// The height divided by cos(w): never 0.
double height_rate(const BreakOut& curve, const Profile& profile, double u);

/// The u at which the curve passes a profile parameter: two, or none.
std::vector<double> passages(const BreakOut& curve, double profile_parameter);

}  // namespace ridgeline::geometry
