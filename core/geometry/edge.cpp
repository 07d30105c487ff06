#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/text.hpp"
#include "core/base/tolerance.hpp"
#include "core/geometry/workpiece.hpp"

namespace ridgeline::geometry {
namespace {

void require_length(const char* field, double value, bool zero_allowed) {
  if ((zero_allowed ? value >= 0 : value > 0) && value < length_limit) return;
  throw Error(ErrorCode::BadInput,
              std::string(field) + " is " + text(value, "mm") + "; it must be " +
                  (zero_allowed ? "0 or more" : "greater than 0") + " and below " +
                  text(length_limit, "mm"),
              {.field = std::string("/") + field, .value = text(value, "mm")});
}

void require_finite(const char* field, const Eigen::Vector3d& point) {
  if (point.array().abs().maxCoeff() < length_limit) return;
  throw Error(ErrorCode::BadInput,
              std::string(field) + ": every coordinate must be within " + text(length_limit, "mm"),
              {.field = std::string("/") + field});
}

void require(const Workpiece& workpiece, const Hole& hole) {
  require_finite("position", workpiece.position);
  require_finite("position", hole.position);
  require_length("radius", hole.profile.R2, false);
  require_length("straight_along", hole.profile.straight_along, true);
  require_length("straight_across", hole.profile.straight_across, true);
  if (hole.depth) require_length("depth", *hole.depth, false);
  const bool block = workpiece.shape == BodyShape::ManifoldBlock;
  require_length(block ? "bore_radius" : "inner_radius", workpiece.inner_radius, false);
  double half_width = workpiece.outer_radius;
  if (block) {
    for (const double side : workpiece.size) require_length("size", side, false);
    half_width = std::min(workpiece.size.x(), workpiece.size.z()) / 2;
  } else {
    require_length("outer_radius", workpiece.outer_radius, false);
    require_length("length", workpiece.length, false);
  }
  if (!(workpiece.inner_radius < half_width)) {
    throw Error(ErrorCode::BadInput,
                "the bore radius " + text(workpiece.inner_radius, "mm") +
                    " leaves no wall; it must be below " + text(half_width, "mm"),
                {.field = block ? "/bore_radius" : "/inner_radius",
                 .value = text(workpiece.inner_radius, "mm"),
                 .limit = text(half_width, "mm")});
  }
}

Surface to_local(const Frame& frame, const Surface& surface) {
  if (const auto* cylinder = std::get_if<Cylinder>(&surface)) {
    return Cylinder{.point = to_local(frame, cylinder->point),
                    .axis = direction_to_local(frame, cylinder->axis),
                    .radius = cylinder->radius};
  }
  const Plane& plane = std::get<Plane>(surface);
  return Plane{.point = to_local(frame, plane.point),
               .normal = direction_to_local(frame, plane.normal)};
}

// The outside of the part, in the work frame; the material is at m * distance > 0 of each.
std::vector<Bound> outside(const Workpiece& workpiece) {
  std::vector<Bound> bounds;
  const Eigen::Vector3d A1 = workpiece.axis.normalized();
  if (workpiece.shape == BodyShape::ThickWalledCylinder) {
    bounds.push_back(
        {Cylinder{workpiece.position, A1, workpiece.outer_radius}, -1, "the outer surface"});
    for (const double end : {-1., 1.}) {
      bounds.push_back({Plane{workpiece.position + end * workpiece.length / 2 * A1, end * A1}, -1,
                        "an end of the workpiece"});
    }
    return bounds;
  }
  const Frame frame = block_frame(workpiece);
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (const double end : {-1., 1.}) {
      const Eigen::Vector3d normal = end * frame.axes.col(k);
      bounds.push_back({Plane{frame.origin + workpiece.size[k] / 2 * normal, normal}, -1,
                        "a side of the block"});
    }
  }
  return bounds;
}

// Where A2 (z' of the frame) enters the bound's inside, or leaves it on the + side: the index of
// the bound that it leaves through, and the height. nullopt: A2 misses the part.
struct Mouth {
  std::size_t bound;
  double height;
};
std::optional<Mouth> mouth(const std::vector<Bound>& bounds, const Frame& frame, Side side) {
  const double sign = side == Side::Entry ? 1 : -1;
  double enters = -length_limit;  // along sign * z'
  double leaves = length_limit;
  std::size_t through = 0;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const Quadric F = quadric(to_local(frame, bounds[k].surface));
    const double A = F.Q(2, 2);
    const double B = sign * F.l.z();
    double high = length_limit;
    if (A > 0) {  // cylinder: between two heights
      const double square = B * B - 2 * A * F.c;
      if (!(square > 0)) return std::nullopt;
      high = (-B + std::sqrt(square)) / A;
      enters = std::max(enters, (-B - std::sqrt(square)) / A);
    } else if (B > 0) {
      high = -F.c / B;
    } else if (B < 0) {
      enters = std::max(enters, -F.c / B);
    } else if (F.c > 0) {
      return std::nullopt;  // runs beside the plane, outside
    }
    if (high < leaves) {
      leaves = high;
      through = k;
    }
  }
  if (!(enters < leaves)) return std::nullopt;
  return Mouth{.bound = through, .height = sign * leaves};
}

