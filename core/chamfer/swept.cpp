#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/text.hpp"
#include "core/chamfer/border.hpp"
#include "core/chamfer/section.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int iterations_limit = 40;
constexpr double ridge_doubt = 0.3;         // of the ridge's second derivative taken for a border's
constexpr double bent_doubt = 1;            // of B2, beyond a joint
constexpr double left_out = 2e-11;          // of D, in a squared length: 1e-11 mm in a length
constexpr double joint_step = 1e-12;        // u beyond a joint, to be on its other side
constexpr double joint_reach = 0.03;        // of the loop: a joint further off is not looked beyond
constexpr double most_shift = 0.25;         // of the loop: a border further off belongs elsewhere
constexpr double least_growth = 1.0 / 512;  // step of the continuation in D

double wrapped(double u) {
  const double w = u - std::floor(u);
  return w < 1 ? w : 0;
}

// A border of the chamfer near its point that the ball at C touches: at parameter v, with its
// derivatives by v. At a joint of the profile the border may have a corner: then it has a tangent
// on each side, and the ball may touch the corner itself.
struct Touch {
  bool on_wall = false;  // G2, otherwise G1
  double v = 0;
  Vector3d B, B1, B2;
  double doubt = ridge_doubt;      // relative error of B2, about
  std::optional<Vector3d> before;  // tangent on the side of smaller v, at a corner
};

// What a ball at C sees of a border, to second order about v.
struct Sight {
  double h = 0;                       // (C - B).B'
  double m = 0;                       // -dh/dv
  double square = 0;                  // smallest |C - B|^2 near v
  Vector2d slope = Vector2d::Zero();  // of it by (Sc, Tc)
};

struct Solver {
  const Section* section;
  double u;
  Vector3d e1, e2;
  const std::vector<double>& joints;

  void look(Touch& touch, double v) const {
    const double at = wrapped(v);
    const SectionPoint point = section_at(*section, at);
    const BorderRates rates = border_rates(*section, point, at);
    const Vector3d B1 = touch.on_wall ? rates.G2 : rates.G1;
    const Vector3d B = touch.on_wall ? point.G2 : point.G1;
    // Second derivative: of the cubic through this look and the last, joints apart; or the ridge's.
    const double step = v - touch.v;
    const bool is_smooth = std::abs(step) > 1e-9 && !joint_between(touch.v, step);
    if (is_smooth) {
      touch.B2 = (6 * (touch.B - B) + step * (2 * touch.B1 + 4 * B1)) / (step * step);
      const double bend = step * touch.B2.norm() / B1.norm();
      touch.doubt = std::min(ridge_doubt, bend * bend);
    } else {
      touch.B2 = rates.P2;
      touch.doubt = ridge_doubt;
    }
    touch.v = v;
    touch.B = B;
    touch.B1 = B1;
    touch.before.reset();
  }

  // The joint strictly between v and v + step that comes first.
  std::optional<double> joint_between(double v, double step) const {
    std::optional<double> first;
    for (const double joint : joints) {
      const double j = joint + std::round(v - joint);  // the periodic image next to v
      for (const double image : {j - 1, j, j + 1}) {
        const double way = (image - v) / step;
        if (way > joint_step / std::abs(step) && way < 1 && (!first || way < (*first - v) / step)) {
          first = image;
        }
      }
    }
    return first;
  }

  Sight sight(const Touch& touch, const Vector3d& C) const {
    const Vector3d w = C - touch.B;
    Sight s{.h = w.dot(touch.B1), .m = touch.B1.squaredNorm() - w.dot(touch.B2)};
    Vector3d slope = 2 * w;
    s.square = w.squaredNorm();
    if (touch.before) {  // rests on the corner unless one side draws it away
      const double h_before = w.dot(*touch.before);
      if (h_before >= 0 && s.h <= 0) {
        s.h = 0;
      } else if (h_before < 0) {
        s.h = h_before;
      }
    } else if (s.m > 0) {
      s.square -= s.h * s.h / s.m;
      slope -= 2 * s.h / s.m * touch.B1;
    }
    s.slope = {slope.dot(e1), slope.dot(e2)};
    return s;
  }

