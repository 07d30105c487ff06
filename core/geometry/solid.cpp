#include "core/geometry/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/geometry/line_meetings.hpp"

namespace ridgeline::geometry {
namespace {

constexpr double on_boundary = 1e-8;  ///< a computed point of a surface is this near to it [mm]

double bounding_radius(const Workpiece& workpiece) {
  if (workpiece.shape == BodyShape::ManifoldBlock) return workpiece.size.norm() / 2;
  return std::hypot(workpiece.outer_radius, workpiece.length / 2);
}

Roots meetings(const Prism& prism, const Eigen::Vector3d& point, const Eigen::Vector3d& along) {
  const Eigen::Vector3d p = to_local(prism.frame, point);
  const Eigen::Vector3d d = direction_to_local(prism.frame, along);
  const Eigen::Vector2d p2 = p.head<2>();
  const Eigen::Vector2d d2 = d.head<2>();
  if (!(d2.norm() > parallel_sine)) return {};
  return line_meetings(prism.profile, p2, d2);
}

Roots meetings(const Plane& plane, const Eigen::Vector3d& point, const Eigen::Vector3d& along) {
  const double slope = plane.normal.dot(along);
  if (!(std::abs(slope) > parallel_sine)) return {};
  return {{plane.normal.dot(plane.point - point) / slope, 0}, 1};
}

/// Points of a profile that are nearest to p among their neighbours.
struct ProfileFeet {
  std::array<Eigen::Vector2d, 8> p;
  std::size_t count = 0;
  void add(const Eigen::Vector2d& q) { p[count++] = q; }
};

ProfileFeet circle_feet(double R, const Eigen::Vector2d& p) {
  ProfileFeet feet;
  const double r = p.norm();
  if (r > 1e-9 * R) {
    feet.add(p * (R / r));
  } else {  // on the axis every point is as near
    for (int i = 0; i < 8; ++i) {
      const double w = i * std::numbers::pi / 4;
      feet.add(R * Eigen::Vector2d(std::cos(w), std::sin(w)));
    }
  }
  return feet;
}

ProfileFeet profile_feet(const Profile& profile, const Eigen::Vector2d& p) {
  if (is_circle(profile)) return circle_feet(profile.R2, p);
  const double a = profile.straight_across / 2;
  const double b = profile.straight_along / 2;
  const double R = profile.R2;
  ProfileFeet feet;
  for (const double sign : {1.0, -1.0}) {
    if (b > 0 && std::abs(p.y()) <= b) feet.add({sign * (a + R), p.y()});
    if (a > 0 && std::abs(p.x()) <= a) feet.add({p.x(), sign * (b + R)});
  }
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      const Eigen::Vector2d corner(x * a, y * b);
      const Eigen::Vector2d out = p - corner;
      const double r = out.norm();
      if (r > 0 && x * out.x() >= 0 && y * out.y() >= 0 && feet.count < feet.p.size()) {
        feet.add(corner + out * (R / r));
      }
    }
  }
  return feet;
}

}  // namespace

Solid::Solid(const Workpiece& workpiece)
    : material_(material_of(workpiece)),
      centre_(workpiece.position),
      reach_(bounding_radius(workpiece)) {
  for (std::size_t i = 0; i <= material_.cavities.size(); ++i) {
    const Cell& here = cell({i, {}});
    if (here.wall) faces_.push_back({i, {}});
    for (std::size_t k = 0; k < here.planes.size(); ++k) faces_.push_back({i, k});
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    for (std::size_t k = i + 1; k < faces_.size(); ++k) add_meetings(faces_[i], faces_[k]);
  }
  seams_ = Trace(std::exchange(seam_pieces_, {}));
}

const Cell& Solid::cell(const Face& face) const {
  return face.cell == 0 ? material_.outside : material_.cavities[face.cell - 1];
}
const Prism& Solid::wall(const Face& face) const {
  return *cell(face).wall;
}
const Plane& Solid::plane(const Face& face) const {
  return cell(face).planes[*face.plane];
}

