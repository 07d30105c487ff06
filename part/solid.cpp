#include "part/solid.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Geom_BSplineCurve.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <numbers>
#include <numeric>

#include "part/integrate.hpp"
#include "part/recognise.hpp"
#include "part/shape.hpp"

namespace ridgeline::part {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int grid = 5;                  // samples of a free-form face along each parameter
constexpr double mesh_angle = 0.5;       // [rad]
constexpr double on_boundary = 1e-7;     // [mm]: the kernel's own tolerance
constexpr double step_of_arc = pi / 18;  // points of circles and ellipses
constexpr int fewest_points = 24;        // of a free-form edge
constexpr int most_points = 96;

Surface round_surface(SurfaceKind kind, const gp_Ax3& frame, double radius) {
  return {.kind = kind,
          .origin = vector(frame.Location()),
          .axis = vector(frame.Direction()),
          .radius = radius};
}

Surface surface_of(const BRepAdaptor_Surface& surface) {
  switch (surface.GetType()) {
    case GeomAbs_Plane: return round_surface(SurfaceKind::Plane, surface.Plane().Position(), 0);
    case GeomAbs_Cylinder: {
      const gp_Cylinder s = surface.Cylinder();
      return round_surface(SurfaceKind::Cylinder, s.Position(), s.Radius());
    }
    case GeomAbs_Cone: {
      const gp_Cone s = surface.Cone();
      Surface found = round_surface(SurfaceKind::Cone, s.Position(), s.RefRadius());
      found.half_angle = s.SemiAngle();
      return found;
    }
    case GeomAbs_Sphere: {
      const gp_Sphere s = surface.Sphere();
      return round_surface(SurfaceKind::Sphere, s.Position(), s.Radius());
    }
    case GeomAbs_Torus: {
      const gp_Torus s = surface.Torus();
      Surface found = round_surface(SurfaceKind::Torus, s.Position(), s.MajorRadius());
      found.minor_radius = s.MinorRadius();
      return found;
    }
    default: return {};
  }
}

/// Normal out of the product.
Sample sample_at(const BRepAdaptor_Surface& surface, bool is_reversed, double u, double v) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface.D1(u, v, p, du, dv);
  Eigen::Vector3d normal = vector(du).cross(vector(dv));
  const double length = normal.norm();
  if (length > 0) normal /= length;
  return {vector(p), is_reversed ? Eigen::Vector3d(-normal) : normal};
}

std::vector<Sample> samples_of(const TopoDS_Face& face, const BRepAdaptor_Surface& surface,
                               int steps) {
  const double u0 = surface.FirstUParameter(), u1 = surface.LastUParameter();
  const double v0 = surface.FirstVParameter(), v1 = surface.LastVParameter();
  const bool is_reversed = face.Orientation() == TopAbs_REVERSED;
  std::vector<Sample> samples;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Sample sample = sample_at(surface, is_reversed, std::lerp(u0, u1, (i + 0.5) / steps),
                                      std::lerp(v0, v1, (j + 0.5) / steps));
      if (sample.normal.norm() > 0.5) samples.push_back(sample);
    }
  }
  return samples;
}

/// A face on the other nappe of its cone, beyond the apex: the same cone from a place of the face.
Surface on_nappe_of(const Eigen::Vector3d& point, Surface cone) {
  const double along = (point - cone.origin).dot(cone.axis);
  const double radius = cone.radius + along * std::tan(cone.half_angle);
  if (radius >= 0) return cone;
  cone.origin += along * cone.axis;
  cone.radius = -radius;
  cone.half_angle = -cone.half_angle;
  return cone;
}

Face face_of(const TopoDS_Face& shape) {
  Face face;
  const BRepAdaptor_Surface surface(shape);  // as far as the face reaches
  face.surface = surface_of(surface);
  const bool is_free = face.surface.kind == SurfaceKind::Other;
  face.samples = samples_of(shape, surface, is_free ? grid : 1);
  if (is_free) {
    if (const std::optional<Surface> found = recognised(face.samples)) face.surface = *found;
  }
  if (face.surface.kind == SurfaceKind::Cone && !face.samples.empty()) {
    face.surface = on_nappe_of(face.samples.front().point, face.surface);
  }
  integrate(shape, surface, face);
  if (face.surface.kind == SurfaceKind::Plane) {
    face.side = face.normal_integral.dot(face.surface.axis) < 0 ? -1 : 1;
  } else if (face.surface.kind != SurfaceKind::Other && !face.samples.empty()) {
    const Sample& sample = face.samples.front();
    face.side = sample.normal.dot(natural_normal(face.surface, sample.point)) < 0 ? -1 : 1;
  }
  return face;
}

