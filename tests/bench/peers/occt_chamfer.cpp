#include "tests/bench/peers/occt_chamfer.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>
#include <vector>

#include "tests/bench/processor_time.hpp"

namespace ridgeline::bench {
namespace {

using Eigen::Vector3d;

TopoDS_Shape cylinder(const Vector3d& middle, const Vector3d& axis, double radius, double length) {
  const Vector3d base = middle - length / 2 * axis;
  const gp_Ax2 frame(gp_Pnt(base.x(), base.y(), base.z()), gp_Dir(axis.x(), axis.y(), axis.z()));
  return BRepPrimAPI_MakeCylinder(frame, radius, length).Shape();
}

TopoDS_Shape solid_of(const geometry::Workpiece& tube) {
  const geometry::Hole& hole = tube.holes.front();
  const TopoDS_Shape outside = cylinder(tube.position, tube.axis, tube.outer_radius, tube.length);
  const TopoDS_Shape bore = cylinder(tube.position, tube.axis, tube.inner_radius, 2 * tube.length);
  const TopoDS_Shape drilled =
      cylinder(hole.position, hole.axis, hole.profile.R2, 4 * tube.outer_radius);
  return BRepAlgoAPI_Cut(BRepAlgoAPI_Cut(outside, bore), drilled);
}

bool is_cylinder(const TopoDS_Shape& face, double radius) {
  const BRepAdaptor_Surface surface(TopoDS::Face(face));
  return surface.GetType() == GeomAbs_Cylinder &&
         std::abs(surface.Cylinder().Radius() - radius) < 1e-6;
}

std::vector<Vector3d> sampled(const TopoDS_Edge& edge, double tolerance) {
  const BRepAdaptor_Curve curve(edge);
  const GCPnts_TangentialDeflection points(curve, M_PI, tolerance);
  std::vector<Vector3d> all;
  for (int i = 1; i <= points.NbPoints(); ++i) {
    const gp_Pnt p = points.Value(i);
    all.emplace_back(p.X(), p.Y(), p.Z());
  }
  return all;
}

/// The edges where two faces meet, each once, as polylines.
class Edges {
public:
  explicit Edges(const TopoDS_Shape& solid) {
    TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, faces_);
  }
  template <class F>
  void for_each(F&& use) const {
    for (int i = 1; i <= faces_.Extent(); ++i) {
      if (faces_(i).Extent() == 2)
        use(TopoDS::Edge(faces_.FindKey(i)), faces_(i).First(), faces_(i).Last());
    }
  }

private:
  TopTools_IndexedDataMapOfShapeListOfShape faces_;
};

/// Where polylines cross the plane through P square to t, nearest to P; infinitely far: nowhere.
double crossing(const std::vector<std::vector<Vector3d>>& lines, const Vector3d& P,
                const Vector3d& t, Vector3d& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<Vector3d>& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double a = (line[i - 1] - P).dot(t), b = (line[i] - P).dot(t);
      if (a * b > 0 || a == b) continue;
      const Vector3d p = line[i - 1] + a / (a - b) * (line[i] - line[i - 1]);
      if ((p - P).norm() >= least) continue;
      least = (p - P).norm();
      at = p;
    }
  }
  return least;
}

void measure(const TopoDS_Shape& chamfered, const geometry::Workpiece& tube,
             const geometry::Edge& edge, double body_radius, double leg, OcctChamfer& out) {
  std::vector<std::vector<Vector3d>> on_wall, on_body;
  const double R2 = tube.holes.front().profile.R2;
  Edges(chamfered).for_each([&](const TopoDS_Edge& e, const TopoDS_Shape& a,
                                const TopoDS_Shape& b) {
    const auto borders = [&](double radius) {
      const double other = radius == R2 ? body_radius : R2;
      const auto is_chamfer = [&](const TopoDS_Shape& f) {
        return !is_cylinder(f, radius) && !is_cylinder(f, other);
      };
      return (is_cylinder(a, radius) && is_chamfer(b)) || (is_cylinder(b, radius) && is_chamfer(a));
    };
    if (borders(R2)) on_wall.push_back(sampled(e, 1e-6));
    if (borders(body_radius)) on_body.push_back(sampled(e, 1e-6));
  });
  constexpr int places = 720;
  for (int i = 0; i < places; ++i) {
    const geometry::RidgePoint ridge = geometry::ridge_at(edge, (i + 0.37) / places);
    const Vector3d P = to_outer(edge.frame, ridge.P), t = direction_to_outer(edge.frame, ridge.t);
    Vector3d G1, G2;
    const double far = std::max(crossing(on_body, P, t, G1), crossing(on_wall, P, t, G2));
    if (far > 4 * leg) {
      out.failure = "the chamfer does not go all round";
      return;
    }
    out.width_min = std::min(out.width_min, (G1 - G2).norm());
    out.width_max = std::max(out.width_max, (G1 - G2).norm());
  }
}

}  // namespace

OcctChamfer occt_chamfer(const geometry::Workpiece& tube, geometry::EdgeKind kind, double leg,
                         double tolerance) {
  OcctChamfer out;
  const geometry::Hole& hole = tube.holes.front();
  const double body_radius =
      kind == geometry::EdgeKind::Inner ? tube.inner_radius : tube.outer_radius;
  TopoDS_Shape solid;
  out.solid_seconds = processor_seconds([&] { solid = solid_of(tube); });
  std::vector<TopoDS_Edge> ridge;
  Edges(solid).for_each([&](const TopoDS_Edge& e, const TopoDS_Shape& a, const TopoDS_Shape& b) {
    const double R2 = hole.profile.R2;
    const bool meets = (is_cylinder(a, R2) && is_cylinder(b, body_radius)) ||
                       (is_cylinder(b, R2) && is_cylinder(a, body_radius));
    if (meets && (sampled(e, 0.1).front() - tube.position).dot(hole.axis) > 0) ridge.push_back(e);
  });
  out.sample_seconds = processor_seconds([&] {
    for (const TopoDS_Edge& e : ridge)
      out.sample_points += static_cast<int>(sampled(e, tolerance).size()) - 1;
  });
  try {
    TopoDS_Shape chamfered;
    out.chamfer_seconds = processor_seconds([&] {
      BRepFilletAPI_MakeChamfer make(solid);
      for (const TopoDS_Edge& e : ridge)
        if (make.Contour(e) == 0) make.Add(leg, e);
      make.Build();
      if (make.IsDone()) chamfered = make.Shape();
    });
    if (chamfered.IsNull()) {
      out.failure = "BRepFilletAPI_MakeChamfer is not done";
      return out;
    }
    const geometry::Edge edge = geometry::edge_of(tube, hole, kind, geometry::Side::Entry);
    measure(chamfered, tube, edge, body_radius, leg, out);
  } catch (const Standard_Failure& failure) {
    out.failure = failure.GetMessageString();
  }
  return out;
}

}  // namespace ridgeline::bench
