#pragma once

#include <cstdint>
#include <vector>

#include "core/cutting/boundary.hpp"
#include "core/cutting/chips.hpp"

/// Search of a chip table: which elements at which samples may cut.
namespace ridgeline::cutting {

/// How far the deflections may go along a direction [mm].
struct Extent {
  double least = 0, greatest = 0;
};

/// What the whole table shares.
struct Scene {
  const Cut& cut;
  const Around& around;
  double largest = 0;  ///< deflection that may be [mm]
  double step = 0;     ///< of the centre, from sample to sample, at most [mm]
  Deflections centre;  ///< a tooth period before the revolution to one after;
                       ///< empty: none
  Eigen::Vector3d fd;
  double cos_phi = 1;
  double tan_helix = 0;
  double per_radian = 0;  ///< samples
  const Turn& turn;
  std::vector<Boundary> boundaries;
  std::vector<Extent> along_normal;  ///< of a plane among the boundaries
  Extent along_x, along_y;

  /// The centre at a sample of the revolution; only if there is one.
  const Eigen::Vector2d& at(std::int32_t sample) const {
    return centre[static_cast<std::size_t>(sample) + around.centre.size()];
  }
};

/// One edge element of one tooth.
struct Edge {
  const Element* element = nullptr;
  double r = 0;
  double ahead = 0;             ///< angle of the tooth
  double sin_k = 0, cos_k = 0;  ///< of theta_n - theta
  double base = 0;
  double circle = 0;  ///< r sin q [mm]
  double height = 0;  ///< of the element from O' [mm]
};

/// An element at a sample that may cut.
struct Found {
  std::int32_t sample = 0;
  std::int32_t element = 0;
};

/// Direction of an element at a sample.
struct Aim {
  double s = 0;  ///< sin theta_n
  double c = 0;  ///< cos theta_n
};

/// The tooth m before this one: how far ahead it is, what it left behind.
struct Before {
  double ahead = 0;  ///< angle from this tooth
  double f = 0;      ///< feed since it was here [mm]
  double r = 0;
  double per_r = 0;  ///< 1 / r
};

Turn turn(const Cut& cut);
Scene scene(const Cut& cut, const Around& around, const Turn& turn);
Edge edge_of(const Cut& cut, const Element& element, int tooth);
Before before(const Cut& cut, int tooth, int m);

inline Aim aim(const Scene& scene, const Edge& edge, std::int32_t sample) {
  const double s = scene.turn.sin_theta[static_cast<std::size_t>(sample)];
  const double c = scene.turn.cos_theta[static_cast<std::size_t>(sample)];
  return {.s = s * edge.cos_k + c * edge.sin_k, .c = c * edge.cos_k - s * edge.sin_k};
}

/// Unit, O' -> edge.
inline Eigen::Vector3d outward(const Edge& edge, const Aim& aim) {
  const double sin_q = edge.element->sin_q;
  return {-sin_q * aim.c, sin_q * aim.s, -edge.element->cos_q};
}

inline Eigen::Vector3d point(const Edge& edge, const Aim& aim) {
  return {-edge.circle * aim.c, edge.circle * aim.s, edge.height};
}

/// What may cut of the edges of one tooth, by sample, elements upwards within
/// one.
struct Candidates {
  std::vector<std::int32_t> first;  ///< where each sample begins, and the end of all
  std::vector<Found> found;
};
Candidates candidates(const Scene& scene, const std::vector<Edge>& edges, const Before& before);

}  // namespace ridgeline::cutting