double Solid::height(const Face& face, const Eigen::Vector3d& p) const {
  double s = 0;
  if (face.plane) {
    s = plane(face).normal.dot(p - plane(face).point);
  } else {
    const Eigen::Vector3d local = to_local(wall(face).frame, p);
    s = plane_distance(wall(face).profile, local.x(), local.y());
  }
  return face.cell == 0 ? s : -s;
}

bool Solid::is_boundary(const Eigen::Vector3d& p) const {
  return geometry::distance(material_, p) <= on_boundary * (1 + reach_ / 100);
}

bool Solid::is_within_cell(const Face& face, const Eigen::Vector3d& p) const {
  const double slack = on_boundary * (1 + reach_ / 100);
  const Cell& here = cell(face);
  const double sign = face.cell == 0 ? 1 : -1;  // of the height, outside the cell
  if (here.wall && face.plane && sign * height({face.cell, {}}, p) > slack) return false;
  for (std::size_t k = 0; k < here.planes.size(); ++k) {
    if (face.plane != k && sign * height({face.cell, k}, p) > slack) return false;
  }
  return true;
}

bool Solid::is_on_seam(const SeamPart& part, const Eigen::Vector3d& p) const {
  return is_boundary(p) && is_within_cell(part.one, p) && is_within_cell(part.two, p);
}

void Solid::feet(const Face& face, const Eigen::Vector3d& p, double reach,
                 const std::function<void(const Eigen::Vector3d&)>& found) const {
  const auto offer = [&](const Eigen::Vector3d& q) {
    if ((q - p).norm() < reach && is_boundary(q)) found(q);
  };
  const double h = height(face, p);
  if (!(std::abs(h) < reach)) return;
  if (face.plane) return offer(p - plane(face).normal * (face.cell == 0 ? h : -h));
  const Frame& frame = wall(face).frame;
  const Eigen::Vector3d local = to_local(frame, p);
  const ProfileFeet feet = profile_feet(wall(face).profile, local.head<2>());
  for (std::size_t i = 0; i < feet.count; ++i) {
    offer(to_outer(frame, {feet.p[i].x(), feet.p[i].y(), local.z()}));
  }
}

std::optional<Eigen::Vector3d> Solid::seam_at(const SeamPart& part, double parameter) const {
  if (const auto* line = std::get_if<SeamPart::Line>(&part.curve)) {
    return line->point + parameter * line->direction;
  }
  const auto& [face, other, root] = std::get<SeamPart::Generators>(part.curve);
  const Prism& prism = wall(face);
  const Eigen::Vector2d p = profile_at(prism.profile, parameter).p;
  const Eigen::Vector3d point = to_outer(prism.frame, {p.x(), p.y(), 0});
  const Eigen::Vector3d along = prism.frame.axes.col(2);
  const Roots roots =
      other.plane ? meetings(plane(other), point, along) : meetings(wall(other), point, along);
  if (root >= roots.count) return std::nullopt;
  return point + roots.z[static_cast<std::size_t>(root)] * along;
}

// A foot at the distance of the bound is the nearest: the seams need not be asked.
Solid::Nearest Solid::nearest(const Eigen::Vector3d& p) const {
  const double least = geometry::distance(material_, p);
  Nearest best{.point = p, .distance = std::numeric_limits<double>::infinity()};
  for (const Face& face : faces_) {
    feet(face, p, best.distance, [&](const Eigen::Vector3d& q) {
      const double distance = (q - p).norm();  // a face has several feet
      if (distance < best.distance) best = {.point = q, .distance = distance};
    });
  }
  if (best.distance <= least * (1 + 1e-12)) return best;
  const Foot seam = seams_.nearest(p, 0, best.distance);
  if (seam.distance < best.distance) best = {.point = seam.point, .distance = seam.distance};
  return best;
}

double Solid::distance(const Eigen::Vector3d& p) const {
  const double least = geometry::distance(material_, p);
  return least > 0 ? nearest(p).distance : least;
}

}  // namespace ridgeline::geometry
