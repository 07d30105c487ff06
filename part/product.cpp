#include "part/product.hpp"

#include <Eigen/Geometry>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "part/features.hpp"
#include "part/shadow.hpp"
#include "part/step.hpp"
#include "part/voids.hpp"

namespace ridgeline::part {
namespace {

/// Design 1.8-d: a turned part has more round than other area, and fills its envelope.
constexpr double least_round_share = 0.40;
constexpr double least_turned_share = 0.80;  // with the planes that turning leaves: thin discs
constexpr double least_fill = 0.30;
constexpr double edge_noise = 1e-4;  // of the volume of lumps, from edges off their faces
constexpr double full_turn = 2 * 3.14159265358979 - 1e-3;  // [rad]

/// A solid on its axis.
struct Candidate {
  Placed part;
  TurnedFaces turned;
  double round_share() const { return turned.round_area / turned.area; }
  double turned_share() const { return (turned.round_area + turned.plane_area) / turned.area; }
  bool is_turned() const {
    return round_share() > least_round_share || turned_share() > least_turned_share;
  }
};

std::optional<Axis> axis_of(const Model& model, const std::optional<GivenAxis>& given) {
  if (!given) {
    if (std::optional<Axis> found = turning_axis(model)) return found;
    for (const Face& face : model.faces) {  // a ball turns about any axis through its middle
      if (face.surface.kind == SurfaceKind::Sphere) {
        return Axis{face.surface.origin, Eigen::Vector3d::UnitZ()};
      }
    }
    return std::nullopt;
  }
  if (given->point) return Axis{*given->point, given->direction};
  const std::optional<Axis> found = turning_axis(model);
  if (found && found->direction.cross(given->direction).norm() < same_direction) {
    return Axis{found->point, given->direction};
  }
  return Axis{(model.low + model.high) / 2, given->direction};
}

std::optional<Candidate> candidate(const Solid& solid, const std::optional<GivenAxis>& given) {
  const std::optional<Axis> axis = axis_of(solid.model(), given);
  if (!axis) return std::nullopt;
  Candidate found{Placed(solid, turning_frame(solid.model(), *axis)), {}};
  found.turned = turned_faces(found.part);
  double low = 0;
  for (const Meridian& one : found.turned.meridians) low = std::min(low, one.z0);
  if (low < -1e-9) {  // a bulge below all edges
    geometry::Frame frame = found.part.frame();
    frame.origin += low * frame.axes.col(2);
    found = Candidate{Placed(solid, frame), {}};
    found.turned = turned_faces(found.part);
  }
  return found;
}

std::string text(double x) {
  return std::to_string(x);
}

[[noreturn]] void refuse_shape(const Candidate& one) {
  throw Error(ErrorCode::NotTurned,
              "the part is not turned: " + text(100 * one.round_share()) +
                  " % of its surface is round about one axis, more than " +
                  text(100 * least_round_share) + " % is needed; \"axis\" forces it",
              {.field = "/product_step",
               .value = text(one.round_share()),
               .limit = "> " + text(least_round_share)});
}

Candidate chosen(const std::vector<Solid>& solids, const std::optional<GivenAxis>& given) {
  std::vector<Candidate> turned;
  std::optional<Candidate> other;
  for (const Solid& solid : solids) {
    std::optional<Candidate> one = candidate(solid, given);
    if (!one) continue;
    if (one->is_turned() || (given && solids.size() == 1)) {
      turned.push_back(std::move(*one));
    } else if (!other || one->round_share() > other->round_share()) {
      other = std::move(one);
    }
  }
  if (turned.size() == 1) return std::move(turned.front());
  if (solids.size() > 1) {
    throw Error(ErrorCode::SeveralSolids,
                "the part file holds " + std::to_string(solids.size()) + " solids, " +
                    std::to_string(turned.size()) +
                    " of them turned; exactly one turned solid is needed",
                {.field = "/product_step",
                 .value = std::to_string(solids.size()),
                 .limit = "1 turned solid"});
  }
  if (other) refuse_shape(*other);
  throw Error(ErrorCode::NotTurned, "the part is not turned: no face is round about an axis",
              {.field = "/product_step"});
}

/// The walls of full holes hide nothing: turned faces beside them tell what is material.
bool is_hole_wall(const Model& model, const Face& face) {
  const bool is_round =
      face.surface.kind == SurfaceKind::Cylinder || face.surface.kind == SurfaceKind::Cone;
  if (!is_round || face.side > 0) return false;
  double sweep = 0;
  for (const Face& other : model.faces) {
    if (other.side < 0 && other.surface.kind == face.surface.kind &&
        std::abs(other.surface.radius - face.surface.radius) < same_place &&
        is_same_axis({other.surface.origin, other.surface.axis},
                     {face.surface.origin, face.surface.axis})) {
      sweep += other.sweep;
    }
  }
  return sweep > full_turn;
}

units::Region shadow_of(const Candidate& one) {
  const Model& model = one.part.model();
  std::vector<char> is_shoulder(model.faces.size(), 0);
  for (const Shoulder& shoulder : one.turned.shoulders) {
    is_shoulder[static_cast<std::size_t>(shoulder.face)] = 1;
  }
  std::vector<int> free;
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    if (one.turned.is_coaxial[i] != 0 || is_shoulder[i] != 0) continue;
    if (!is_hole_wall(model, model.faces[i])) free.push_back(static_cast<int>(i));
  }
  return shadow_of(one.part, one.turned, image_of(one.part, one.turned, free));
}

/// What the lumps that could not be measured share: the rest.
void measure_rest(const Model& model, double milled, std::vector<Lump>& lumps) {
  double rest = milled;
  double area = 0;
  const auto area_of = [&](const Lump& lump) {
    double sum = 0;
    for (const int face : lump.faces) sum += model.faces[static_cast<std::size_t>(face)].area;
    return sum;
  };
  for (const Lump& lump : lumps) {
    if (lump.is_measured) {
      rest -= lump.volume;
    } else {
      area += area_of(lump);
    }
  }
  // Mouths lie off the envelope by the file's tolerance: what that makes is shared by all.
  if (area <= 0 && std::abs(rest) < edge_noise * milled) {
    for (Lump& lump : lumps) lump.volume *= milled / (milled - rest);
  }
  for (Lump& lump : lumps) {
    if (!lump.is_measured) lump.volume = std::max(rest, 0.0) * area_of(lump) / area;
  }
}

/// Twice the farthest that any edge reaches from the axis along d; only edges that come near it are
/// looked at closely.
double length_along(const Placed& part, const Eigen::Vector3d& d) {
  const Model& model = part.model();
  double coarse = 0;
  const auto sampled = [&](const Edge& edge) {
    double far = 0;
    for (const Eigen::Vector3d& p : edge.points) far = std::max(far, std::abs(p.dot(d)));
    return far;
  };
  for (const Edge& edge : model.edges) coarse = std::max(coarse, sampled(edge));
  double exact = coarse;
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    if (model.edges[i].points.empty() || sampled(model.edges[i]) < 0.9 * coarse) continue;
    const Placed::Extent extent = part.extent(static_cast<int>(i), d);
    exact = std::max({exact, std::abs(extent.low), std::abs(extent.high)});
  }
  return 2 * exact;
}

