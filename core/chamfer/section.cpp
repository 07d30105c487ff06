#include "core/chamfer/section.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/base/text.hpp"
#include "core/base/tolerance.hpp"
#include "core/chamfer/section_angle.hpp"

namespace ridgeline::chamfer {
namespace {

using std::numbers::pi;

// The plane VP at a target point, origin P, axes e1 (S) and e2 (T). The wall is a conic there [E
// 11], the body another; both are written without dividing by sin(epsilon).
struct Plane {
  const geometry::Profile& profile;
  Eigen::Vector2d p, n2, t2;  // of the profile at P
  double kappa;               // its curvature
  double tau;                 // sin(epsilon) = e2.t2: how fast T runs along the profile
  // Body: m F = c S + s T + (q11 S^2 + 2 q12 S T + q22 T^2) / 2, zero at P.
  double c, s, q11, q12, q22;
};

struct WallPoint {
  double S = 0;
  double slope = 0;  // dS/dT
};

// [E 14] while G2 stays on the part of the profile that P is on.
WallPoint wall_beside(const Plane& vp, double T) {
  const double x = vp.kappa * vp.tau * T;
  const double root = std::sqrt(1 - x * x);
  return {.S = -x * vp.tau * T / (1 + root), .slope = -x * vp.tau / root};
}

// [E 14] by the signed distance of the whole profile: Newton from the outside, where the distance
// is convex. At the far side of the hole there is no wall: S is not a number.
WallPoint wall_across(const Plane& vp, double T) {
  const Eigen::Vector2d start = vp.p + vp.tau * T * vp.t2;
  WallPoint wall;
  for (int i = 0; i < 100; ++i) {
    const geometry::PlaneDistance d = signed_distance(vp.profile, start + wall.S * vp.n2);
    const double across = d.gradient.dot(vp.n2);
    if (!(across > 0)) break;
    wall.slope = -vp.tau * d.gradient.dot(vp.t2) / across;
    const double step = d.value / across;
    wall.S -= step;
    if (std::abs(step) <= 1e-15 * (vp.profile.R2 + std::abs(wall.S))) return wall;
  }
  return {.S = std::numeric_limits<double>::quiet_NaN(), .slope = 0};
}

struct Ends {
  double S1, T1, S2, T2;
  Root root;
};

// [E 13..15, 17, 21]: slide the chord of length W and angle delta along the wall until G1 is on the
// body.
template <class Wall>
Ends ends(const Plane& vp, const Wall& wall_at, double W, double sine, double cosine) {
  const double T0 = W * (cosine + sine * -vp.c / vp.s);  // of the plane wedge
  const auto body = [&](double T) -> RootSample {
    const WallPoint wall = wall_at(vp, T);
    if (!std::isfinite(wall.S)) return {.value = std::numeric_limits<double>::infinity()};
    const double S1 = wall.S + W * sine;
    const double T1 = T - W * cosine;
    const double dS = vp.c + vp.q11 * S1 + vp.q12 * T1;
    const double dT = vp.s + vp.q12 * S1 + vp.q22 * T1;
    return {.value = 0.5 * ((vp.c + dS) * S1 + (vp.s + dT) * T1),
            .slope = dS * wall.slope + dT,
            .second = vp.q22 - dS * vp.kappa * vp.tau * vp.tau};
  };
  const double reach = 10 * (W / vp.s + std::abs(T0));
  const double tolerance = 2e-15 * (W + std::abs(T0));
  Ends e{};
  e.root = rising_root(body, -1e-3 * W, reach, T0, tolerance);
  e.T2 = e.root.x;
  e.S2 = wall_at(vp, e.T2).S;
  e.S1 = e.S2 + W * sine;
  e.T1 = e.T2 - W * cosine;
  return e;
}

bool is_on_other_part(const geometry::Profile& profile, const Eigen::Vector2d& p,
                      const Eigen::Vector2d& q) {
  const Eigen::Vector2d half(profile.straight_across / 2, profile.straight_along / 2);
  if (half.isZero(0)) return false;
  // At a joint the curvature is of one side, and q may be on the other.
  if (((p.cwiseAbs() - half).array().abs() < 1e-9 * profile.R2).any()) return true;
  const auto part = [&](const Eigen::Vector2d& x) -> Eigen::Vector2i {
    return ((x.array() > half.array()).cast<int>() - (x.array() < -half.array()).cast<int>())
        .matrix();
  };
  return part(p) != part(q);
}

// How a chamfer runs over VP: from G2 to G1 along d = sin(delta) e1 - cos(delta) e2.
struct Direction {
  double delta, sine, cosine;
};

Direction direction_at(const Section& section, const geometry::RidgePoint& ridge, double c,
                       double s) {
  const SectionAngle& angle = section.chamfer->section_angle;
  if (std::holds_alternative<Bisector>(angle)) {
    const double sine = std::sqrt((1 - c) / 2);  // = cos(theta / 2)
    return {.delta = pi / 2 - ridge.theta / 2, .sine = sine, .cosine = s / (2 * sine)};
  }
  if (const auto* constant = std::get_if<ConstantAngle>(&angle)) {
    return {.delta = constant->delta, .sine = section.sin_delta, .cosine = section.cos_delta};
  }
  const double phi = std::atan2(ridge.P.y(), ridge.P.x());
  const double delta = table_angle(std::get<AngleTable>(angle), phi).delta;
  return {.delta = delta, .sine = std::sin(delta), .cosine = std::cos(delta)};
}

[[noreturn]] void refuse(const Section& section, double u, const geometry::RidgePoint& ridge,
                         const std::string& why) {
  throw Error(ErrorCode::WidthTooLarge,
              "width " + text(section.chamfer->W, "mm") + " at u = " + text(u) + ": " + why,
              {.field = "/width",
               .value = text(section.chamfer->W, "mm"),
               .limit = why,
               .parameter = u,
               .target = to_outer(section.edge->frame, ridge.P)});
}

// G1 lies on the body outside the hole, G2 on the wall within the body.
void require_ends_on_material(const Section& section, double u, const geometry::RidgePoint& ridge,
                              const Plane& vp, const Ends& e) {
  const double W = section.chamfer->W;
  const double body =
      vp.c * e.S2 + vp.s * e.T2 +
      0.5 * (vp.q11 * e.S2 * e.S2 + 2 * vp.q12 * e.S2 * e.T2 + vp.q22 * e.T2 * e.T2);
  if (!(body >= -1e-9 * W)) {
    refuse(section, u, ridge, "at this section angle the chamfer leaves the wall of the hole");
  }
  if (e.S1 > 0) return;  // beyond the tangent of a convex profile
  const Eigen::Vector3d G1 = ridge.P + e.S1 * ridge.e1 + e.T1 * ridge.e2;
  if (!(signed_distance(vp.profile, G1.head<2>()).value > 0)) {
    refuse(section, u, ridge, "at this section angle the chamfer leaves the body surface");
  }
}

void require_angle(double delta) {
  if (delta > 0 && delta <= pi / 2 * (1 + 1e-12)) return;
  throw Error(ErrorCode::BadInput,
              "section angle is " + text(degrees(delta), "deg") +
                  "; it must be greater than 0 and at most 90 deg [0109]",
              {.field = "/section_angle", .value = text(degrees(delta), "deg"), .limit = "90 deg"});
}

void require(const Chamfer& chamfer) {
  const auto& [W, D, section_angle, method] = chamfer;
  if (!(W > 0 && W < length_limit)) {
    throw Error(ErrorCode::BadInput, "width is " + text(W, "mm") + "; it must be greater than 0",
                {.field = "/width", .value = text(W, "mm"), .limit = "0 mm"});
  }
  if (!(D > 0 && D < length_limit)) {
    throw Error(
        ErrorCode::BadInput,
        "the cutting radius of the tool is " + text(D, "mm") + "; it must be greater than 0",
        {.field = "/tool", .value = text(D, "mm"), .limit = "0 mm"});
  }
  if (!(W < 2 * D)) {
    throw Error(ErrorCode::WidthTooLarge,
                "width is " + text(W, "mm") + "; a ball of radius " + text(D, "mm") +
                    " cuts less than its diameter " + text(2 * D, "mm"),
                {.field = "/width", .value = text(W, "mm"), .limit = text(2 * D, "mm")});
  }
  if (const auto* constant = std::get_if<ConstantAngle>(&section_angle)) {
    require_angle(constant->delta);
  } else if (const auto* table = std::get_if<AngleTable>(&section_angle)) {
    require_table(*table);
    for (const AngleTable::Entry& entry : table->entries) require_angle(entry.delta);
  }
}

}  // namespace

Section section(const geometry::Edge& edge, const Chamfer& chamfer) {
  require(chamfer);
  const auto& [W, D, section_angle, method] = chamfer;
  Section s{.edge = &edge, .chamfer = &chamfer, .ridge = ridge_line(edge)};
  s.CM = std::sqrt((D - W / 2) * (D + W / 2));  // [E 16]
  if (const auto* constant = std::get_if<ConstantAngle>(&section_angle)) {
    s.sin_delta = std::sin(constant->delta);
    s.cos_delta = std::cos(constant->delta);
  }
  return s;
}

// Document 000, [0094]..[0130]; design: sections 3 and 4. Hole frame.
SectionPoint section_at(const Section& section, double u) {
  const geometry::RidgeLine& line = section.ridge;
  const double W = section.chamfer->W;
  const geometry::ProfilePoint profile = profile_at(line.profile, u);
  SectionPoint point;
  point.ridge = ridge_at(line, profile, u);
  const auto& [P, n1, n2, t, e1, e2, theta] = point.ridge;

  const Eigen::Matrix3d Q = line.m * line.F.Q;
  const Eigen::Vector3d Qe1 = Q * e1;
  const double c = line.m * n1.dot(n2);  // = -cos(theta)
  const double s = line.m * n1.dot(e2);  // = sin(theta)
  const Plane vp{.profile = line.profile,
                 .p = profile.p,
                 .n2 = profile.normal,
                 .t2 = profile.tangent,
                 .kappa = profile.curvature,
                 .tau = e2.head<2>().dot(profile.tangent),
                 .c = c,
                 .s = s,
                 .q11 = e1.dot(Qe1),
                 .q12 = e2.dot(Qe1),
                 .q22 = e2.dot(Q * e2)};
  const Direction direction = direction_at(section, point.ridge, c, s);
  point.delta = direction.delta;
  const double sine = direction.sine;
  const double cosine = direction.cosine;

  Ends e = ends(vp, wall_beside, W, sine, cosine);
  const auto at = [&](double S, double T) -> Eigen::Vector3d { return P + S * e1 + T * e2; };
  point.G2 = at(e.S2, e.T2);  // [E 12]
  if (is_on_other_part(line.profile, profile.p, point.G2.head<2>())) {
    e = ends(vp, wall_across, W, sine, cosine);
    point.G2 = at(e.S2, e.T2);
  }
  if (!(e.root.converged)) {
    refuse(section, u, point.ridge, "no chord of that length at that angle ends on both surfaces");
  }
  point.G1 = point.G2 + W * (sine * e1 - cosine * e2);  // [E 15, 17, 21]
  require_ends_on_material(section, u, point.ridge, vp, e);
  const Eigen::Vector3d M = 0.5 * (point.G1 + point.G2);
  point.C = M - section.CM * (cosine * e1 + sine * e2);  // [E 18..20, 22]
  return point;
}

SectionPoint section_at(const geometry::Edge& edge, const Chamfer& chamfer, double u) {
  return section_at(section(edge, chamfer), u);
}

}  // namespace ridgeline::chamfer
