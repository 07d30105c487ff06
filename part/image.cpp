#include "part/image.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

namespace ridgeline::part {
namespace {

using units::Curve;

constexpr double shortest = 0.02;      // [mm]: slabs are not divided further
constexpr double exact_fit = 1e-3;     // [mm]: of lines to the image of a plane face
constexpr double exact_snap = 1e-4;    // [mm]: to a meridian
constexpr double mesh_share = 2e-4;    // deflection per extent of the part
constexpr double finest_mesh = 0.002;  // [mm]
constexpr double coarsest_mesh = 0.1;  // [mm]
constexpr std::array<double, 5> stations = {0.001, 0.25, 0.5, 0.75, 0.999};

double radius_of(const Eigen::Vector3d& p) {
  return std::hypot(p.x(), p.y());
}

struct Interval {
  double r0 = 0;
  double r1 = 0;
};

/// Sorted, those that touch as one.
std::vector<Interval> merged(std::vector<Interval> intervals, double gap) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& p, const Interval& q) { return p.r0 < q.r0; });
  std::vector<Interval> result;
  for (const Interval& one : intervals) {
    if (!result.empty() && one.r0 <= result.back().r1 + gap)
      result.back().r1 = std::max(result.back().r1, one.r1);
    else
      result.push_back(one);
  }
  return result;
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

/// A face whose cut at any z between z0 and z1 can be asked for.
class Cut {
public:
  virtual ~Cut() = default;
  virtual std::vector<Interval> at(double z) const = 0;
  double z0 = 0;
  double z1 = 0;
  std::vector<double> events;  ///< z where the cut changes its kind
  double snap = exact_snap;    ///< ends so near to a meridian lie on it
  double margin = 0;           ///< the face may reach so far beyond its cut
};

/// Plane: straight across, between the edges that cross.
class PlaneCut : public Cut {
public:
  PlaneCut(const Placed& part, const Face& face) : part_(part) {
    direction_ = Eigen::Vector3d::UnitZ().cross(face.surface.axis).normalized();
    for (const std::vector<EdgeUse>& loop : face.loops)
      for (const EdgeUse& use : loop) add(use.edge);
    std::sort(events.begin(), events.end());
    z0 = events.front();
    z1 = events.back();
  }

  std::vector<Interval> at(double z) const override {
    std::vector<Eigen::Vector3d> points;
    for (const Piece& piece : pieces_)
      if ((piece.z0 < z) != (piece.z1 < z))
        points.push_back(part_.crossing(piece.edge, piece.i, z));
    if (points.empty()) return {};
    std::sort(points.begin(), points.end(),
              [&](const auto& p, const auto& q) { return p.dot(direction_) < q.dot(direction_); });
    if (points.size() % 2 != 0)  // grazes a corner: all of it
      return {
          over(points.front(), points.back(), radius_of(points.front()), radius_of(points.back()))};
    std::vector<Interval> found;
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
      found.push_back(
          over(points[i], points[i + 1], radius_of(points[i]), radius_of(points[i + 1])));
    return merged(std::move(found), 1e-9);
  }

private:
  struct Piece {
    int edge;
    std::size_t i;
    double z0, z1;
  };

  void add(int number) {
    const Edge& edge = part_.model().edges[static_cast<std::size_t>(number)];
    const Placed::Extent extent = part_.extent(number, Eigen::Vector3d::UnitZ());
    events.insert(events.end(),
                  {extent.low, extent.high, edge.points.front().z(), edge.points.back().z()});
    for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
      pieces_.push_back({number, i, edge.points[i].z(), edge.points[i + 1].z()});
  }

  const Placed& part_;
  Eigen::Vector3d direction_;
  std::vector<Piece> pieces_;
};

/// Any other face: its triangles. Between nodes on a turned face r is interpolated, not the chord.
class MeshCut : public Cut {
public:
  MeshCut(std::vector<Solid::Triangle> triangles, double deflection, const Face& face)
      : triangles_(std::move(triangles)) {
    z0 = HUGE_VAL;
    z1 = -HUGE_VAL;
    for (const Solid::Triangle& triangle : triangles_) {
      for (const Eigen::Vector3d& corner : triangle.corners) {
        z0 = std::min(z0, corner.z());
        z1 = std::max(z1, corner.z());
      }
    }
    if (!triangles_.empty()) events = {z0, z1};
    snap = 3 * deflection;
    margin = face.side > 0 || face.surface.kind == SurfaceKind::Other ? deflection : 0;
  }

