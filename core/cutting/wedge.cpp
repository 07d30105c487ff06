#include "core/cutting/wedge.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ridgeline::cutting {
namespace {

using geometry::Edge;

Face body_face(const Edge& edge) {
  const geometry::Frame& frame = edge.frame;
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&edge.body)) {
    return Round{geometry::to_outer(frame, cylinder->point), frame.axes * cylinder->axis,
                 cylinder->radius, edge.m > 0 ? MaterialSide::Outside : MaterialSide::Inside};
  }
  const auto& plane = std::get<geometry::Plane>(edge.body);
  const Eigen::Vector3d out = frame.axes * (-edge.m * plane.normal);
  return HalfSpace{out, out.dot(geometry::to_outer(frame, plane.point))};
}

// The wall near a point of the hole frame: where the profile is round, a cylinder about the centre
// of its curvature; where it is straight, a plane. Curvature of the signed distance: t.H.t.
Face wall_face(const Edge& edge, const Eigen::Vector3d& local) {
  constexpr double straight = 1e-9;
  const Eigen::Vector2d p = local.head<2>();
  const geometry::PlaneDistance s = geometry::signed_distance(edge.profile, p);
  const Eigen::Vector2d t(-s.gradient.y(), s.gradient.x());
  const double bend = t.dot(s.hessian * t);  // 1 / distance to the centre of curvature
  const geometry::Frame& frame = edge.frame;
  const auto level = [&](const Eigen::Vector2d& v) { return Eigen::Vector3d(v.x(), v.y(), 0); };
  if (bend < straight) {
    const Eigen::Vector3d out = frame.axes * level(-s.gradient);
    const Eigen::Vector2d on_wall = p - s.value * s.gradient;
    return HalfSpace{out, out.dot(geometry::to_outer(frame, level(on_wall)))};
  }
  const Eigen::Vector2d centre = p - s.gradient / bend;
  return Round{geometry::to_outer(frame, level(centre)), frame.axes.col(2), 1 / bend - s.value,
               MaterialSide::Outside};
}

// Unit vector from a border to the centre, across the feed: the ball touches there as it passes.
Eigen::Vector3d across(const Eigen::Vector3d& v, const Eigen::Vector3d& direction) {
  return (v - v.dot(direction) * direction).normalized();
}

// |G + t f - C| = r - e for the t nearest to 0, f along the face across the feed.
std::optional<Eigen::Vector3d> moved_border(const Eigen::Vector3d& G, const Eigen::Vector3d& normal,
                                            const ChamferPoint& point, double e) {
  const Eigen::Vector3d f = normal.cross(point.direction).normalized();
  const Eigen::Vector3d w = G - point.centre;
  const double r = w.norm();
  const double b = w.dot(f);
  const double disc = b * b - (r * r - (r - e) * (r - e));
  if (disc < 0) return {};
  return G + (-b + std::copysign(std::sqrt(disc), b)) * f;
}

}  // namespace

Station chamfer_station(const Edge& edge, const ChamferPoint& point, double radius) {
  Station station;
  station.centre = point.centre;
  station.direction = point.direction;
  station.feed = point.feed;
  const Eigen::Vector3d n1 = across(point.centre - point.G1, point.direction);
  const Eigen::Vector3d n2 = across(point.centre - point.G2, point.direction);
  station.n = (n1 + n2).normalized();
  station.borders = {n1, n2};
  station.stock.combine = Combine::All;
  station.stock.faces = {body_face(edge),
                         wall_face(edge, geometry::to_local(edge.frame, point.target))};
  if (point.earlier_centre) {
    station.stock.grooves.push_back(
        {*point.earlier_centre, point.direction, radius, MaterialSide::Outside});
  }
  return station;
}

double chamfer_width(const Edge& edge, const ChamferPoint& point, double e1, double e2) {
  const Eigen::Matrix3d& axes = edge.frame.axes;
  const Eigen::Vector3d on_body = geometry::to_local(edge.frame, point.G1);
  const Eigen::Vector2d on_wall = geometry::to_local(edge.frame, point.G2).head<2>();
  const Eigen::Vector3d body_normal = axes * geometry::signed_distance(edge.body, on_body).gradient;
  const Eigen::Vector2d wall = geometry::signed_distance(edge.profile, on_wall).gradient;
  const Eigen::Vector3d wall_normal = axes * Eigen::Vector3d(wall.x(), wall.y(), 0);
  const auto G1 = moved_border(point.G1, body_normal, point, e1);
  const auto G2 = moved_border(point.G2, wall_normal, point, e2);
  if (!G1 || !G2) return 0;
  return (*G1 - *G2).norm();
}

std::vector<Eigen::Vector3d> directions(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : i - 1;
    const std::size_t to = i + 1 < points.size() ? i + 1 : i;
    out.push_back((points[to] - points[from]).normalized());
  }
  return out;
}

}  // namespace ridgeline::cutting