std::vector<double> parameters(const BRepAdaptor_Curve& curve) {
  const double first = curve.FirstParameter();
  const double last = curve.LastParameter();
  int n = 1;
  switch (curve.GetType()) {
    case GeomAbs_Line: break;
    case GeomAbs_Circle:
    case GeomAbs_Ellipse:
      n = std::max(2, static_cast<int>(std::ceil((last - first) / step_of_arc)));
      break;
    default: {
      int wanted = fewest_points;
      if (curve.GetType() == GeomAbs_BSplineCurve) wanted = 2 * curve.BSpline()->NbKnots();
      n = std::clamp(wanted, fewest_points, most_points);
    }
  }
  std::vector<double> values;
  for (int i = 0; i <= n; ++i) values.push_back(std::lerp(first, last, static_cast<double>(i) / n));
  return values;
}

Edge edge_of(const TopoDS_Edge& shape, const BRepAdaptor_Curve& curve,
             const TopTools_IndexedMapOfShape& vertices) {
  Edge edge;
  if (curve.GetType() == GeomAbs_Line) {
    edge.kind = CurveKind::Line;
  } else if (curve.GetType() == GeomAbs_Circle) {
    const gp_Circ circle = curve.Circle();
    edge.kind = CurveKind::Circle;
    edge.centre = vector(circle.Location());
    edge.axis = vector(circle.XAxis().Direction()).cross(vector(circle.YAxis().Direction()));
    edge.radius = circle.Radius();
  }
  for (const double t : parameters(curve)) edge.points.push_back(vector(curve.Value(t)));
  const TopoDS_Edge forward = TopoDS::Edge(shape.Oriented(TopAbs_FORWARD));
  const TopoDS_Vertex ends[] = {TopExp::FirstVertex(forward), TopExp::LastVertex(forward)};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!ends[i].IsNull()) edge.vertices[i] = vertices.FindIndex(ends[i]) - 1;
  }
  return edge;
}

/// Normal out of the product of a face at an edge's parameter; also for free-form faces.
Eigen::Vector3d normal_on_edge(const TopoDS_Face& shape, const Face& face, const TopoDS_Edge& edge,
                               double t, const Eigen::Vector3d& point) {
  if (face.surface.kind != SurfaceKind::Other) {
    return face.side * natural_normal(face.surface, point);
  }
  double first = 0, last = 0;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, shape, first, last);
  if (pcurve.IsNull()) {
    return face.samples.empty() ? Eigen::Vector3d::UnitZ() : face.samples.front().normal;
  }
  const gp_Pnt2d uv = pcurve->Value(std::lerp(first, last, t));
  const BRepAdaptor_Surface surface(shape, Standard_False);
  return sample_at(surface, shape.Orientation() == TopAbs_REVERSED, uv.X(), uv.Y()).normal;
}

/// Builds the model of a solid.
class Builder {
public:
  explicit Builder(const Solid::Shape& shape) : shape_(shape) {}

  Model run() {
    model_.name = shape_.name;
    model_.has_cavity = shape_.solid.NbChildren() > 1;
    for (int i = 1; i <= shape_.vertices.Extent(); ++i) {
      model_.vertices.push_back(vector(BRep_Tool::Pnt(TopoDS::Vertex(shape_.vertices(i)))));
    }
    for (int i = 1; i <= shape_.edges.Extent(); ++i) {
      const TopoDS_Edge& edge = TopoDS::Edge(shape_.edges(i));
      const auto place = static_cast<std::size_t>(i - 1);
      model_.edges.push_back(BRep_Tool::Degenerated(edge)
                                 ? Edge{}
                                 : edge_of(edge, shape_.curves[place], shape_.vertices));
    }
    for (int i = 1; i <= shape_.faces.Extent(); ++i) {
      const TopoDS_Face& face = TopoDS::Face(shape_.faces(i));
      model_.faces.push_back(face_of(face));
      add_loops(face, i - 1);
    }
    for (int i = 0; i < shape_.edges.Extent(); ++i) compare_normals(i);
    for (const Face& face : model_.faces) model_.volume += face.moment_integral.trace() / 3;
    measure_extents();
    return std::move(model_);
  }

private:
  void add_loops(const TopoDS_Face& face, int number) {
    Face& result = model_.faces.back();
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
      std::vector<EdgeUse> loop;
      for (TopExp_Explorer edges(wires.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
        const int edge = shape_.edges.FindIndex(edges.Current()) - 1;
        Edge& used = model_.edges[static_cast<std::size_t>(edge)];
        if (used.points.empty()) continue;
        loop.push_back({edge, edges.Current().Orientation() == TopAbs_REVERSED});
        if (std::find(used.faces.begin(), used.faces.end(), number) != used.faces.end()) {
          used.is_seam = true;
        }
        used.faces.push_back(number);
      }
      if (!loop.empty()) result.loops.push_back(std::move(loop));
    }
  }

