#pragma once

#include <memory>
#include <span>
#include <vector>

#include "part/meridian.hpp"

namespace ridgeline::part {

/// A stretch of radius.
struct Interval {
  double r0 = 0;
  double r1 = 0;
};

/// Sorts them and makes those that touch one.
void merge(std::vector<Interval>& intervals, double gap);

/// A face whose cut at any z between z0 and z1 can be asked for.
class Cut {
public:
  virtual ~Cut() = default;
  /// What it covers there, sorted and apart, in place of what `found` holds.
  virtual void at(double z, std::vector<Interval>& found) const = 0;
  double z0 = 0;
  double z1 = 0;
  std::vector<double> events;  ///< z where the cut changes its kind
  double snap = 1e-4;          ///< ends so near to a meridian lie on it
  double margin = 0;           ///< the face may reach so far beyond its cut
};

/// Plane: straight across, between the edges that cross. An edge to a turned face lies on its
/// meridian, however far the file's curve is off: on a flat dome that is much in r.
std::unique_ptr<Cut> plane_cut(const Placed& part, const TurnedFaces& turned, int face);

/// Any other face: its triangles, at least one, which must outlive it. Between nodes on a turned
/// face r is interpolated, not the chord.
std::unique_ptr<Cut> mesh_cut(std::span<const Solid::Triangle> triangles, double deflection,
                              const Face& face);

}  // namespace ridgeline::part
