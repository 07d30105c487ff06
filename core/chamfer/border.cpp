#include "core/chamfer/border.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/chamfer/section_angle.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// d delta / du of each kind of section angle; theta_rate = d theta / du.
double delta_rate(const SectionAngle& angle, double theta_rate, const Vector2d& p,
                  const Vector2d& p_rate) {
  if (std::holds_alternative<Bisector>(angle)) return -theta_rate / 2;
  if (const auto* table = std::get_if<AngleTable>(&angle)) {
    const double phi = std::atan2(p.y(), p.x());
    const double phi_rate = (p.x() * p_rate.y() - p.y() * p_rate.x()) / p.squaredNorm();
    return table_angle(*table, phi).slope * phi_rate;
  }
  return 0;
}

}  // namespace

// With ' = d/du, wall of normal n2' = kappa (P'.t2) t2, body F of Hessian Q:
//   P'  = rate t                                      (a)
//   n1.P'' + P'.Q P' = 0, n2.P'' + kappa (P'.t2)^2 = 0 (b)
//   c = m n1.e1 = -cos(theta),  theta' = c'/sin(theta) (c)
//   e2 = v/|v|, v = m n1 - c e1                       (d)
//   G2 = P + S e1 + T e2,  s(G2) = 0                  (e)
//   G1 = G2 + W d,         F(G1) = 0,  d = sin(delta) e1 - cos(delta) e2   (f)
// S' and T' follow from the two linear equations that (e) and (f) differentiate to.
BorderRates border_rates(const Section& section, const SectionPoint& point, double u) {
  const geometry::RidgeLine& line = section.ridge;
  const auto& [P, n1, n2, t, e1, e2, theta] = point.ridge;
  const double m = line.m;
  const double W = section.chamfer->W;
  const geometry::ProfilePoint profile = profile_at(line, u);

  BorderRates rates;
  rates.P = ridge_rate(line, point.ridge, profile, u) * t;  // (a)
  const Vector2d p1 = rates.P.head<2>();
  const Vector3d QP1 = hessian_times(line.F, rates.P);
  // (b) in the plane of n1 and n2; then along t: the profile is passed at a constant rate. Of a
  // merged edge it is not, and that part is left out.
  const double along = p1.dot(profile.tangent);
  const double body_bend = -rates.P.dot(QP1);
  const double wall_bend = -profile.curvature * along * along;
  const double n12 = n1.dot(n2);
  rates.P2 =
      ((body_bend - n12 * wall_bend) * n1 + (wall_bend - n12 * body_bend) * n2) / (1 - n12 * n12);
  if (!line.merged) {
    const Vector2d& t2 = profile.tangent;
    rates.P2 -= rates.P2.head<2>().dot(t2) / t.head<2>().dot(t2) * t;
  }

  const Vector3d e1_rate(profile.curvature * p1.x(), profile.curvature * p1.y(), 0);
  const double c = m * n1.dot(e1);
  const double c_rate = m * (QP1.dot(e1) + n1.dot(e1_rate));
  const double s = m * n1.dot(e2);                              // = sin(theta)
  const Vector3d v_rate = m * QP1 - c_rate * e1 - c * e1_rate;  // (d)
  const Vector3d e2_rate = (v_rate - v_rate.dot(e2) * e2) / s;

  const double delta1 =
      delta_rate(section.chamfer->section_angle, c_rate / s, profile.p, p1);  // (c)
  const double sine = std::sin(point.delta);
  const double cosine = std::cos(point.delta);
  const Vector3d d_rate =
      delta1 * (cosine * e1 + sine * e2) + sine * e1_rate - cosine * e2_rate;  // (f)

  const Vector3d to_G2 = point.G2 - P;
  const Vector3d A = rates.P + to_G2.dot(e1) * e1_rate + to_G2.dot(e2) * e2_rate;  // (e)
  const Vector2d wall = geometry::signed_distance(line.profile, point.G2.head<2>()).gradient;
  const Vector3d body = gradient(line.F, point.G1);
  const double w1 = wall.dot(e1.head<2>());
  const double w2 = wall.dot(e2.head<2>());
  const double b1 = body.dot(e1);
  const double b2 = body.dot(e2);
  const double wA = -wall.dot(A.head<2>());
  const double bA = -body.dot(A + W * d_rate);
  const double determinant = w1 * b2 - w2 * b1;
  const double S_rate = (wA * b2 - w2 * bA) / determinant;
  const double T_rate = (w1 * bA - wA * b1) / determinant;
  rates.G2 = A + S_rate * e1 + T_rate * e2;
  rates.G1 = rates.G2 + W * d_rate;
  return rates;
}

// How far G2 is past a joint along the profile grows with u: a bracket about the joint, then a
// root.
std::vector<double> wall_breaks(const Section& section) {
  constexpr double least_reach = 1e-6;  // of the loop
  constexpr double most_reach = 0.1;
  const geometry::Profile& profile = section.ridge.profile;
  std::vector<double> breaks;
  std::vector<double> joints;
  for (const double joint : geometry::joints(profile)) {
    for (const double u : passages(section.ridge, joint)) joints.push_back(u);
  }
  for (const double joint : joints) {
    const geometry::ProfilePoint at = profile_at(section.ridge, joint);
    const Vector2d onward = is_forward(section.ridge, joint) ? at.tangent : Vector2d(-at.tangent);
    const auto past = [&](double u) -> RootSample {
      const SectionPoint point = section_at(section, u);
      return {.value = onward.dot(point.G2.head<2>() - at.p),
              .slope = onward.dot(border_rates(section, point, u).G2.head<2>())};
    };
    try {
      double reach = least_reach;
      while (reach < most_reach &&
             !(past(joint - reach).value < 0 && past(joint + reach).value > 0)) {
        reach *= 4;
      }
      if (!(reach < most_reach)) continue;
      const double tolerance = 1e-15 * geometry::perimeter(profile);
      breaks.push_back(rising_root(past, joint - reach, joint + reach, joint, tolerance).x);
    } catch (const Error& error) {
      // No chamfer is possible there, so no border bends; who asks for that section is told why.
      if (error.code() != ErrorCode::WidthTooLarge) throw;
    }
  }
  return breaks;
}

}  // namespace ridgeline::chamfer
