#include "core/units/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

/// A boundary piece with its r at the limits and the middle of the slab at hand.
struct Active {
  const BoundaryPiece* piece;
  double r0, rm, r1;
  Range range;
};

/// Where a boundary piece begins or ends.
struct Limit {
  double z = 0;
  bool is_pole = false;
};

/// A circle is infinitely steep at its pole: a limit off by 1e-7 mm would move its end by 1e-3. So
/// an end near a pole is the pole, and limits that are one take their z from a pole.
Limit limit_of(const Curve& curve, double z) {
  if (is_arc(curve)) {
    for (const double pole : {curve.a.z - curve.radius, curve.a.z + curve.radius}) {
      if (std::abs(z - pole) <= merge_tolerance) return {pole, true};
    }
  }
  return {z, false};
}

/// Limits nearer than the tolerance become one; a cluster is known by its least z.
struct Cluster {
  double z = 0;
  Limit chosen;
};

std::vector<Cluster> clustered(std::vector<Limit> limits) {
  std::sort(limits.begin(), limits.end(), [](const Limit& p, const Limit& q) { return p.z < q.z; });
  std::vector<Cluster> clusters;
  clusters.reserve(limits.size());
  for (const Limit& limit : limits) {
    if (clusters.empty() || limit.z - clusters.back().z > merge_tolerance) {
      clusters.push_back({limit.z, limit});
    } else if (limit.is_pole && !clusters.back().chosen.is_pole) {
      clusters.back().chosen = limit;
    }
  }
  return clusters;
}

double snapped(const std::vector<Cluster>& clusters, double z) {
  const auto after =
      std::upper_bound(clusters.begin(), clusters.end(), z,
                       [](double value, const Cluster& cluster) { return value < cluster.z; });
  return std::prev(after)->chosen.z;
}

/// A crossing inside a slab. Its z may be moved by `slack` without parting the curves by more than
/// the tolerance there.
struct Cut {
  double z = 0;
  double slack = 0;
};

/// Sweeps slab by slab along z.
class Sweep {
public:
  explicit Sweep(std::vector<BoundaryPiece> boundary) : boundary_(std::move(boundary)) {}

  Overlay run() {
    std::vector<Limit> limits;
    limits.reserve(2 * boundary_.size());
    for (const BoundaryPiece& piece : boundary_) {
      limits.push_back(limit_of(*piece.curve, piece.z0));
      limits.push_back(limit_of(*piece.curve, piece.z1));
    }
    const std::vector<Cluster> clusters = clustered(std::move(limits));
    for (BoundaryPiece& piece : boundary_) {
      piece.z0 = snapped(clusters, limit_of(*piece.curve, piece.z0).z);
      piece.z1 = snapped(clusters, limit_of(*piece.curve, piece.z1).z);
    }
    std::sort(boundary_.begin(), boundary_.end(),
              [](const BoundaryPiece& p, const BoundaryPiece& q) { return p.z0 < q.z0; });
    std::vector<const BoundaryPiece*> open;
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < clusters.size(); ++i) {
      const double z = clusters[i].chosen.z;
      std::erase_if(open, [&](const BoundaryPiece* piece) { return piece->z1 <= z; });
      for (; next < boundary_.size() && boundary_[next].z0 <= z; ++next) {
        if (boundary_[next].z1 > z) open.push_back(&boundary_[next]);
      }
      if (!open.empty()) slab(open, z, clusters[i + 1].chosen.z);
    }
    return std::move(result_);
  }

private:
  void slab(const std::vector<const BoundaryPiece*>& open, double z0, double z1) {
    active_.clear();
    for (const BoundaryPiece* piece : open) {
      const Curve& curve = *piece->curve;
      active_.push_back(
          {piece, radius_at(curve, z0), 0, radius_at(curve, z1), units::range(curve, z0, z1)});
    }
    cuts_.clear();
    for (std::size_t i = 0; i < active_.size(); ++i) {
      for (std::size_t j = i + 1; j < active_.size(); ++j) cross(active_[i], active_[j], z0, z1);
    }
    std::sort(cuts_.begin(), cuts_.end(), [](const Cut& p, const Cut& q) { return p.z < q.z; });
    double from = z0;
    for (const Cut& cut : cuts_) {
      if (cut.z - from <= cut.slack || z1 - cut.z <= cut.slack) continue;
      strip(from, cut.z);
      from = cut.z;
    }
    strip(from, z1);
  }

  void cross(const Active& p, const Active& q, double z0, double z1) {
    if (p.piece->curve == q.piece->curve) return;
    if (p.range.max < q.range.min || q.range.max < p.range.min) return;
    const Crossings found = crossings(*p.piece->curve, *q.piece->curve, z0, z1);
    for (int i = 0; i < found.count; ++i) {
      const double z = found.z[i];
      const double parting = std::abs(slope_at(*p.piece->curve, z) - slope_at(*q.piece->curve, z));
      cuts_.push_back({z, merge_tolerance / std::clamp(parting, 1.0, 1e6)});
    }
  }

  /// No curve crosses another between z0 and z1: sort them and walk outwards.
  void strip(double z0, double z1) {
    const double zm = (z0 + z1) / 2;
    for (Active& item : active_) {
      item.r0 = radius_at(*item.piece->curve, z0);
      item.rm = radius_at(*item.piece->curve, zm);
      item.r1 = radius_at(*item.piece->curve, z1);
    }
    std::sort(active_.begin(), active_.end(), [](const Active& p, const Active& q) {
      return p.rm != q.rm ? p.rm < q.rm : p.piece->operand < q.piece->operand;
    });
    std::array<int, overlay_limit> winding{};
    std::uint64_t covered = 0;
    const Curve* below = nullptr;
    for (std::size_t i = 0; i < active_.size();) {
      const Active& leader = active_[i];
      const Curve* chosen = leader.piece->curve;
      int operand = leader.piece->operand;
      std::size_t j = i;
      const std::uint64_t before = covered;
      for (; j < active_.size() && (j == i || is_one(leader, active_[j])); ++j) {
        const BoundaryPiece& piece = *active_[j].piece;
        if (piece.operand < operand) {
          operand = piece.operand;
          chosen = piece.curve;
        }
        int& count = winding[static_cast<std::size_t>(piece.operand)];
        count += piece.winding;
        const std::uint64_t bit = std::uint64_t{1} << piece.operand;
        covered = count != 0 ? covered | bit : covered & ~bit;
      }
      if (before != 0) result_.cells.push_back({z0, z1, below, chosen, before});
      below = chosen;
      i = j;
    }
  }

  static bool is_one(const Active& p, const Active& q) {
    return std::abs(p.rm - q.rm) <= merge_tolerance && std::abs(p.r0 - q.r0) <= merge_tolerance &&
           std::abs(p.r1 - q.r1) <= merge_tolerance;
  }

  std::vector<BoundaryPiece> boundary_;
  std::vector<Active> active_;
  std::vector<Cut> cuts_;
  Overlay result_;
};

