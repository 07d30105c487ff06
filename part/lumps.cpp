#include "part/lumps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace ridgeline::part {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double on_envelope = 1e-4;    // [mm]
constexpr double near_envelope = 1e-3;  // [mm]: of mouths from other systems
constexpr double beside = 2e-5;         // [mm]: from a limit of S to either side

double radius_of(const Eigen::Vector3d& p) {
  return std::hypot(p.x(), p.y());
}

bool covers(const units::Region& S, double r, double z) {
  return units::covers(S, {r, z});
}

/// Is the meridian a side of S with its material where the face has it?
bool is_side(const units::Region& S, const Meridian& meridian) {
  const double z = std::midpoint(meridian.z0, meridian.z1);
  const double r = units::radius_at(meridian.curve, z);
  return std::any_of(S.cells.begin(), S.cells.end(), [&](const units::Cell& cell) {
    if (z < cell.z0 || z > cell.z1) return false;
    const units::Curve& side = meridian.side > 0 ? cell.outer : cell.inner;
    return std::abs(units::radius_at(side, z) - r) < on_envelope;
  });
}

bool is_end(const units::Region& S, const Shoulder& shoulder) {
  for (int i = 1; i < 16; ++i) {
    const double r = std::lerp(shoulder.r0, shoulder.r1, i / 16.0);
    if (covers(S, r, shoulder.z - beside) != covers(S, r, shoulder.z + beside)) return true;
  }
  return false;
}

std::vector<char> milled_faces(const Placed& part, const TurnedFaces& turned,
                               const units::Region& S) {
  std::vector<char> is_milled(part.model().faces.size(), 1);
  for (const Meridian& one : turned.meridians) {
    if (is_side(S, one)) is_milled[static_cast<std::size_t>(one.face)] = 0;
  }
  for (const Shoulder& one : turned.shoulders) {
    if (is_end(S, one)) is_milled[static_cast<std::size_t>(one.face)] = 0;
  }
  return is_milled;
}

bool runs_inside(const Edge& edge, const Envelope& envelope) {
  for (const double t : {0.25, 0.5, 0.75}) {
    const std::size_t n = edge.points.size() - 1;
    const double at = t * static_cast<double>(n);
    const auto i = std::min(static_cast<std::size_t>(at), n - 1);
    const Eigen::Vector3d p =
        edge.points[i] + (at - static_cast<double>(i)) * (edge.points[i + 1] - edge.points[i]);
    if (envelope.is_inside(p, on_envelope)) return true;
  }
  return false;
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    auto& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

/// Boundary edges of a lump with the sense in which its faces use them.
std::map<int, int> open_edges(const Model& model, const Lump& lump) {
  std::map<int, int> sense;
  for (const int face : lump.faces) {
    for (const std::vector<EdgeUse>& loop : model.faces[static_cast<std::size_t>(face)].loops) {
      for (const EdgeUse& use : loop) sense[use.edge] += use.is_reversed ? -1 : 1;
    }
  }
  std::erase_if(sense, [](const auto& entry) { return entry.second == 0; });
  return sense;
}

/// A polar angle that the mouth leaves out: the middle of its widest gap.
double cut_angle(const Model& model, const std::map<int, int>& edges) {
  std::vector<double> angles;
  for (const auto& [number, sense] : edges) {
    const Edge& edge = model.edges[static_cast<std::size_t>(number)];
    for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Eigen::Vector3d p = edge.points[i] + t * (edge.points[i + 1] - edge.points[i]);
        if (radius_of(p) > on_envelope) angles.push_back(std::atan2(p.y(), p.x()));
      }
    }
  }
  if (angles.empty()) return pi;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * pi - angles.back();
  double cut = angles.back() + widest / 2;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    if (angles[i + 1] - angles[i] <= widest) continue;
    widest = angles[i + 1] - angles[i];
    cut = angles[i] + widest / 2;
  }
  return cut;
}

void measure(const Placed& part, const Envelope& envelope, Lump& lump) {
  const Model& model = part.model();
  double volume = 0;
  for (const int face : lump.faces) {
    volume -= flux(model.faces[static_cast<std::size_t>(face)], Eigen::Vector3d::Zero(),
                   Eigen::Vector3d::UnitZ());
  }
  const std::map<int, int> mouth = open_edges(model, lump);
  const double cut = cut_angle(model, mouth);
  for (const auto& [number, sense] : mouth) {
    const Edge& edge = model.edges[static_cast<std::size_t>(number)];
    const auto theta = [cut](const Eigen::Vector3d& p) {
      return std::remainder(std::atan2(p.y(), p.x()) - cut - pi, 2 * pi);
    };
    for (std::size_t i = 0; i < edge.points.size(); ++i) {
      if (envelope.is_inside(edge.points[i], near_envelope)) lump.is_measured = false;
      if (i == 0 || radius_of(edge.points[i]) < on_envelope) continue;
      // All round the axis: the end of E belongs to the lump, which its mouth does not tell.
      if (std::abs(theta(edge.points[i]) - theta(edge.points[i - 1])) > pi) {
        lump.is_measured = false;
      }
    }
    const double term =
        part.integral(number, [&](const Eigen::Vector3d& p, const Eigen::Vector3d& dp) {
          return (p.x() * p.x() + p.y() * p.y()) / 2 * theta(p) * dp.z();
        });
    volume += sense * term;
  }
  lump.volume = volume;
  if (!(volume > 0)) lump.is_measured = false;
}

}  // namespace

bool Envelope::is_inside(const Eigen::Vector3d& p, double margin) const {
  const double r = radius_of(p);
  for (const double dr : {-margin, margin}) {
    for (const double dz : {-margin, margin}) {
      if (!covers(shadow_, std::abs(r + dr), p.z() + dz)) return false;
    }
  }
  return true;
}

double Envelope::distance_to_end(const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                                 double far) const {
  constexpr int steps = 400;
  double inside = 0;
  for (int i = 1; i <= steps; ++i) {
    const double t = far * i / steps;
    const Eigen::Vector3d q = p + t * d;
    if (covers(shadow_, radius_of(q), q.z())) {
      inside = t;
      continue;
    }
    double outside = t;
    for (int k = 0; k < 60; ++k) {
      const double middle = std::midpoint(inside, outside);
      const Eigen::Vector3d m = p + middle * d;
      (covers(shadow_, radius_of(m), m.z()) ? inside : outside) = middle;
    }
    return inside;
  }
  return far;
}

std::vector<Lump> lumps_of(const Placed& part, const TurnedFaces& turned,
                           const Envelope& envelope) {
  const Model& model = part.model();
  const std::vector<char> is_milled = milled_faces(part, turned, envelope.shadow());
  std::vector<int> parent(model.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Edge& edge : model.edges) {
    if (edge.faces.size() != 2 || edge.is_seam) continue;
    if (is_milled[static_cast<std::size_t>(edge.faces[0])] == 0 ||
        is_milled[static_cast<std::size_t>(edge.faces[1])] == 0) {
      continue;
    }
    if (!runs_inside(edge, envelope)) continue;
    parent[static_cast<std::size_t>(root_of(parent, edge.faces[0]))] =
        root_of(parent, edge.faces[1]);
  }
  std::map<int, Lump> lumps;
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    if (is_milled[i] != 0) {
      lumps[root_of(parent, static_cast<int>(i))].faces.push_back(static_cast<int>(i));
    }
  }
  std::vector<Lump> found;
  for (auto& [root, lump] : lumps) {
    measure(part, envelope, lump);
    found.push_back(std::move(lump));
  }
  return found;
}

}  // namespace ridgeline::part