  // Moves a touch towards the nearest point of its border; stops at the corner of a joint where the
  // border turns back.
  void follow(Touch& touch, const Sight& seen, const Vector3d& C) const {
    const double step = std::clamp(seen.h / seen.m, -0.05, 0.05);
    if (touch.before) {
      if (seen.h == 0) return;
      look(touch, touch.v + std::copysign(2 * joint_step, step));
      return;
    }
    if (const auto joint = joint_between(touch.v, step)) {
      const double side = std::copysign(joint_step, step);
      Touch near = touch;
      look(near, *joint - side);
      Touch far = near;
      look(far, *joint + side);
      const Touch& left = step > 0 ? near : far;
      const Touch& right = step > 0 ? far : near;
      const Vector3d w = C - far.B;
      if (w.dot(left.B1) >= 0 && w.dot(right.B1) <= 0) {
        touch = right;
        touch.before = left.B1;
        return;
      }
      touch = w.dot(far.B1) * step >= 0 ? far : near;
      return;
    }
    look(touch, touch.v + step);
  }

  // Where the border bends inwards at a joint the ball may come nearer beyond it: the touch there.
  std::optional<Touch> nearer_beyond_joint(const Touch& touch, const Vector3d& C, double D) const {
    for (const double side : {-1.0, 1.0}) {
      const std::optional<double> joint = joint_between(touch.v, side * joint_reach);
      if (!joint || touch.before) continue;
      Touch far = touch;
      look(far, *joint + side * joint_step);
      for (int i = 0; i < 6; ++i) {
        const Sight seen = sight(far, C);
        if (!(seen.m > 0 && seen.h * side > 0) && i == 0) break;  // it only recedes there
        if (seen.m > 0 && seen.square < D * D * (1 - 1e-12) && is_settled(far, seen, D)) return far;
        const double step = seen.h / seen.m;
        if (!(seen.m > 0) || joint_between(far.v, step)) break;
        look(far, far.v + step);
      }
    }
    return std::nullopt;
  }

  // The second-order form corrects the squared length by h^2 / m. Of that it may miss the share by
  // which B2 is wrong, and what the border bends on its way to the foot. A foot beyond a joint is
  // of a border that does not run on like this one.
  bool is_settled(const Touch& touch, const Sight& seen, double D) const {
    if (touch.before) return seen.h == 0;
    const double doubt = joint_between(touch.v, seen.h / seen.m) ? bent_doubt : touch.doubt;
    const double bend = std::abs(seen.h / seen.m) * touch.B2.norm() / touch.B1.norm();
    return seen.h * seen.h * (doubt + bend) <= left_out * D * std::min(1.0, D) * seen.m;
  }

  // Newton in the plane VP from C: the ball of radius D there touches both borders.
  std::optional<Vector3d> solve(Vector3d C, double D, std::array<Touch, 2>& touches) const {
    std::array<bool, 2> switched{};
    for (int i = 0; i < iterations_limit; ++i) {
      std::array<Sight, 2> seen{sight(touches[0], C), sight(touches[1], C)};
      for (int k = 0; k < 8; ++k) {  // with the borders' second-order forms, no new points
        Matrix2d J;
        J.row(0) = seen[0].slope.transpose();
        J.row(1) = seen[1].slope.transpose();
        const Vector2d r(seen[0].square - D * D, seen[1].square - D * D);
        const double determinant = J.determinant();
        if (!(std::abs(determinant) > 1e-12 * D * D)) return std::nullopt;
        const Vector2d step = -J.inverse() * r;
        C += step.x() * e1 + step.y() * e2;
        seen = {sight(touches[0], C), sight(touches[1], C)};
        if (step.norm() < 1e-15 * (1 + D)) break;
      }
      bool settled = true;
      for (std::size_t b = 0; b < 2; ++b) {
        if (!(touches[b].before || seen[b].m > 0)) return std::nullopt;  // the ball does not fit
        if (std::abs(touches[b].v - u) > most_shift) return std::nullopt;
        if (!is_settled(touches[b], seen[b], D)) settled = false;
      }
      if (settled) {
        for (std::size_t b = 0; b < 2 && settled; ++b) {
          if (switched[b]) continue;
          const std::optional<Touch> other = nearer_beyond_joint(touches[b], C, D);
          if (!other) continue;
          touches[b] = *other;
          switched[b] = true;
          settled = false;
        }
        if (settled) return C;
        continue;
      }
      for (std::size_t b = 0; b < 2; ++b) follow(touches[b], seen[b], C);
    }
    return std::nullopt;
  }
};

