#include "part/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>

#include "core/units/overlay.hpp"

namespace ridgeline::part {
namespace {

using units::Curve;

constexpr double same = 1e-6;     // [mm]: curves and limits that are one
constexpr double visible = 1e-5;  // [mm]: gaps thinner than this are rounding

/// A curve through a slab: where a turned face is, or a side of a free one.
struct Line {
  const Curve* curve = nullptr;
  double rm = 0;       ///< at the middle of the slab
  bool below = false;  ///< a turned face with its material at smaller r
  bool above = false;  ///< a turned face with its material at greater r
  bool is_turned = false;
};

enum class Fill { Unknown, Air, Material };

/// Between two lines of a slab.
struct Gap {
  const Curve* inner = nullptr;
  const Curve* outer = nullptr;
  bool outer_is_bore = false;  ///< a turned face with its material outside bounds it
  Fill fill = Fill::Unknown;
};

struct Slab {
  double z0 = 0;
  double z1 = 0;
  std::vector<Gap> gaps;  ///< from the axis outwards
};

class Shadow {
public:
  Shadow(const Placed& part, const TurnedFaces& turned, const Image& image)
      : part_(part), turned_(turned), image_(image) {}

  units::Region run() {
    const std::vector<double> limits = all_limits();
    for (std::size_t i = 0; i + 1 < limits.size(); ++i) add_slabs(limits[i], limits[i + 1]);
    for (std::size_t i = 1; i < slabs_.size(); ++i) pass_on(slabs_[i - 1], slabs_[i], slabs_[i].z0);
    for (std::size_t i = slabs_.size(); i-- > 1;) pass_on(slabs_[i], slabs_[i - 1], slabs_[i].z0);
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
      try_circles(slabs_[i]);
      if (i + 1 < slabs_.size()) pass_on(slabs_[i], slabs_[i + 1], slabs_[i].z1);
    }
    close_free_voids();
    return region();
  }

private:
  std::vector<double> all_limits() const {
    std::vector<double> limits;
    for (const Meridian& one : turned_.meridians) limits.insert(limits.end(), {one.z0, one.z1});
    for (const Image::Cell& one : image_.cells) limits.insert(limits.end(), {one.z0, one.z1});
    for (const Shoulder& one : turned_.shoulders) limits.push_back(one.z);
    std::sort(limits.begin(), limits.end());
    std::vector<double> clustered;
    for (const double z : limits) {
      if (clustered.empty() || z - clustered.back() > same) clustered.push_back(z);
    }
    return clustered;
  }

  template <class Limits>
  static bool spans(const Limits& one, double z0, double z1) {
    return one.z0 < z0 + same && one.z1 > z1 - same;
  }