units::Product product_of(const Candidate& one, const std::optional<GivenAxis>& given) {
  const Model& model = one.part.model();
  units::Product product;
  product.name = model.name;
  product.volume = model.volume;
  Filled filled = without_voids(shadow_of(one), model.has_cavity);
  product.shadow = std::move(filled.section);
  double whole = units::volume(product.shadow);  // of what the turned faces bound
  for (const units::Remainder& one_void : filled.voids) whole -= one_void.volume;
  if (!given && !(model.volume > least_fill * whole)) {
    throw Error(ErrorCode::NotTurned,
                "the part is not turned: it fills " + text(100 * model.volume / whole) +
                    " % of its turned envelope, more than " + text(100 * least_fill) +
                    " % is needed; \"axis\" forces it",
                {.field = "/product_step",
                 .value = text(model.volume / whole),
                 .limit = "> " + text(least_fill)});
  }
  product.x_length = length_along(one.part, Eigen::Vector3d::UnitX());
  product.y_length = length_along(one.part, Eigen::Vector3d::UnitY());
  for (const Meridian& meridian : one.turned.meridians) {
    const Face& face = model.faces[static_cast<std::size_t>(meridian.face)];
    if (face.sweep < full_turn) continue;
    const double r = units::range(meridian.curve, meridian.z0, meridian.z1).max;
    product.x_length = std::max(product.x_length, 2 * r);
    product.y_length = std::max(product.y_length, 2 * r);
  }
  const Envelope envelope(product.shadow);
  std::vector<Lump> lumps = lumps_of(one.part, one.turned, envelope);
  measure_rest(model, whole - model.volume, lumps);
  Features features = features_of(one.part, envelope, lumps);
  product.holes = std::move(features.holes);
  product.faces = std::move(features.faces);
  product.remainders = std::move(features.remainders);
  for (units::Remainder& one_void : filled.voids) {
    one_void.name = "R" + std::to_string(product.remainders.size() + 1);
    product.remainders.push_back(std::move(one_void));
  }
  return product;
}

template <class Read>
auto guarded(const Read& read) {
  try {
    return read();
  } catch (const Standard_Failure& failure) {
    throw Error(ErrorCode::BadFile,
                "the solid of the part file cannot be worked with: " +
                    std::string(failure.GetMessageString()),
                {.field = "/product_step"});
  }
}

}  // namespace

TurnedPart read_product(std::string_view step, const std::optional<GivenAxis>& axis) {
  return guarded([&] {
    const std::vector<Solid> solids = read_step(step);
    const Candidate one = chosen(solids, axis);
    TurnedPart found{product_of(one, axis), one.part.frame()};
    if (solids.size() > 1) {
      found.product.notes.push_back("of " + std::to_string(solids.size()) +
                                    " solids the only turned one was taken");
    }
    return found;
  });
}

units::Region read_stock(std::string_view step) {
  return guarded([&] {
    const Candidate one = chosen(read_step(step), {});
    return without_voids(shadow_of(one), one.part.model().has_cavity).section;
  });
}

}  // namespace ridgeline::part