// How hole and cylinder meet, seen along A1: a closed ridge on each side while the hole is within
// the cylinder, one that goes round where it breaks out (design: section 2).
void require_meeting(double half_width, double f, double R) {
  const std::string sizes = "half width " + text(half_width, "mm") + ", eccentric distance " +
                            text(f, "mm") + ", body radius " + text(R, "mm");
  const double reach = half_width + std::abs(f);
  if (std::abs(f) - half_width >= R * (1 - tangent_band)) {
    throw Error(ErrorCode::HoleMissesBody, "the hole passes beside the surface: " + sizes,
                {.field = "/hole", .value = text(f, "mm"), .limit = text(half_width + R, "mm")});
  }
  const double other = half_width - std::abs(f);  // the side that the axis is farther from
  if (std::abs(reach - R) <= R * tangent_band || std::abs(other - R) <= R * tangent_band) {
    throw Error(ErrorCode::TangentIntersection,
                "the hole touches the side of the surface, the ridge has a corner: " + sizes,
                {.field = "/hole", .value = text(reach, "mm"), .limit = text(R, "mm")});
  }
}

double clearance(const RidgeLine& ridge, const Bound& bound, double u) {
  return bound.m * signed_distance(bound.surface, ridge_at(ridge, u).P).value;
}

// Smallest clearance of the ridge to a bound, within 1e-9 of the perimeter: the best of many
// samples, refined by golden section (the clearance has one valley between two samples).
double least_clearance(const Edge& edge, const Bound& bound) {
  constexpr int samples = 360;
  const RidgeLine ridge = ridge_line(edge);
  double best = 0;
  double least = clearance(ridge, bound, 0);
  for (int i = 1; i < samples; ++i) {
    const double u = double(i) / samples;
    const double here = clearance(ridge, bound, u);
    if (here < least) {
      least = here;
      best = u;
    }
  }
  double low = best - 1. / samples;
  double high = best + 1. / samples;
  constexpr double golden = 1 / std::numbers::phi;
  while (high - low > 1e-9) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    if (clearance(ridge, bound, a) < clearance(ridge, bound, b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return std::min(least, clearance(ridge, bound, (low + high) / 2));
}

void require_within_bounds(const Edge& edge) {
  for (const Bound& bound : edge.bounds) {
    const double least = least_clearance(edge, bound);
    if (least > 0) continue;
    throw Error(ErrorCode::HoleMissesBody,
                "the edge of the hole runs " + text(-least, "mm") + " past " + bound.name,
                {.field = "/hole", .value = text(least, "mm"), .limit = "0 mm"});
  }
}

void require_eccentricity(const Hole& hole, double f) {
  if (!hole.eccentric_distance) return;
  const double given = *hole.eccentric_distance;
  if (std::abs(given - f) <= eccentricity_tolerance) return;
  throw Error(ErrorCode::InconsistentEccentricity,
              "eccentric_distance is " + text(given, "mm") + ", but the positions give " +
                  text(f, "mm") + "; they must agree to " + text(eccentricity_tolerance, "mm"),
              {.field = "/eccentric_distance", .value = text(given, "mm"), .limit = text(f, "mm")});
}

}  // namespace

std::optional<double> floor_height(const Workpiece& workpiece, const Hole& hole) {
  if (!hole.depth) return std::nullopt;
  const std::optional<Mouth> top =
      mouth(outside(workpiece), hole_frame(workpiece, hole), Side::Entry);
  if (!top) {
    throw Error(ErrorCode::HoleMissesBody, "the axis of the blind hole misses the workpiece",
                {.field = "/hole"});
  }
  return top->height - *hole.depth;
}

Edge edge_of(const Workpiece& workpiece, const Hole& hole, EdgeKind kind, Side side) {
  require(workpiece, hole);
  const double f = eccentric_distance(workpiece, hole);
  require_eccentricity(hole, f);
  if (hole.walls == 1 && side == Side::Exit) {
    throw Error(ErrorCode::HoleMissesBody,
                "the hole goes through one wall only: it has no edge on the exit side",
                {.field = "/side", .value = "exit", .limit = "entry"});
  }

  Edge edge;
  edge.frame = hole_frame(workpiece, hole);
  edge.profile = hole.profile;
  edge.side = side;
  std::vector<Bound> bounds = outside(workpiece);
  if (kind == EdgeKind::Inner) {
    edge.body = Cylinder{workpiece.position, workpiece.axis.normalized(), workpiece.inner_radius};
    edge.m = 1;
  } else {
    std::size_t through = 0;  // the outer cylinder
    if (workpiece.shape == BodyShape::ManifoldBlock) {
      const std::optional<Mouth> face = mouth(bounds, edge.frame, side);
      if (!face) {
        throw Error(ErrorCode::HoleMissesBody, "the hole axis misses the block",
                    {.field = "/hole"});
      }
      through = face->bound;
    }
    edge.body = bounds[through].surface;
    edge.m = -1;
    bounds[through] = {
        Cylinder{workpiece.position, workpiece.axis.normalized(), workpiece.inner_radius}, 1,
        "the bore"};
  }
  edge.body = to_local(edge.frame, edge.body);
  for (Bound& bound : bounds) {
    edge.bounds.push_back({to_local(edge.frame, bound.surface), bound.m, bound.name});
  }
  if (const std::optional<double> floor = floor_height(workpiece, hole)) {
    edge.bounds.push_back(
        {Plane{{0, 0, *floor}, Eigen::Vector3d::UnitZ()}, 1, "the floor of the blind hole"});
  }

  if (const auto* cylinder = std::get_if<Cylinder>(&edge.body)) {
    require_meeting(half_extents(hole.profile).x(), f, cylinder->radius);
    if (breaks_out(hole.profile, f, cylinder->radius)) {
      if (hole.walls == 1 || hole.depth) {
        throw Error(ErrorCode::HoleMissesBody,
                    "a hole that breaks out of the side of the surface has one edge round both "
                    "walls: it must go through both",
                    {.field = "/hole",
                     .value = text(half_extents(hole.profile).x(), "mm"),
                     .limit = text(cylinder->radius - std::abs(f), "mm")});
      }
      edge.merged = break_out(hole.profile, f, cylinder->radius, side == Side::Entry);
    }
  }
  require_within_bounds(edge);
  return edge;
}

}  // namespace ridgeline::geometry
