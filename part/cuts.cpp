#include "part/cuts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace ridgeline::part {
namespace {

double radius_of(const Eigen::Vector3d& p) {
  return std::hypot(p.x(), p.y());
}

/// r over a straight piece from p to q at one z, whose ends may be known better than its chord.
Interval over(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double rp, double rq) {
  Interval found{std::min(rp, rq), std::max(rp, rq)};
  const Eigen::Vector2d d = (q - p).head<2>();
  const double length = d.squaredNorm();
  if (length > 0) {
    const double t = -p.head<2>().dot(d) / length;
    if (t > 0 && t < 1) found.r0 = std::min(found.r0, (p.head<2>() + t * d).norm());
  }
  return found;
}

class PlaneCut : public Cut {
public:
  PlaneCut(const Placed& part, const TurnedFaces& turned, int number) : part_(part) {
    const Face& face = part.model().faces[static_cast<std::size_t>(number)];
    direction_ = Eigen::Vector3d::UnitZ().cross(face.surface.axis).normalized();
    for (const std::vector<EdgeUse>& loop : face.loops) {
      for (const EdgeUse& use : loop) add(use.edge, turned, number);
    }
    std::sort(events.begin(), events.end());
    z0 = events.front();
    z1 = events.back();
  }

  void at(double z, std::vector<Interval>& found) const override {
    found.clear();
    std::vector<Crossing> points;
    for (const Piece& piece : pieces_) {
      if ((piece.z0 < z) != (piece.z1 < z)) points.push_back(crossing(piece, z));
    }
    if (points.empty()) return;
    std::sort(points.begin(), points.end(),
              [](const Crossing& p, const Crossing& q) { return p.along < q.along; });
    const auto add = [&](const Crossing& p, const Crossing& q) {
      found.push_back(over(p.point, q.point, p.r, q.r));
    };
    if (points.size() % 2 != 0) return add(points.front(), points.back());  // grazes a corner: all
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) add(points[i], points[i + 1]);
    merge(found, 1e-9);
  }

private:
  struct Border {
    int edge;
    std::vector<const Meridian*> beyond;  ///< of the turned face there
  };
  struct Piece {
    std::size_t border;
    std::size_t i;
    double z0, z1;
  };
  struct Crossing {
    Eigen::Vector3d point;
    double r, along;
  };

  void add(int number, const TurnedFaces& turned, int face) {
    const Edge& edge = part_.model().edges[static_cast<std::size_t>(number)];
    const Placed::Extent extent = part_.extent_along_z(number);
    events.insert(events.end(),
                  {extent.low, extent.high, edge.points.front().z(), edge.points.back().z()});
    Border border{number, {}};
    for (const Meridian& meridian : turned.meridians) {
      if (meridian.face != face &&
          std::ranges::find(edge.faces, meridian.face) != edge.faces.end()) {
        border.beyond.push_back(&meridian);
      }
    }
    for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
      pieces_.push_back({borders_.size(), i, edge.points[i].z(), edge.points[i + 1].z()});
    }
    borders_.push_back(std::move(border));
  }

  Crossing crossing(const Piece& piece, double z) const {
    const Border& border = borders_[piece.border];
    const Eigen::Vector3d p = part_.crossing(border.edge, piece.i, z);
    Crossing found{p, radius_of(p), p.dot(direction_)};
    double nearest = HUGE_VAL;
    for (const Meridian* meridian : border.beyond) {
      if (meridian->z0 > z || meridian->z1 < z) continue;
      const double there = units::radius_at(meridian->curve, z);
      if (std::abs(there - radius_of(p)) >= nearest) continue;
      nearest = std::abs(there - radius_of(p));
      found.r = there;
    }
    return found;
  }

  const Placed& part_;
  Eigen::Vector3d direction_;
  std::vector<Border> borders_;
  std::vector<Piece> pieces_;
};

class MeshCut : public Cut {
public:
  MeshCut(std::span<const Solid::Triangle> triangles, double deflection, const Face& face) {
    for (const Solid::Triangle& triangle : triangles) {
      Piece piece{&triangle, {}, HUGE_VAL, -HUGE_VAL};
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d& corner = triangle.corners[k];
        piece.r[k] = radius_of(corner);
        piece.z0 = std::min(piece.z0, corner.z());
        piece.z1 = std::max(piece.z1, corner.z());
      }
      pieces_.push_back(piece);
    }
    std::sort(pieces_.begin(), pieces_.end(),
              [](const Piece& p, const Piece& q) { return p.z0 < q.z0; });
    double highest = -HUGE_VAL;
    for (const Piece& piece : pieces_) highest_.push_back(highest = std::max(highest, piece.z1));
    z0 = pieces_.front().z0;
    z1 = highest;
    events = {z0, z1};
    snap = 3 * deflection;
    margin = face.side > 0 || face.surface.kind == SurfaceKind::Other ? deflection : 0;
  }

  void at(double z, std::vector<Interval>& found) const override {
    found.clear();
    const auto after =
        std::lower_bound(pieces_.begin(), pieces_.end(), z,
                         [](const Piece& piece, double value) { return piece.z0 < value; });
    for (auto i = static_cast<std::size_t>(after - pieces_.begin()); i-- > 0 && highest_[i] >= z;) {
      if (pieces_[i].z1 >= z) add(pieces_[i], z, found);
    }
    merge(found, snap);
  }

private:
  struct Piece {
    const Solid::Triangle* triangle;
    std::array<double, 3> r;  ///< of its corners
    double z0, z1;
  };

  static void add(const Piece& piece, double z, std::vector<Interval>& found) {
    std::array<Eigen::Vector3d, 2> ends;
    std::array<double, 2> r{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3 && count < 2; ++k) {
      const std::size_t next = (k + 1) % 3;
      const Eigen::Vector3d& p = piece.triangle->corners[k];
      const Eigen::Vector3d& q = piece.triangle->corners[next];
      if ((p.z() < z) == (q.z() < z)) continue;
      const double t = (z - p.z()) / (q.z() - p.z());
      ends[count] = p + t * (q - p);
      r[count] = std::max(std::lerp(piece.r[k], piece.r[next], t), radius_of(ends[count]));
      ++count;
    }
    if (count == 2) found.push_back(over(ends[0], ends[1], r[0], r[1]));
  }

  std::vector<Piece> pieces_;    ///< ascending in z0
  std::vector<double> highest_;  ///< of all pieces up to this one
};

}  // namespace

void merge(std::vector<Interval>& intervals, double gap) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& p, const Interval& q) { return p.r0 < q.r0; });
  std::size_t count = 0;
  for (const Interval& one : intervals) {
    if (count > 0 && one.r0 <= intervals[count - 1].r1 + gap) {
      intervals[count - 1].r1 = std::max(intervals[count - 1].r1, one.r1);
    } else {
      intervals[count++] = one;
    }
  }
  intervals.resize(count);
}

std::unique_ptr<Cut> plane_cut(const Placed& part, const TurnedFaces& turned, int face) {
  return std::make_unique<PlaneCut>(part, turned, face);
}

std::unique_ptr<Cut> mesh_cut(std::span<const Solid::Triangle> triangles, double deflection,
                              const Face& face) {
  return std::make_unique<MeshCut>(triangles, deflection, face);
}

}  // namespace ridgeline::part