  std::vector<Interval> at(double z) const override {
    std::vector<Interval> found;
    for (const Solid::Triangle& triangle : triangles_) {
      std::array<Eigen::Vector3d, 2> ends;
      std::array<double, 2> r{};
      std::size_t count = 0;
      for (int k = 0; k < 3 && count < 2; ++k) {
        const Eigen::Vector3d& p = triangle.corners[k];
        const Eigen::Vector3d& q = triangle.corners[(k + 1) % 3];
        if ((p.z() < z) == (q.z() < z)) continue;
        const double t = (z - p.z()) / (q.z() - p.z());
        ends[count] = p + t * (q - p);
        r[count] = std::max(std::lerp(radius_of(p), radius_of(q), t), radius_of(ends[count]));
        ++count;
      }
      if (count == 2) found.push_back(over(ends[0], ends[1], r[0], r[1]));
    }
    return merged(std::move(found), snap);
  }

private:
  std::vector<Solid::Triangle> triangles_;
};

/// All free faces together, cut at one z; ends on meridians lie there exactly.
class Cuts {
public:
  Cuts(std::vector<std::unique_ptr<Cut>> cuts, const TurnedFaces& turned)
      : cuts_(std::move(cuts)), turned_(turned) {}

  std::vector<double> events() const {
    std::vector<double> z;
    for (const auto& cut : cuts_) z.insert(z.end(), cut->events.begin(), cut->events.end());
    for (const Meridian& meridian : turned_.meridians)
      z.insert(z.end(), {meridian.z0, meridian.z1});
    std::sort(z.begin(), z.end());
    std::vector<double> apart;
    for (const double one : z)
      if (apart.empty() || one - apart.back() > 1e-6) apart.push_back(one);
    return apart;
  }

  /// The faces that a slab meets.
  std::vector<const Cut*> in(double z0, double z1) const {
    std::vector<const Cut*> found;
    for (const auto& cut : cuts_)
      if (cut->z0 < z1 - 1e-9 && cut->z1 > z0 + 1e-9) found.push_back(cut.get());
    return found;
  }

  std::vector<Interval> at(double z, const std::vector<const Cut*>& cuts) const {
    std::vector<Interval> all;
    for (const Cut* cut : cuts) {
      if (z <= cut->z0 || z >= cut->z1) continue;
      for (Interval one : cut->at(z)) {
        one.r0 = placed(one.r0, z, *cut, -1);
        one.r1 = placed(one.r1, z, *cut, 1);
        all.push_back(one);
      }
    }
    return merged(std::move(all), 1e-6);
  }

private:
  double placed(double r, double z, const Cut& cut, int way) const {
    double nearest = cut.snap;
    double found = std::max(0.0, r + way * cut.margin);
    for (const Meridian& meridian : turned_.meridians) {
      if (meridian.z0 > z || meridian.z1 < z) continue;
      const double there = units::radius_at(meridian.curve, z);
      if (std::abs(there - r) > nearest) continue;
      nearest = std::abs(there - r);
      found = there;
    }
    return found;
  }

  std::vector<std::unique_ptr<Cut>> cuts_;
  const TurnedFaces& turned_;
};

/// Fits cells to the cuts of all free faces, slab by slab.
class Cells {
public:
  Cells(const Cuts& cuts, const TurnedFaces& turned, double fit, Image& image)
      : cuts_(cuts), turned_(turned), fit_(fit), image_(image) {}

  void between(double z0, double z1, const std::vector<const Cut*>& faces) {
    std::array<std::vector<Interval>, stations.size()> cuts;
    bool is_even = true;
    bool is_empty = false;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      cuts[i] = cuts_.at(std::lerp(z0, z1, stations[i]), faces);
      is_even &= cuts[i].size() == cuts[0].size();
      is_empty |= cuts[i].empty();
    }
    const bool is_short = z1 - z0 < shortest;
    if (!is_even && !is_short) return divide(z0, z1, faces);
    if (!is_even && is_empty) return hull(z0, z1, cuts);
    if (!is_even)
      for (auto& cut : cuts) cut = {{cut.front().r0, cut.back().r1}};
    std::vector<Image::Cell> made;
    for (std::size_t k = 0; k < cuts[0].size(); ++k) {
      Values r0{}, r1{};
      for (std::size_t i = 0; i < stations.size(); ++i) {
        r0[i] = cuts[i][k].r0;
        r1[i] = cuts[i][k].r1;
      }
      Image::Cell cell{.z0 = z0, .z1 = z1, .inner = {}, .outer = {}};
      if (!side(z0, z1, r0, -1, is_short, cell.inner) || !side(z0, z1, r1, 1, is_short, cell.outer))
        return divide(z0, z1, faces);
      made.push_back(cell);
    }
    image_.cells.insert(image_.cells.end(), made.begin(), made.end());
  }

