#include "core/chamfer/section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/base/text.hpp"
#include "core/base/tolerance.hpp"
#include "core/chamfer/border.hpp"
#include "core/chamfer/section_angle.hpp"

namespace ridgeline::chamfer {
namespace {

using std::numbers::pi;

constexpr double same_parameter = 1e-9;  ///< breaks nearer than this are one

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

// Ends of the chamfer in VP.
struct Ends {
  double S1 = 0, T1 = 0, S2 = 0, T2 = 0;
  bool converged = false;
};

// [E 13..15, 17, 21] while G2 stays on the part of the profile that P is on. Body F and wall w are
// quadratic in y = (S2, T2): a move d from where they are known leaves exactly F + F_y d + d.q d /
// 2, so one linearisation and a few cheap steps d = -J^-1 (F + d.q d / 2, w + d.k d / 2) solve
// both.
Ends ends_beside(const Plane& vp, double W, double sine, double cosine) {
  const double over_s = 1 / vp.s;
  const double k = vp.kappa * vp.tau * vp.tau;
  const double dS1 = W * sine;
  const double dT1 = -W * cosine;
  const double T0 = W * (cosine - sine * vp.c * over_s);  // of the plane wedge
  const double tolerance = 4e-16 * (W + std::abs(T0));
  const auto F_quadratic = [&](double S, double T) {
    return 0.5 * ((vp.q11 * S + 2 * vp.q12 * T) * S + vp.q22 * T * T);
  };
  const auto w_quadratic = [&](double S, double T) { return 0.5 * (vp.kappa * S * S + k * T * T); };
  // First with the slopes of the plane wedge.
  double S = -w_quadratic(0, T0);
  double T = T0 - over_s * (F_quadratic(dS1, T0 + dT1) + vp.c * S);
  for (int i = 0; i < 6; ++i) {
    const double S1 = S + dS1;
    const double T1 = T + dT1;
    const double F_S = vp.c + vp.q11 * S1 + vp.q12 * T1;
    const double F_T = vp.s + vp.q12 * S1 + vp.q22 * T1;
    const double F = 0.5 * ((vp.c + F_S) * S1 + (vp.s + F_T) * T1);  // [E 13]
    const double w_S = 1 + vp.kappa * S;
    const double w_T = k * T;
    const double w = 0.5 * ((1 + w_S) * S + w_T * T);  // [E 14]
    const double slope = w_S * F_T - w_T * F_S;
    if (!(slope > 0)) break;  // past the body's summit: not the root next to P
    const double over = 1 / slope;
    double dS = over * (w_T * F - F_T * w);
    double dT = over * (F_S * w - w_S * F);
    for (int j = 0; j < 6; ++j) {
      const double F_d = F + F_quadratic(dS, dT);
      const double w_d = w + w_quadratic(dS, dT);
      const double next_S = over * (w_T * F_d - F_T * w_d);
      const double next_T = over * (F_S * w_d - w_S * F_d);
      const double change = std::abs(next_S - dS) + std::abs(next_T - dT);
      dS = next_S;
      dT = next_T;
      if (change <= tolerance) {
        return {.S1 = S1 + dS, .T1 = T1 + dT, .S2 = S + dS, .T2 = T + dT, .converged = true};
      }
    }
    S += dS;
    T += dT;
  }
  return {};
}

struct WallPoint {
  double S = 0;
  double slope = 0;  // dS/dT
};

// [E 14] by the signed distance of the whole profile: Newton from the outside, where the distance
// is convex. At the far side of the hole there is no wall: S is not a number.
WallPoint wall_at(const Plane& vp, double T) {
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

// [E 13..15, 17, 21] anywhere: slide the chord of length W and angle delta along the wall until G1
// is on the body.
Ends ends_across(const Plane& vp, double W, double sine, double cosine) {
  const double T0 = W * (cosine - sine * vp.c / vp.s);  // of the plane wedge
  const auto body = [&](double T) -> RootSample {
    const WallPoint wall = wall_at(vp, T);
    if (!std::isfinite(wall.S)) return {.value = std::numeric_limits<double>::infinity()};
    const double S1 = wall.S + W * sine;
    const double T1 = T - W * cosine;
    const double F_S = vp.c + vp.q11 * S1 + vp.q12 * T1;
    const double F_T = vp.s + vp.q12 * S1 + vp.q22 * T1;
    return {.value = 0.5 * ((vp.c + F_S) * S1 + (vp.s + F_T) * T1),
            .slope = F_S * wall.slope + F_T,
            .second = vp.q22};
  };
  const double reach = 10 * (W / vp.s + std::abs(T0));
  const double tolerance = 2e-15 * (W + std::abs(T0) + vp.profile.R2);
  const Root root = rising_root(body, -1e-3 * W, reach, T0, tolerance);
  const double S = wall_at(vp, root.x).S;
  return {.S1 = S + W * sine,
          .T1 = root.x - W * cosine,
          .S2 = S,
          .T2 = root.x,
          .converged = root.converged};
}

// Is the G2 of ends_beside() on the wall, or has it run past a joint?
bool is_on_wall(const Plane& vp, const Ends& e) {
  const Eigen::Vector2d half(vp.profile.straight_across / 2, vp.profile.straight_along / 2);
  if (half.isZero(0)) return true;
  const Eigen::Vector2d q = vp.p + e.S2 * vp.n2 + vp.tau * e.T2 * vp.t2;
  const Eigen::Vector2d core = q.cwiseMax(-half).cwiseMin(half);
  const double scale = vp.profile.R2 + half.sum();
  return std::abs((q - core).norm() - vp.profile.R2) <= 1e-14 * scale;
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
  const double body = (vp.c + 0.5 * (vp.q11 * e.S2 + vp.q12 * e.T2)) * e.S2 +
                      (vp.s + 0.5 * (vp.q12 * e.S2 + vp.q22 * e.T2)) * e.T2;
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

// Ascending, and of parameters that are one in effect only one.
void make_ascending(std::vector<double>& parameters) {
  std::ranges::sort(parameters);
  const auto [first, last] =
      std::ranges::unique(parameters, [](double a, double b) { return b - a < same_parameter; });
  parameters.erase(first, last);
}

void add_passages(Section& section, double v) {
  const std::vector<double> all = passages(section.ridge, v);
  section.corners.insert(section.corners.end(), all.begin(), all.end());
}

}  // namespace

Section section(const geometry::Edge& edge, const Chamfer& chamfer) {
  require(chamfer);
  const auto& [W, D, section_angle, method] = chamfer;
  Section s{.edge = &edge, .chamfer = &chamfer, .ridge = ridge_line(edge)};
  for (const double joint : joints(edge.profile)) add_passages(s, joint);
  s.CM = std::sqrt((D - W / 2) * (D + W / 2));  // [E 16]
  if (const auto* constant = std::get_if<ConstantAngle>(&section_angle)) {
    s.sin_delta = std::sin(constant->delta);
    s.cos_delta = std::cos(constant->delta);
  } else if (const auto* table = std::get_if<AngleTable>(&section_angle)) {
    for (const AngleTable::Entry& entry : table->entries) {
      add_passages(s, parameter_at(edge.profile, entry.phi));
    }
  }
  make_ascending(s.corners);
  s.breaks = s.corners;
  if (method == Method::Swept) {
    for (const double u : wall_breaks(s)) s.breaks.push_back(u - std::floor(u));
    make_ascending(s.breaks);
  }
  return s;
}

// Document 000, [0094]..[0130]; design: sections 3 and 4. Hole frame.
SectionPoint section_at(const Section& section, double u) {
  const geometry::RidgeLine& line = section.ridge;
  const double W = section.chamfer->W;
  const geometry::ProfilePoint profile = profile_at(line, u);
  SectionPoint point;
  point.ridge = ridge_at(line, profile, u);
  const auto& [P, n1, n2, t, e1, e2, theta] = point.ridge;

  const double m = line.m;
  const double c = m * n1.head<2>().dot(profile.normal);  // = -cos(theta)
  const double s = m * n1.dot(e2);                        // = sin(theta)
  const Plane vp{.profile = line.profile,
                 .p = profile.p,
                 .n2 = profile.normal,
                 .t2 = profile.tangent,
                 .kappa = profile.curvature,
                 .tau = e2.head<2>().dot(profile.tangent),
                 .c = c,
                 .s = s,
                 .q11 = m * second(line.F, e1, e1),
                 .q12 = m * second(line.F, e1, e2),
                 .q22 = m * second(line.F, e2, e2)};
  const Direction direction = direction_at(section, point.ridge, c, s);
  point.delta = direction.delta;
  const double sine = direction.sine;
  const double cosine = direction.cosine;

  Ends e = ends_beside(vp, W, sine, cosine);
  if (!e.converged || !is_on_wall(vp, e)) e = ends_across(vp, W, sine, cosine);
  if (!e.converged) {
    refuse(section, u, point.ridge, "no chord of that length at that angle ends on both surfaces");
  }
  point.G2 = P + e.S2 * e1 + e.T2 * e2;                 // [E 12]
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