/// Do the cells of two slabs that follow each other continue the same curves?
bool is_continued(std::span<const Cell> below, std::span<const Cell> above) {
  if (below.size() != above.size() || below.front().z1 != above.front().z0) return false;
  const double z0 = below.front().z0;
  const double z1 = above.front().z1;
  for (std::size_t i = 0; i < below.size(); ++i) {
    if (!is_same(below[i].inner, above[i].inner, z0, z1) ||
        !is_same(below[i].outer, above[i].outer, z0, z1)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Overlay overlay(std::vector<BoundaryPiece> boundary) {
  return Sweep(std::move(boundary)).run();
}

Overlay overlay(std::span<const Region* const> operands) {
  if (operands.size() > overlay_limit) {
    throw Error(ErrorCode::Internal, "overlay of " + std::to_string(operands.size()) +
                                         " regions; at most " + std::to_string(overlay_limit));
  }
  std::size_t count = 0;
  for (const Region* region : operands) count += region->cells.size();
  std::vector<BoundaryPiece> boundary;
  boundary.reserve(2 * count);
  for (std::size_t i = 0; i < operands.size(); ++i) {
    for (const Cell& cell : operands[i]->cells) {
      boundary.push_back({&cell.inner, cell.z0, cell.z1, static_cast<int>(i), 1});
      boundary.push_back({&cell.outer, cell.z0, cell.z1, static_cast<int>(i), -1});
    }
  }
  return overlay(std::move(boundary));
}

Region intersection_of(const Region& a, const Region& b) {
  const Region* operands[] = {&a, &b};
  return select(overlay(operands), [](std::uint64_t covered) { return covered == 3; });
}

Region difference_of(const Region& a, const Region& b) {
  const Region* operands[] = {&a, &b};
  return select(overlay(operands), [](std::uint64_t covered) { return covered == 1; });
}

Region union_of(std::span<const Region> regions) {
  Region sum;
  for (std::size_t first = 0; first < regions.size(); first += overlay_limit - 1) {
    std::vector<const Region*> operands{&sum};
    const std::size_t end = std::min(regions.size(), first + overlay_limit - 1);
    for (std::size_t i = first; i < end; ++i) operands.push_back(&regions[i]);
    sum = select(overlay(operands), [](std::uint64_t) { return true; });
  }
  return sum;
}

double symmetric_difference(const Region& a, const Region& b) {
  const Region* operands[] = {&a, &b};
  const Overlay cut = overlay(operands);
  double sum = 0;
  for (const OverlayCell& cell : cut.cells) {
    if (cell.covered == 3) continue;
    sum += squared_integral(*cell.outer, cell.z0, cell.z1) -
           squared_integral(*cell.inner, cell.z0, cell.z1);
  }
  return sum * std::numbers::pi;
}

namespace detail {

void RegionBuilder::add(const OverlayCell& cell) {
  if (!slab_.empty() && slab_.front().z0 != cell.z0) close_slab();
  if (!slab_.empty() && open_ == cell.inner) {
    slab_.back().outer = *cell.outer;
  } else {
    slab_.push_back({cell.z0, cell.z1, *cell.inner, *cell.outer});
  }
  open_ = cell.outer;
}

void RegionBuilder::close_slab() {
  if (slab_.empty()) return;
  const std::span<Cell> last(region_.cells.begin() + static_cast<std::ptrdiff_t>(last_),
                             region_.cells.end());
  if (!last.empty() && is_continued(last, slab_)) {
    for (Cell& cell : last) cell.z1 = slab_.front().z1;
  } else {
    last_ = region_.cells.size();
    region_.cells.insert(region_.cells.end(), slab_.begin(), slab_.end());
  }
  slab_.clear();
  open_ = nullptr;
}

Region RegionBuilder::finish() {
  close_slab();
  return std::move(region_);
}

}  // namespace detail

}  // namespace ridgeline::units
