#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"

namespace ridgeline::geometry {

/// A circular, helical or (where the rounded radii differ) spiral arc of at most 15 degrees:
/// centre + r(t) (cos w(t) x + sin w(t) y) + h(t) z, with r, w and h linear in t in [0, 1].
struct Spiral {
  Eigen::Vector3d centre, x, y, z;
  double r0, r1;  ///< radius [mm]
  double w0, w1;  ///< angle [rad]
  double h0, h1;  ///< height [mm]
};

/// A straight or curved piece of a path. Work frame, mm.
struct Piece {
  Eigen::Vector3d a, b;                  ///< ends
  std::size_t owner = 0;                 ///< index of the move or seam that it belongs to
  double bend = 0;                       ///< bound of |second derivative by t|; 0: straight
  std::shared_ptr<const Spiral> spiral;  ///< absent: straight
};

/// The point at t in [0, 1].
Eigen::Vector3d at(const Piece& piece, double t);

/// Nearest point of a piece.
struct Foot {
  Eigen::Vector3d point;
  double distance = std::numeric_limits<double>::infinity();
  std::size_t piece = 0;
  double t = 0;
};
Foot nearest(const Piece& piece, const Eigen::Vector3d& p);

/// A stretch of consecutive pieces: everything lies within `deviation` of the chord from a to b,
/// and in the box.
struct Stretch {
  Eigen::Vector3d a, b;
  double deviation = 0;
  Eigen::Vector3d low, high;
  std::size_t first = 0, last = 0;  ///< pieces [first, last)
};

/// Pieces in order with a binary tree over them. Node 0 is the root; a node of n > 1 pieces has its
/// children at left() and right(); a leaf has one piece.
class Trace {
public:
  explicit Trace(std::vector<Piece> pieces, const Progress& progress = {});

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Stretch>& nodes() const { return nodes_; }
  bool empty() const { return pieces_.empty(); }

  static std::size_t left(std::size_t node) { return node + 1; }
  std::size_t right(std::size_t node) const;

  /// Nearest point of all pieces nearer than `within`; when there is none, a foot with the distance
  /// `within`. `hint`: a piece that is likely to be near.
  Foot nearest(const Eigen::Vector3d& p, std::size_t hint = 0,
               double within = std::numeric_limits<double>::infinity()) const;

private:
  void build(std::size_t node, std::size_t first, std::size_t last, const Progress& progress);

  std::vector<Piece> pieces_;
  std::vector<Stretch> nodes_;
};

/// Adds a spiral of any sweep, cut into pieces; `ends` has its exact ends and its owner.
void add_spiral(std::vector<Piece>& pieces, const Spiral& whole, const Piece& ends);

}  // namespace ridgeline::geometry