private:
  using Values = std::array<double, stations.size()>;

  void divide(double z0, double z1, const std::vector<const Cut*>& faces) {
    const double middle = std::midpoint(z0, z1);
    between(z0, middle, faces);
    between(middle, z1, faces);
  }

  /// A short slab in which a face ends or begins: all that it reaches.
  void hull(double z0, double z1, const std::array<std::vector<Interval>, stations.size()>& cuts) {
    Interval all{HUGE_VAL, 0};
    for (const auto& cut : cuts) {
      for (const Interval& one : cut) {
        all.r0 = std::min(all.r0, one.r0);
        all.r1 = std::max(all.r1, one.r1);
      }
    }
    if (!(all.r1 > all.r0)) return;
    image_.cells.push_back({.z0 = z0,
                            .z1 = z1,
                            .inner = {.a = {all.r0, z0}, .b = {all.r0, z1}},
                            .outer = {.a = {all.r1, z0}, .b = {all.r1, z1}}});
  }

  /// The meridian that all values lie on, or a line that leaves none of them outside. `way`: +1 the
  /// outer side, -1 the inner.
  bool side(double z0, double z1, const Values& r, int way, bool is_short, Curve& curve) const {
    if (const Meridian* meridian = meridian_at(z0, z1, r)) {
      curve = meridian->curve;
      return true;
    }
    const double slope = (r.back() - r.front()) / (stations.back() - stations.front());
    double off = 0;
    double beyond = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const double e = r[i] - (r.front() + slope * (stations[i] - stations.front()));
      off = std::max(off, std::abs(e));
      beyond = std::max(beyond, way * e);
    }
    if (off > fit_ && !is_short) return false;
    const double at_z0 = r.front() - slope * stations.front() + way * beyond;
    const double at_z1 = r.front() + slope * (1 - stations.front()) + way * beyond;
    curve = {.a = {std::max(at_z0, 0.0), z0}, .b = {std::max(at_z1, 0.0), z1}};
    return true;
  }

  const Meridian* meridian_at(double z0, double z1, const Values& r) const {
    for (const Meridian& meridian : turned_.meridians) {
      if (meridian.z0 > z0 + 1e-6 || meridian.z1 < z1 - 1e-6) continue;
      bool lies = true;
      for (std::size_t i = 0; i < r.size() && lies; ++i) {
        const double z = std::lerp(z0, z1, stations[i]);
        lies = std::abs(units::radius_at(meridian.curve, z) - r[i]) <= 1e-9;
      }
      if (lies) return &meridian;
    }
    return nullptr;
  }

  const Cuts& cuts_;
  const TurnedFaces& turned_;
  double fit_;
  Image& image_;
};

}  // namespace

Image image_of(const Placed& part, const TurnedFaces& turned, const std::vector<int>& free) {
  const Model& model = part.model();
  std::vector<int> meshed;
  for (const int number : free)
    if (model.faces[static_cast<std::size_t>(number)].surface.kind != SurfaceKind::Plane)
      meshed.push_back(number);
  const double size = (model.high - model.low).norm();
  const double deflection = std::clamp(mesh_share * size, finest_mesh, coarsest_mesh);
  std::vector<Solid::Triangle> triangles;
  if (!meshed.empty()) triangles = part.mesh(meshed, deflection);

  std::vector<std::unique_ptr<Cut>> all;
  for (const int number : free) {
    const Face& face = model.faces[static_cast<std::size_t>(number)];
    if (face.loops.empty()) continue;
    if (face.surface.kind == SurfaceKind::Plane) {
      all.push_back(std::make_unique<PlaneCut>(part, face));
      continue;
    }
    std::vector<Solid::Triangle> own;
    for (const Solid::Triangle& triangle : triangles)
      if (triangle.face == number) own.push_back(triangle);
    if (!own.empty()) all.push_back(std::make_unique<MeshCut>(std::move(own), deflection, face));
  }
  const Cuts cuts(std::move(all), turned);
  Image image;
  Cells cells(cuts, turned, meshed.empty() ? exact_fit : std::max(exact_fit, deflection / 2),
              image);
  const std::vector<double> z = cuts.events();
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const std::vector<const Cut*> faces = cuts.in(z[i], z[i + 1]);
    if (!faces.empty()) cells.between(z[i], z[i + 1], faces);
  }
  return image;
}

}  // namespace ridgeline::part
