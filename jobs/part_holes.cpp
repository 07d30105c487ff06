#include "jobs/part_holes.hpp"

#include <algorithm>
#include <cmath>

#include "core/units/figure.hpp"
#include "jobs/definitions.hpp"
#include "jobs/part_mouths.hpp"
#include "jobs/units_product.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;
using units::Limit;
using units::Segment;

constexpr double same_length = 1e-4;  // [mm]; design of parts: equal cylinders
constexpr double across_axis = 0.02;  // cosine to Z beyond which a hole leaves through no wall

/// A mouth on a wall of the part, in the product's frame.
struct Mouth {
  std::string name;
  std::string kind;                   ///< "hole", "slot", "pocket", ...
  Vector3d point = Vector3d::Zero();  ///< on its axis
  Vector3d out = Vector3d::UnitX();   ///< along its axis, out of the part
  double radius = 0;                  ///< of the corners
  double along = 0;                   ///< straight lengths along and across the turning axis
  double across = 0;
  bool is_through = true;          ///< into the bore
  bool is_outer_edge_left = true;  ///< false: countersunk
  double half_length() const { return radius + along / 2; }
};

/// Product frame to file coordinates; the identity when the part came without a file.
class Placement {
public:
  explicit Placement(const Json& document) {
    if (!document.is_object()) return;
    origin_ = vector(document.at("origin"));
    x_ = vector(document.at("x"));
    y_ = vector(document.at("y"));
    z_ = vector(document.at("z"));
  }
  Vector3d direction(const Vector3d& d) const { return d.x() * x_ + d.y() * y_ + d.z() * z_; }
  Vector3d point(const Vector3d& p) const { return origin_ + direction(p); }

private:
  static Vector3d vector(const Json& v) {
    return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
  }
  Vector3d origin_ = Vector3d::Zero();
  Vector3d x_ = Vector3d::UnitX(), y_ = Vector3d::UnitY(), z_ = Vector3d::UnitZ();
};

/// A stretch of one cylinder of the half section.
struct Stretch {
  double r = 0;
  double z0 = 0;
  double z1 = 0;
};

/// The cylinder that a limit of the shadow is from z0 to z1; nullopt where it is more than one.
std::optional<Stretch> cylinder_at(const std::vector<Segment>& limit, double z0, double z1) {
  for (const Segment& row : limit) {
    if (row.arc || std::abs(row.start.r - row.end.r) > same_length) continue;
    if (row.start.z <= z0 + same_length && row.end.z >= z1 - same_length) {
      return Stretch{row.start.r, row.start.z, row.end.z};
    }
  }
  return std::nullopt;
}

Mouth mouth_of(const units::Hole& hole) {
  Mouth mouth;
  mouth.name = hole.name;
  mouth.kind = "hole";
  mouth.point = hole.start;
  mouth.out = -hole.direction;
  mouth.radius = hole.diameter / 2;
  mouth.is_through = hole.bottom == units::HoleBottom::Through;
  mouth.is_outer_edge_left =
      hole.steps.empty() || hole.steps.front().diameter <= hole.diameter + same_length;
  return mouth;
}

