#include "part/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "part/cuts.hpp"

namespace ridgeline::part {
namespace {

using units::Curve;

constexpr double shortest = 0.02;      // [mm]: slabs are not divided further
constexpr double exact_fit = 1e-3;     // [mm]: of lines to the image of a plane face
constexpr double mesh_share = 2e-4;    // deflection per extent of the part
constexpr double finest_mesh = 0.002;  // [mm]
constexpr double coarsest_mesh = 0.1;  // [mm]
constexpr std::array<double, 5> stations = {0.001, 0.25, 0.5, 0.75, 0.999};

/// The free faces that a slab meets, and the meridians beside them.
struct Slab {
  double z0 = 0;
  double z1 = 0;
  std::vector<const Cut*> cuts;
  std::vector<const Meridian*> meridians;
};

/// All free faces together, cut at one z; ends on meridians lie there exactly.
class Cuts {
public:
  Cuts(std::vector<std::unique_ptr<Cut>> cuts, const TurnedFaces& turned)
      : cuts_(std::move(cuts)), turned_(turned) {}

  std::vector<double> events() const {
    std::vector<double> z;
    for (const auto& cut : cuts_) z.insert(z.end(), cut->events.begin(), cut->events.end());
    for (const Meridian& meridian : turned_.meridians) {
      z.insert(z.end(), {meridian.z0, meridian.z1});
    }
    std::sort(z.begin(), z.end());
    std::vector<double> apart;
    for (const double one : z) {
      if (apart.empty() || one - apart.back() > 1e-6) apart.push_back(one);
    }
    return apart;
  }

  Slab slab(double z0, double z1) const {
    Slab found{z0, z1, {}, {}};
    for (const auto& cut : cuts_) {
      if (cut->z0 < z1 - 1e-9 && cut->z1 > z0 + 1e-9) found.cuts.push_back(cut.get());
    }
    for (const Meridian& meridian : turned_.meridians) {
      if (meridian.z0 <= z1 && meridian.z1 >= z0) found.meridians.push_back(&meridian);
    }
    return found;
  }

private:
  std::vector<std::unique_ptr<Cut>> cuts_;
  const TurnedFaces& turned_;
};

/// On the nearest meridian within the cut's reach, else beyond the cut by its margin.
double placed(double r, double z, const Cut& cut, int way, const Slab& slab) {
  double nearest = cut.snap;
  double found = std::max(0.0, r + way * cut.margin);
  for (const Meridian* meridian : slab.meridians) {
    if (meridian->z0 > z || meridian->z1 < z) continue;
    const double there = units::radius_at(meridian->curve, z);
    if (std::abs(there - r) > nearest) continue;
    nearest = std::abs(there - r);
    found = there;
  }
  return found;
}

/// Fits cells to the cuts of all free faces, slab by slab.
class Cells {
public:
  Cells(const Slab& slab, double fit, Image& image) : slab_(slab), fit_(fit), image_(image) {}

  void run() { between(slab_.z0, slab_.z1); }

private:
  using Values = std::array<double, stations.size()>;

  void at(double z, std::vector<Interval>& all) {
    all.clear();
    for (const Cut* cut : slab_.cuts) {
      if (z <= cut->z0 || z >= cut->z1) continue;
      cut->at(z, one_);
      for (Interval one : one_) {
        one.r0 = placed(one.r0, z, *cut, -1, slab_);
        one.r1 = placed(one.r1, z, *cut, 1, slab_);
        all.push_back(one);
      }
    }
    merge(all, 1e-6);
  }

  void between(double z0, double z1) {
    std::array<std::vector<Interval>, stations.size()> cuts;
    bool is_even = true;
    bool is_empty = false;
    const bool is_short = z1 - z0 < shortest;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      at(std::lerp(z0, z1, stations[i]), cuts[i]);
      is_even &= cuts[i].size() == cuts[0].size();
      is_empty |= cuts[i].empty();
      if (!is_even && !is_short) return divide(z0, z1);
    }
    if (!is_even && is_empty) return hull(z0, z1, cuts);
    if (!is_even) {
      for (auto& cut : cuts) cut = {{cut.front().r0, cut.back().r1}};
    }
    std::vector<Image::Cell> made;
    for (std::size_t k = 0; k < cuts[0].size(); ++k) {
      Values r0{}, r1{};
      for (std::size_t i = 0; i < stations.size(); ++i) {
        r0[i] = cuts[i][k].r0;
        r1[i] = cuts[i][k].r1;
      }
      Image::Cell cell{.z0 = z0, .z1 = z1, .inner = {}, .outer = {}};
      if (!side(z0, z1, r0, -1, is_short, cell.inner) ||
          !side(z0, z1, r1, 1, is_short, cell.outer)) {
        return divide(z0, z1);
      }
      made.push_back(cell);
    }
    image_.cells.insert(image_.cells.end(), made.begin(), made.end());
  }

  void divide(double z0, double z1) {
    const double middle = std::midpoint(z0, z1);
    between(z0, middle);
    between(middle, z1);
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
    for (const Meridian* meridian : slab_.meridians) {
      if (meridian->z0 > z0 + 1e-6 || meridian->z1 < z1 - 1e-6) continue;
      bool lies = true;
      for (std::size_t i = 0; i < r.size() && lies; ++i) {
        const double z = std::lerp(z0, z1, stations[i]);
        lies = std::abs(units::radius_at(meridian->curve, z) - r[i]) <= 1e-9;
      }
      if (lies) return meridian;
    }
    return nullptr;
  }

  const Slab& slab_;
  double fit_;
  Image& image_;
  std::vector<Interval> one_;
};

}  // namespace

Image image_of(const Placed& part, const TurnedFaces& turned, const std::vector<int>& free) {
  const Model& model = part.model();
  std::vector<int> meshed;
  for (const int number : free) {
    if (model.faces[static_cast<std::size_t>(number)].surface.kind != SurfaceKind::Plane) {
      meshed.push_back(number);
    }
  }
  const double size = (model.high - model.low).norm();
  const double deflection = std::clamp(mesh_share * size, finest_mesh, coarsest_mesh);
  std::vector<Solid::Triangle> triangles;
  if (!meshed.empty()) triangles = part.mesh(meshed, deflection);

  std::vector<std::unique_ptr<Cut>> all;
  for (const int number : free) {
    const Face& face = model.faces[static_cast<std::size_t>(number)];
    if (face.loops.empty()) continue;
    if (face.surface.kind == SurfaceKind::Plane) {
      all.push_back(plane_cut(part, turned, number));
      continue;
    }
    const auto is_own = [number](const Solid::Triangle& triangle) {
      return triangle.face == number;
    };
    const auto first = std::find_if(triangles.begin(), triangles.end(), is_own);
    const auto last = std::find_if_not(first, triangles.end(), is_own);
    if (first == last) continue;  // no area
    all.push_back(mesh_cut(std::span(first, last), deflection, face));
  }
  const Cuts cuts(std::move(all), turned);
  Image image;
  const double fit = meshed.empty() ? exact_fit : std::max(exact_fit, deflection / 2);
  const std::vector<double> z = cuts.events();
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const Slab slab = cuts.slab(z[i], z[i + 1]);
    if (!slab.cuts.empty()) Cells(slab, fit, image).run();
  }
  return image;
}

}  // namespace ridgeline::part
