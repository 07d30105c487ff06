#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/ridge.hpp"
#include "core/geometry/trace.hpp"

namespace ridgeline::verify {

/// What a path has cut in the section VP(u): from the ridge outward on each surface, up to where
/// the distance to the path first grows to D. Hole frame.
struct BandSection {
  double u = 0;
  Eigen::Vector3d P;   ///< ridge
  Eigen::Vector3d t;   ///< its tangent
  Eigen::Vector3d G1;  ///< border on the body surface
  Eigen::Vector3d G2;  ///< border on the wall
  bool cut = false;    ///< false: the path leaves the ridge whole here; G1 = G2 = P
  bool open = false;   ///< true: no border within the search range, or the surface ends; G is there
};

/// Cuts an edge with the balls of radius D along a path.
class Band {
public:
  /// `width`: asked [mm]; the search goes twice as far as a chamfer of that width can reach.
  /// `path`: ball centres, work frame; must outlive this.
  Band(const geometry::Edge& edge, const geometry::Trace& path, double D, double width);

  BandSection at(double u) const;

private:
  struct Border {
    Eigen::Vector3d G;
    bool open = false;
  };
  template <typename Curve>
  Border border(const Curve& curve, double range) const;
  geometry::Foot foot(const Eigen::Vector3d& p) const;

  const geometry::Edge& edge_;
  const geometry::Trace& path_;
  double D_;
  double width_;
  mutable std::size_t hint_ = 0;
};

inline double width(const BandSection& section) {
  return (section.G1 - section.G2).norm();
}

/// The band all round, at equal steps of u.
std::vector<BandSection> sections(const Band& band, int count, const Progress& progress = {});

/// Least and largest width over the whole edge, between the sections too (to 1e-9 mm where the
/// width is continuous).
struct WidthRange {
  double min = 0, max = 0;
  double min_at = 0, max_at = 0;  ///< u
};
WidthRange width_range(const Band& band, const std::vector<BandSection>& sections,
                       const Progress& progress = {});

}  // namespace ridgeline::verify