/// Slots and rounded rectangles, by the extents of their outline along the axis and across it.
std::optional<Mouth> mouth_of(const units::MilledFace& face, const std::vector<Segment>& inner) {
  if (std::abs(face.normal.z()) > across_axis || face.outline.empty()) return std::nullopt;
  const Vector3d n = face.normal;
  const Vector3d t(-n.y(), n.x(), 0);
  double z0 = HUGE_VAL, z1 = -HUGE_VAL, t0 = HUGE_VAL, t1 = -HUGE_VAL;
  const auto add = [&](const Vector3d& p) {
    z0 = std::min(z0, p.z());
    z1 = std::max(z1, p.z());
    t0 = std::min(t0, p.dot(t));
    t1 = std::max(t1, p.dot(t));
  };
  for (const units::FaceEdge& edge : face.outline.front()) {
    add(edge.start);
    add(edge.end);
  }
  z0 = std::min(z0, face.z0);
  z1 = std::max(z1, face.z1);
  Mouth mouth;
  mouth.name = face.name;
  mouth.kind = face.form;
  mouth.out = n;
  const bool is_slot = face.length > 0 && face.width > 0 && face.form == "slot";
  const double width = face.width > 0 ? face.width : t1 - t0;
  const double length = face.length > 0 ? face.length : z1 - z0;
  const bool is_along = std::abs(z1 - z0 - length) < 0.01;
  mouth.radius = is_slot ? width / 2 : face.corner_radius;
  if (!(mouth.radius > same_length)) return std::nullopt;
  mouth.along = std::max(0.0, (is_along ? length : width) - 2 * mouth.radius);
  mouth.across = std::max(0.0, (is_along ? width : length) - 2 * mouth.radius);
  if (mouth.along < same_length) mouth.along = 0;
  if (mouth.across < same_length) mouth.across = 0;
  mouth.point = (z0 + z1) / 2 * Vector3d::UnitZ() + (t0 + t1) / 2 * t + face.point.dot(n) * n;
  const std::optional<Stretch> bore = cylinder_at(inner, z0, z1);
  mouth.is_through = bore && face.point.dot(n) < bore->r + same_length;
  return mouth;
}

Json shape_document(const Mouth& mouth) {
  Json document = {{"name", mouth.name}, {"radius", mouth.radius}, {"walls", 1}};
  if (mouth.along <= 0 && mouth.across <= 0) {
    document["shape"] = "circle";
  } else if (mouth.across <= 0) {
    document["shape"] = "elongated";
    document["straight_along"] = mouth.along;
  } else {
    document["shape"] = "rounded_rectangle";
    document["straight_along"] = mouth.along;
    document["straight_across"] = mouth.across;
  }
  return document;
}

/// Builds the answer mouth by mouth.
class Import {
public:
  Import(const Part& part, std::string name, const std::optional<ChamferWish>& wish)
      : part_(part),
        placement_(part.placement),
        name_(std::move(name)),
        wish_(wish),
        inner_(units::simplified(units::limit_of(part.product.shadow, Limit::Least))),
        outer_(units::simplified(units::limit_of(part.product.shadow, Limit::Greatest))) {}

  Json run() {
    for (const units::Hole& hole : part_.product.holes) add(mouth_of(hole));
    for (const units::MilledFace& face : part_.product.faces) {
      if (const std::optional<Mouth> mouth = mouth_of(face, inner_)) {
        add(*mouth);
      } else {
        leave(face.name, face.form, "its edge is none of a hole: no round corners in a round wall");
      }
    }
    for (const units::Remainder& rest : part_.product.remainders) {
      leave(rest.name, "unexplained", rest.why);
    }
    return {{"job", "units"},
            {"status", "ok"},
            {"operation", "holes"},
            {"workpieces", std::move(workpieces_)},
            {"edges", std::move(edges_)},
            {"unnamed", std::move(unnamed_)},
            {"jobs", std::move(jobs_)}};
  }

private:
  void leave(const std::string& name, const std::string& kind, const std::string& why) {
    unnamed_.push_back({{"name", name}, {"kind", kind}, {"why", why}});
  }