  /// n_b.(n_a x t) < 0: face b falls away from face a, which lies left of t. Design, section 4.
  void compare_normals(int number) {
    Edge& edge = model_.edges[static_cast<std::size_t>(number)];
    if (edge.faces.size() != 2 || edge.is_seam) return;
    const TopoDS_Edge& shape = TopoDS::Edge(shape_.edges(number + 1));
    const BRepAdaptor_Curve& curve = shape_.curves[static_cast<std::size_t>(number)];
    gp_Pnt p;
    gp_Vec d;
    curve.D1(std::midpoint(curve.FirstParameter(), curve.LastParameter()), p, d);
    Eigen::Vector3d n[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const int face = edge.faces[i];
      n[i] = normal_on_edge(TopoDS::Face(shape_.faces(face + 1)),
                            model_.faces[static_cast<std::size_t>(face)], shape, 0.5, vector(p));
    }
    edge.angle = std::atan2(n[0].cross(n[1]).norm(), n[0].dot(n[1]));
    const double way = is_reversed_in(edge.faces[0], number) ? -1 : 1;
    edge.is_convex = n[1].dot(n[0].cross(way * vector(d))) < 0;
  }

  bool is_reversed_in(int face, int edge) const {
    for (const std::vector<EdgeUse>& loop : model_.faces[static_cast<std::size_t>(face)].loops) {
      for (const EdgeUse& use : loop) {
        if (use.edge == edge) return use.is_reversed;
      }
    }
    return false;
  }

  void measure_extents() {
    model_.low = Eigen::Vector3d::Constant(HUGE_VAL);
    model_.high = Eigen::Vector3d::Constant(-HUGE_VAL);
    for (const Edge& edge : model_.edges) {
      for (const Eigen::Vector3d& point : edge.points) {
        model_.low = model_.low.cwiseMin(point);
        model_.high = model_.high.cwiseMax(point);
      }
    }
  }

  const Solid::Shape& shape_;
  Model model_;
};

}  // namespace

Solid::Solid(std::shared_ptr<const Shape> shape)
    : shape_(std::move(shape)), model_(std::make_shared<Model>(Builder(*shape_).run())) {}

std::vector<Solid::Triangle> Solid::mesh(std::span<const int> faces, double deflection) const {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const int face : faces) builder.Add(compound, shape_->faces(face + 1));
  BRepTools::Clean(compound);
  const BRepMesh_IncrementalMesh mesher(compound, deflection, Standard_False, mesh_angle,
                                        Standard_False);
  std::vector<Triangle> triangles;
  for (const int number : faces) {
    const TopoDS_Face& face = TopoDS::Face(shape_->faces(number + 1));
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    if (mesh.IsNull()) continue;
    const bool is_reversed = face.Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      int corners[3];
      mesh->Triangle(i).Get(corners[0], corners[1], corners[2]);
      if (is_reversed) std::swap(corners[1], corners[2]);
      Triangle triangle;
      triangle.face = number;
      for (int k = 0; k < 3; ++k) {
        triangle.corners[k] = vector(mesh->Node(corners[k]).Transformed(place));
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

bool Solid::contains(const Eigen::Vector3d& point) const {
  if (!shape_->classifier) {
    shape_->classifier = std::make_unique<BRepClass3d_SolidClassifier>(shape_->solid);
  }
  shape_->classifier->Perform({point.x(), point.y(), point.z()}, on_boundary);
  return shape_->classifier->State() == TopAbs_IN;
}

Eigen::Vector3d Solid::edge_point(int edge, double t) const {
  const BRepAdaptor_Curve& curve = shape_->curves[static_cast<std::size_t>(edge)];
  return vector(curve.Value(std::lerp(curve.FirstParameter(), curve.LastParameter(), t)));
}

double Solid::integral(int edge, const Integrand& f) const {
  return integral_along(shape_->curves[static_cast<std::size_t>(edge)], f);
}

}  // namespace ridgeline::part
