#include "part/features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "part/bores.hpp"
#include "part/pockets.hpp"

namespace ridgeline::part {
namespace {

/// Volume of a tool's shape: what shares out the volume of a lump that holds several features.
double nominal(const units::Hole& hole) {
  double sum = 0;
  for (const units::HoleStep& step : hole.steps) {
    const double a = step.diameter / 2;
    const double b = step.end_diameter / 2;
    sum += std::numbers::pi * step.length * (a * a + a * b + b * b) / 3;
  }
  if (hole.bottom == units::HoleBottom::Cone) {
    const double R = hole.diameter / 2;
    sum += std::numbers::pi * R * R * R / std::tan(hole.point_angle / 2) / 3;
  }
  return std::max(sum, 1e-9);
}

double nominal(const units::MilledFace& face) {
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (const std::vector<units::FaceEdge>& loop : face.outline) {
    for (const units::FaceEdge& row : loop) {
      twice_area += (row.start - face.point).cross(row.end - face.point);
    }
  }
  return std::max(twice_area.norm() / 2 * face.depth, 1e-9);
}

/// Faces of a lump that no bore takes up, in connected groups.
std::vector<std::vector<int>> remaining_groups(const Model& model, const Lump& lump,
                                               const std::vector<Bore>& bores) {
  std::vector<int> left;
  for (const int face : lump.faces) {
    const bool is_taken = std::any_of(bores.begin(), bores.end(), [&](const Bore& bore) {
      return std::find(bore.faces.begin(), bore.faces.end(), face) != bore.faces.end();
    });
    if (!is_taken) left.push_back(face);
  }
  std::vector<std::vector<int>> groups;
  while (!left.empty()) {
    std::vector<int> group{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (const std::vector<EdgeUse>& loop :
           model.faces[static_cast<std::size_t>(group[i])].loops) {
        for (const EdgeUse& use : loop) {
          for (const int next : model.edges[static_cast<std::size_t>(use.edge)].faces) {
            const auto found = std::find(left.begin(), left.end(), next);
            if (found == left.end()) continue;
            group.push_back(next);
            left.erase(found);
          }
        }
      }
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

units::Remainder remainder_of(const Model& model, const std::vector<int>& faces, std::string why) {
  units::Remainder found;
  found.why = std::move(why);
  found.r0 = found.z0 = HUGE_VAL;
  found.z1 = -HUGE_VAL;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const int face : faces) {
    for (const std::vector<EdgeUse>& loop : model.faces[static_cast<std::size_t>(face)].loops) {
      for (const EdgeUse& use : loop) {
        for (const Eigen::Vector3d& p : model.edges[static_cast<std::size_t>(use.edge)].points) {
          const double r = std::hypot(p.x(), p.y());
          found.r0 = std::min(found.r0, r);
          found.r1 = std::max(found.r1, r);
          found.z0 = std::min(found.z0, p.z());
          found.z1 = std::max(found.z1, p.z());
          middle += p.head<2>();
        }
      }
    }
  }
  found.angle = std::atan2(middle.y(), middle.x());
  return found;
}

/// Where the features of one lump stand in the lists, with their shares of its volume.
struct Shares {
  std::vector<double*> volumes;
  std::vector<double> weights;
};

void share_out(const Lump& lump, const Shares& shares) {
  double sum = 0;
  for (const double weight : shares.weights) sum += weight;
  for (std::size_t i = 0; i < shares.volumes.size(); ++i) {
    *shares.volumes[i] = lump.volume * shares.weights[i] / sum;
  }
}

template <class T>
void name_all(std::vector<T>& list, const std::string& letter) {
  for (std::size_t i = 0; i < list.size(); ++i) list[i].name = letter + std::to_string(i + 1);
}

}  // namespace

Features features_of(const Placed& part, const Envelope& envelope, const std::vector<Lump>& lumps) {
  Features found;
  for (const Lump& lump : lumps) {
    std::vector<Bore> bores = bores_of(part, envelope, lump.faces);
    std::vector<units::MilledFace> faces;
    std::vector<units::Remainder> remainders;
    for (const std::vector<int>& group : remaining_groups(part.model(), lump, bores)) {
      Pocket pocket = pocket_of(part, envelope, group);
      if (pocket.face) {
        faces.push_back(std::move(*pocket.face));
      } else {
        remainders.push_back(remainder_of(part.model(), group, std::move(pocket.why)));
      }
    }
    Shares shares;
    for (Bore& bore : bores) {
      shares.volumes.push_back(&bore.hole.volume);
      shares.weights.push_back(nominal(bore.hole));
    }
    for (units::MilledFace& face : faces) {
      shares.volumes.push_back(&face.volume);
      shares.weights.push_back(nominal(face));
    }
    for (units::Remainder& rest : remainders) {
      shares.volumes.push_back(&rest.volume);
      shares.weights.push_back(1);
    }
    share_out(lump, shares);
    for (Bore& bore : bores) found.holes.push_back(std::move(bore.hole));
    for (units::MilledFace& face : faces) found.faces.push_back(std::move(face));
    for (units::Remainder& rest : remainders) found.remainders.push_back(std::move(rest));
  }
  name_all(found.holes, "H");
  name_all(found.faces, "F");
  name_all(found.remainders, "R");
  return found;
}

}  // namespace ridgeline::part