  /// Divides where curves cross, so that their order holds within a slab.
  void add_slabs(double z0, double z1) {
    std::vector<const Curve*> curves;
    for (const Meridian& one : turned_.meridians) {
      if (spans(one, z0, z1)) curves.push_back(&one.curve);
    }
    for (const Image::Cell& one : image_.cells) {
      if (spans(one, z0, z1)) curves.insert(curves.end(), {&one.inner, &one.outer});
    }
    std::vector<double> cuts{z0, z1};
    for (std::size_t i = 0; i < curves.size(); ++i) {
      for (std::size_t j = i + 1; j < curves.size(); ++j) {
        const units::Crossings found = units::crossings(*curves[i], *curves[j], z0, z1);
        for (int k = 0; k < found.count; ++k) cuts.push_back(found.z[k]);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    double from = z0;
    for (const double z : cuts) {
      if (z - from <= same || (z < z1 && z1 - z <= same)) continue;
      add_slab(from, z);
      from = z;
    }
  }

  void add_slab(double z0, double z1) {
    const double zm = std::midpoint(z0, z1);
    std::vector<Line> lines = lines_of(z0, z1, zm);
    std::vector<std::array<double, 2>> covered;
    for (const Image::Cell& one : image_.cells) {
      if (spans(one, z0, z1)) {
        covered.push_back({units::radius_at(one.inner, zm), units::radius_at(one.outer, zm)});
      }
    }
    Slab slab{z0, z1, {}};
    const Line axis{&axis_curve(), 0};
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Line& inner = i == 0 ? axis : lines[i - 1];
      const Line& outer = lines[i];
      if (outer.rm < same) continue;
      const double rm = std::midpoint(inner.rm, outer.rm);
      Gap gap{inner.curve, outer.curve, outer.is_turned && outer.above, Fill::Unknown};
      const bool is_shown = std::any_of(covered.begin(), covered.end(), [&](const auto& one) {
        return one[0] - same < rm && rm < one[1] + same;
      });
      const bool is_hair = i > 0 && outer.rm - inner.rm < visible;
      if (is_shown || is_hair || inner.above || outer.below) {
        gap.fill = Fill::Material;
      } else if (inner.below || outer.above) {
        gap.fill = Fill::Air;
      }
      slab.gaps.push_back(gap);
    }
    slabs_.push_back(std::move(slab));
  }

  std::vector<Line> lines_of(double z0, double z1, double zm) const {
    std::vector<Line> all;
    for (const Meridian& one : turned_.meridians) {
      if (!spans(one, z0, z1)) continue;
      all.push_back(
          {&one.curve, units::radius_at(one.curve, zm), one.side > 0, one.side < 0, true});
    }
    for (const Image::Cell& one : image_.cells) {
      if (!spans(one, z0, z1)) continue;
      all.push_back({&one.inner, units::radius_at(one.inner, zm)});
      all.push_back({&one.outer, units::radius_at(one.outer, zm)});
    }
    std::sort(all.begin(), all.end(), [](const Line& p, const Line& q) {
      return p.rm != q.rm ? p.rm < q.rm : p.is_turned > q.is_turned;
    });
    std::vector<Line> lines;
    for (const Line& line : all) {
      if (line.rm < same && !line.is_turned) continue;
      if (!lines.empty() && line.rm - lines.back().rm < same) {
        Line& last = lines.back();
        if (line.is_turned && !last.is_turned) last.curve = line.curve;
        last.below |= line.below;
        last.above |= line.above;
        last.is_turned |= line.is_turned;
      } else {
        lines.push_back(line);
      }
    }
    return lines;
  }

  /// What fills a gap goes on through a limit unless a shoulder stands there.
  void pass_on(const Slab& from, Slab& to, double z) const {
    for (Gap& gap : to.gaps) {
      if (gap.fill != Fill::Unknown) continue;
      for (const Gap& known : from.gaps) {
        if (known.fill == Fill::Unknown) continue;
        const double r0 =
            std::max(units::radius_at(*known.inner, z), units::radius_at(*gap.inner, z));
        const double r1 =
            std::min(units::radius_at(*known.outer, z), units::radius_at(*gap.outer, z));
        if (r1 - r0 < visible || has_shoulder(z, std::midpoint(r0, r1))) continue;
        gap.fill = known.fill;
      }
    }
  }

  bool has_shoulder(double z, double r) const {
    return std::any_of(
        turned_.shoulders.begin(), turned_.shoulders.end(), [&](const Shoulder& one) {
          return std::abs(one.z - z) <= same && one.r0 - same < r && r < one.r1 + same;
        });
  }

  /// No face enters the gap, so one circle tells; several, as a hole may pass through the circle.
  void try_circles(Slab& slab) const {
    const double z = std::midpoint(slab.z0, slab.z1);
    for (Gap& gap : slab.gaps) {
      if (gap.fill != Fill::Unknown) continue;
      const double r =
          std::midpoint(units::radius_at(*gap.inner, z), units::radius_at(*gap.outer, z));
      gap.fill = Fill::Air;
      for (const double angle : {0.31, 1.43, 2.71, 3.97, 5.23}) {
        if (!part_.contains({r * std::cos(angle), r * std::sin(angle), z})) continue;
        gap.fill = Fill::Material;
        break;
      }
    }
  }

  /// The gaps that a void on the axis takes in a slab, none when it is solid there.
  static std::size_t void_size(const Slab& slab) {
    std::size_t n = 0;
    while (n < slab.gaps.size() && slab.gaps[n].fill == Fill::Air) ++n;
    return n;
  }

  static bool is_bore(const Slab& slab, std::size_t n) {
    return n > 0 && slab.gaps[n - 1].outer_is_bore;
  }

  /// 1.8-g. A void that only free faces bound is filled; but as wide as the bore that it opens,
  /// when that bore has no other end open.
  void close_free_voids() {
    for (std::size_t first = 0; first < slabs_.size();) {
      std::size_t end = first;
      while (end < slabs_.size() && void_size(slabs_[end]) > 0 &&
             (end == first || slabs_[end].z0 - slabs_[end - 1].z1 < same)) {
        ++end;
      }
      if (end == first) {
        ++first;
        continue;
      }
      close_run(first, end);
      first = end;
    }
  }

  /// Slabs first..end - 1 hold one void about the axis.
  void close_run(std::size_t first, std::size_t end) {
    const bool open_low = first == 0;
    const bool open_high = end == slabs_.size();
    for (std::size_t i = first; i < end; ++i) {
      if (is_bore(slabs_[i], void_size(slabs_[i]))) continue;
      double keep = 0;  // of the bores beyond, seen from the open end, that have no other way out
      if (open_low && !reaches(i, end, open_high)) keep = widest_bore(i, end);
      if (open_high && !reaches_low(i, first, open_low)) {
        keep = std::max(keep, widest_bore(first, i));
      }
      fill(slabs_[i], keep);
    }
  }

  /// From slab i upwards only bores to an open end?
  bool reaches(std::size_t i, std::size_t end, bool is_open) const {
    for (std::size_t k = i + 1; k < end; ++k) {
      if (!is_bore(slabs_[k], void_size(slabs_[k]))) return true;  // another filled part decides
    }
    return is_open;
  }
  bool reaches_low(std::size_t i, std::size_t first, bool is_open) const {
    for (std::size_t k = first; k < i; ++k) {
      if (!is_bore(slabs_[k], void_size(slabs_[k]))) return true;
    }
    return is_open;
  }

  double widest_bore(std::size_t first, std::size_t end) const {
    double widest = 0;
    for (std::size_t k = first; k < end; ++k) {
      const std::size_t n = void_size(slabs_[k]);
      if (!is_bore(slabs_[k], n)) continue;
      widest = std::max(widest,
                        units::range(*slabs_[k].gaps[n - 1].outer, slabs_[k].z0, slabs_[k].z1).max);
    }
    return widest;
  }

  void fill(Slab& slab, double keep) {
    const std::size_t n = void_size(slab);
    const double room = units::range(*slab.gaps[n - 1].outer, slab.z0, slab.z1).min;
    keep = std::min(keep, room);
    if (keep < visible) {
      for (std::size_t k = 0; k < n; ++k) slab.gaps[k].fill = Fill::Material;
      return;
    }
    own_.push_back({.a = {keep, slab.z0}, .b = {keep, slab.z1}});
    Gap open{&axis_curve(), &own_.back(), true, Fill::Air};
    Gap closed{&own_.back(), slab.gaps[n - 1].outer, false, Fill::Material};
    slab.gaps.erase(slab.gaps.begin(), slab.gaps.begin() + static_cast<std::ptrdiff_t>(n));
    slab.gaps.insert(slab.gaps.begin(), {open, closed});
  }

  units::Region region() const {
    units::Overlay cells;
    for (const Slab& slab : slabs_) {
      for (const Gap& gap : slab.gaps) {
        if (gap.fill == Fill::Material) {
          cells.cells.push_back({slab.z0, slab.z1, gap.inner, gap.outer, 1});
        }
      }
    }
    // Merges cells side by side and on top of each other, and cuts limits to one another again.
    return units::select(cells, [](std::uint64_t) { return true; });
  }

  static const Curve& axis_curve() {
    static const Curve axis{.a = {0, 0}, .b = {0, 1}};
    return axis;
  }

  const Placed& part_;
  const TurnedFaces& turned_;
  const Image& image_;
  std::vector<Slab> slabs_;
  std::deque<Curve> own_;
};

}  // namespace

units::Region shadow_of(const Placed& part, const TurnedFaces& turned, const Image& image) {
  return Shadow(part, turned, image).run();
}

}  // namespace ridgeline::part