  void add(const Mouth& mouth) {
    if (std::abs(mouth.out.z()) > 1 - across_axis) {
      return leave(mouth.name, mouth.kind, "it opens in a face across the axis: its edge is plane");
    }
    const double reach = mouth.half_length() / std::sqrt(1 - mouth.out.z() * mouth.out.z());
    const double rise = mouth.out.z() / std::sqrt(1 - mouth.out.z() * mouth.out.z());
    const Vector3d& p = mouth.point;
    const double from_axis = std::hypot(p.x(), p.y());
    const std::optional<Stretch> outer = cylinder_at(outer_, p.z() - reach, p.z() + reach);
    if (!outer) return leave(mouth.name, mouth.kind, "its mouth lies over a step of the outside");
    // where the axis meets the bore, for holes that rise along Z
    const auto z_in = [&](double r) { return p.z() - rise * std::max(0.0, from_axis - r); };
    std::optional<Stretch> inner;
    for (const Segment& row : inner_) {
      const double z = z_in(row.start.r);
      inner = cylinder_at(inner_, z - reach, z + reach);
      if (inner && std::abs(z_in(inner->r) - z) < same_length) break;
      inner.reset();
    }
    if (!inner || inner->r < same_length) {
      return leave(mouth.name, mouth.kind,
                   inner_.empty() || box_is_solid() ? "the part has no bore there"
                                                    : "it ends over a step of the bore");
    }
    if (!mouth.is_through) {
      return leave(mouth.name, mouth.kind, "it is blind: it does not reach the bore");
    }
    place(mouth, *inner, *outer);
  }

  bool box_is_solid() const {
    return std::ranges::all_of(inner_, [](const Segment& row) {
      return row.start.r < same_length && row.end.r < same_length;
    });
  }

  /// The workpiece of a stretch, made when it is first asked for.
  Json& workpiece_of(const Stretch& inner, const Stretch& outer) {
    const double z0 = std::max(inner.z0, outer.z0);
    const double z1 = std::min(inner.z1, outer.z1);
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      if (std::abs(spans_[i].z0 - z0) < same_length && std::abs(spans_[i].z1 - z1) < same_length) {
        return workpieces_[i];
      }
    }
    spans_.push_back({inner.r, z0, z1});
    const std::string suffix = spans_.size() == 1 ? "" : "-" + std::to_string(spans_.size());
    workpieces_.push_back({{"kind", "workpiece"},
                           {"name", name_ + suffix},
                           {"shape", "thick_walled_cylinder"},
                           {"position", vector_document(placement_.point({0, 0, (z0 + z1) / 2}))},
                           {"axis", vector_document(placement_.direction(Vector3d::UnitZ()))},
                           {"inner_radius", inner.r},
                           {"outer_radius", outer.r},
                           {"length", z1 - z0},
                           {"holes", Json::array()}});
    return workpieces_.back();
  }

  void place(const Mouth& mouth, const Stretch& inner, const Stretch& outer) {
    Json hole = shape_document(mouth);
    hole["axis"] = vector_document(placement_.direction(mouth.out));
    hole["position"] = vector_document(placement_.point(mouth.point));
    const std::size_t before = spans_.size();
    Json& workpiece = workpiece_of(inner, outer);
    workpiece["holes"].push_back(hole);
    try {
      validate_definition(workpiece);
    } catch (const Error& error) {
      workpiece["holes"].erase(workpiece["holes"].size() - 1);
      if (spans_.size() > before) {
        spans_.pop_back();
        workpieces_.erase(workpieces_.size() - 1);
      }
      return leave(mouth.name, mouth.kind, error.what());
    }
    const std::string name = workpiece["name"];
    edge(name, mouth, "inner");
    if (mouth.is_outer_edge_left) {
      edge(name, mouth, "outer");
    } else {
      leave(mouth.name + " outer", mouth.kind, "its outer edge is countersunk already");
    }
  }

  void edge(const std::string& workpiece, const Mouth& mouth, const char* which) {
    edges_.push_back({{"workpiece", workpiece}, {"hole", mouth.name}, {"edge", which}});
    if (!wish_) return;
    jobs_.push_back(chamfer_job(workpiece, mouth.name, which, *wish_));
  }

  const Part& part_;
  Placement placement_;
  std::string name_;
  const std::optional<ChamferWish>& wish_;
  std::vector<Segment> inner_, outer_;
  std::vector<Stretch> spans_;
  Json workpieces_ = Json::array(), edges_ = Json::array(), unnamed_ = Json::array(),
       jobs_ = Json::array();
};

}  // namespace

Json hole_edges(const Part& part, const std::string& name, const std::optional<ChamferWish>& wish) {
  return Import(part, name, wish).run();
}

}  // namespace ridgeline::jobs