std::array<Touch, 2> touches_at(const SectionPoint& point, const BorderRates& rates, double u) {
  const Touch body{.on_wall = false,
                   .v = u,
                   .B = point.G1,
                   .B1 = rates.G1,
                   .B2 = rates.P2,
                   .doubt = ridge_doubt,
                   .before = {}};
  const Touch wall{.on_wall = true,
                   .v = u,
                   .B = point.G2,
                   .B1 = rates.G2,
                   .B2 = rates.P2,
                   .doubt = ridge_doubt,
                   .before = {}};
  return {body, wall};
}

// At a joint of the profile the touches start on one side of it, which they know.
double beside_joint(const Solver& solver, double u) {
  for (const double joint : solver.joints) {
    if (std::abs(std::remainder(u - joint, 1)) < 2 * joint_step) return joint + 2 * joint_step;
  }
  return u;
}

// Tool centre of the section method for another radius [E 16..20].
Vector3d centre(const SectionPoint& point, double D, double W) {
  const Vector3d M = 0.5 * (point.G1 + point.G2);
  const Vector3d inward =
      std::cos(point.delta) * point.ridge.e1 + std::sin(point.delta) * point.ridge.e2;
  return M - std::sqrt((D - W / 2) * (D + W / 2)) * inward;
}

// Where the shifts are large the ball is grown from one that just spans the chamfer.
std::optional<Vector3d> grown(const Solver& solver, const SectionPoint& point,
                              const BorderRates& rates, double D, double W) {
  double reached = W / 2 * 1.02;
  if (!(reached < D)) return std::nullopt;
  std::array<Touch, 2> touches = touches_at(point, rates, solver.u);
  std::optional<Vector3d> C = solver.solve(centre(point, reached, W), reached, touches);
  double step = 0.25;  // share of what is left of log D
  while (C && reached < D) {
    const double next = step < 1 ? reached * std::pow(D / reached, step) : D;
    std::array<Touch, 2> tried = touches;
    const Vector3d M = 0.5 * (point.G1 + point.G2);
    const Vector3d start = M + (*C - M) * std::sqrt((next - W / 2) * (next + W / 2)) /
                                   std::sqrt((reached - W / 2) * (reached + W / 2));
    const std::optional<Vector3d> found = solver.solve(start, next, tried);
    if (found) {
      C = found;
      touches = tried;
      reached = next;
      step = std::min(1.0, 2 * step);
    } else {
      step /= 4;
      if (step < least_growth) return std::nullopt;
    }
  }
  return C;
}

}  // namespace

// Design: section 5. The centre curve of a ball that cuts the borders B1 = G1(u), B2 = G2(u) lies
// on both tubes of radius D about them: in VP(u), with v1 = u + a and v2 = u + b,
//   |C - B1(v1)| = D,  (C - B1(v1)).B1'(v1) = 0,
//   |C - B2(v2)| = D,  (C - B2(v2)).B2'(v2) = 0.
// At a foot of the perpendicular the distance is stationary in v, so each pass takes the smallest
// distance of the border's second-order form, solves the two lengths for C, and then moves v1 and
// v2.
SectionPoint swept_at(const Section& section, double u) {
  SectionPoint point = section_at(section, u);
  const double W = section.chamfer->W;
  const double D = section.chamfer->D;
  const Solver solver{.section = &section,
                      .u = u,
                      .e1 = point.ridge.e1,
                      .e2 = point.ridge.e2,
                      .joints = section.breaks};
  const double v = beside_joint(solver, u);
  const BorderRates rates = border_rates(section, point, v);
  std::array<Touch, 2> touches = touches_at(point, rates, v);
  std::optional<Vector3d> C = solver.solve(point.C, D, touches);
  const Vector3d M = 0.5 * (point.G1 + point.G2);
  const auto is_outside = [&] { return C && (*C - M).dot(point.C - M) > 0; };
  if (!is_outside()) C = grown(solver, point, rates, D, W);
  if (!is_outside()) {
    throw Error(ErrorCode::SweptNotReached,
                "no ball of radius " + text(D, "mm") + " cuts the width " + text(W, "mm") +
                    " at u = " + text(u) +
                    ": its cut beside this section reaches further than here",
                {.field = "/method",
                 .value = "swept",
                 .limit = "a smaller tool or width",
                 .parameter = u,
                 .target = to_outer(section.edge->frame, point.ridge.P)});
  }
  point.C = *C;
  return point;
}

SectionPoint swept_at(const geometry::Edge& edge, const Chamfer& chamfer, double u) {
  return swept_at(section(edge, chamfer), u);
}

}  // namespace ridgeline::chamfer
