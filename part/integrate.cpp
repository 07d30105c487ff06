#include "part/integrate.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "core/base/root.hpp"
#include "part/quadrature.hpp"
#include "part/shape.hpp"
#include "part/surface_spans.hpp"

namespace ridgeline::part {
namespace {

std::vector<double> curve_spans(const BRepAdaptor_Curve& curve) {
  const double first = curve.FirstParameter();
  const double last = curve.LastParameter();
  const bool is_round = curve.GetType() == GeomAbs_Circle || curve.GetType() == GeomAbs_Ellipse;
  const double longest = curve.GetType() == GeomAbs_Line ? HUGE_VAL
                         : is_round                      ? std::numbers::pi / 2
                                                         : (last - first) / 4;
  Handle(Geom_BSplineCurve) spline;
  if (curve.GetType() == GeomAbs_BSplineCurve) spline = curve.BSpline();
  std::vector<double> found =
      spans(first, last, spline.IsNull() ? nullptr : &spline->Knots(), longest);
  if (spline.IsNull()) return found;
  Weights weights;
  for (int i = 1; i <= spline->NbPoles(); ++i) weights.add(spline->Weight(i));
  return needs_halves(weights.ratio(), spline->Degree(), found.size()) ? halved(found) : found;
}

/// What is integrated: area, n (3), p n^T (9, row by row).
using Sums = Eigen::Matrix<double, 13, 1>;

Sums sums_of(double area, const Eigen::Vector3d& n, const Eigen::Matrix3d& m) {
  Sums sums;
  sums(0) = area;
  sums.segment<3>(1) = n;
  for (int i = 0; i < 3; ++i) sums.segment<3>(4 + 3 * i) = m.row(i).transpose();
  return sums;
}

/// Integral from u = 0 to u of the densities of a surface of revolution, at one v:
///   p = (rho c, rho s, h),  p_u x p_v = (rho h' c, rho h' s, -rho rho'),  c = cos u, s = sin u.
struct Revolution {
  gp_Ax3 frame;
  GeomAbs_SurfaceType type;
  double R = 0, r = 0, angle = 0;

  Sums primitive(double u, double v) const {
    double rho = R, h = v, drho = 0, dh = 1;
    if (type == GeomAbs_Cone) {
      rho = R + v * std::sin(angle);
      h = v * std::cos(angle);
      drho = std::sin(angle);
      dh = std::cos(angle);
    } else if (type == GeomAbs_Sphere || type == GeomAbs_Torus) {
      rho = R + r * std::cos(v);
      h = r * std::sin(v);
      drho = -r * std::sin(v);
      dh = r * std::cos(v);
    }
    const double c = std::cos(u);
    const double s = std::sin(u);
    const Eigen::Vector3d n(rho * dh * s, -rho * dh * c, -rho * drho * u);
    const double q = rho * rho * dh;
    Eigen::Matrix3d m;
    m << q * (u + s * c) / 2, q * s * s / 2, -rho * rho * drho * s,  //
        q * s * s / 2, q * (u - s * c) / 2, rho * rho * drho * c,    //
        h * rho * dh * s, -h * rho * dh * c, -h * rho * drho * u;
    return sums_of(rho * std::hypot(dh, drho) * u, n, m);
  }

  /// From the frame of the surface to the model.
  Sums placed(const Sums& local) const {
    Eigen::Matrix3d B;
    B.col(0) = vector(frame.XDirection());
    B.col(1) = vector(frame.YDirection());
    B.col(2) = vector(frame.Direction());
    const double hand = frame.Direct() ? 1 : -1;
    const Eigen::Vector3d n = hand * (B * local.segment<3>(1));
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.row(i) = local.segment<3>(4 + 3 * i).transpose();
    m = hand * (B * m * B.transpose());
    m += vector(frame.Location()) * n.transpose();
    return sums_of(local(0), n, m);
  }
};

std::optional<Revolution> revolution(const BRepAdaptor_Surface& surface) {
  switch (surface.GetType()) {
    case GeomAbs_Cylinder: {
      const gp_Cylinder s = surface.Cylinder();
      return Revolution{s.Position(), GeomAbs_Cylinder, s.Radius(), 0, 0};
    }
    case GeomAbs_Cone: {
      const gp_Cone s = surface.Cone();
      return Revolution{s.Position(), GeomAbs_Cone, s.RefRadius(), 0, s.SemiAngle()};
    }
    case GeomAbs_Sphere: {
      const gp_Sphere s = surface.Sphere();
      return Revolution{s.Position(), GeomAbs_Sphere, 0, s.Radius(), 0};
    }
    case GeomAbs_Torus: {
      const gp_Torus s = surface.Torus();
      return Revolution{s.Position(), GeomAbs_Torus, s.MajorRadius(), s.MinorRadius(), 0};
    }
    default: return std::nullopt;
  }
}

/// The edges of a face that bound area, each with the sign of its direction.
template <class F>
void for_each_edge(const TopoDS_Face& face, const F& f) {
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    for (TopExp_Explorer edges(wires.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      const TopAbs_Orientation way = edge.Orientation();
      if (way != TopAbs_FORWARD && way != TopAbs_REVERSED) continue;
      f(edge, way == TopAbs_FORWARD ? 1.0 : -1.0);
    }
  }
}

/// Plane: integral of u^i v^j by edges in space. With q = u X + v Y:
///   area = closed integral of u dv;  integral of u = u^2/2 dv,  of v = u v dv.
void integrate_plane(const TopoDS_Face& face, const gp_Pln& plane, Face& result) {
  const gp_Ax3& frame = plane.Position();
  const Eigen::Vector3d O = vector(frame.Location());
  const Eigen::Vector3d X = vector(frame.XDirection());
  const Eigen::Vector3d Y = vector(frame.YDirection());
  double area = 0, first_u = 0, first_v = 0;
  for_each_edge(face, [&](const TopoDS_Edge& edge, double sign) {
    if (BRep_Tool::Degenerated(edge)) return;
    const BRepAdaptor_Curve curve(edge);
    const std::vector<double> limits = curve_spans(curve);
    for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
      at_gauss_points(limits[i], limits[i + 1], [&](double t, double weight) {
        gp_Pnt p;
        gp_Vec d;
        curve.D1(t, p, d);
        const Eigen::Vector3d q = vector(p) - O;
        const double u = q.dot(X);
        const double v = q.dot(Y);
        const double dv = sign * weight * vector(d).dot(Y);
        area += u * dv;
        first_u += u * u / 2 * dv;
        first_v += u * v * dv;
      });
    }
  });
  // The sign of the area is that of the normal out of the product against X x Y.
  const Eigen::Vector3d normal = X.cross(Y);
  result.area = std::abs(area);
  result.normal_integral = area * normal;
  result.moment_integral = (area * O + first_u * X + first_v * Y) * normal.transpose();
}

/// The parameter range of a face along u, as its edges reach.
struct Reach {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
};

/// Parameters of a line between first and last where it meets a knot of the surface.
TColStd_Array1OfReal crossings(const gp_Lin2d& line, double first, double last,
                               const SurfaceSpans& knots) {
  std::vector<double> found{first};
  const auto add = [&](const std::vector<double>& values, double at, double along) {
    if (std::abs(along) < 1e-14) return;
    for (const double value : values) {
      const double t = (value - at) / along;
      if (t > first && t < last) found.push_back(t);
    }
  };
  add(knots.u, line.Location().X(), line.Direction().X());
  add(knots.v, line.Location().Y(), line.Direction().Y());
  std::sort(found.begin(), found.end());
  TColStd_Array1OfReal limits(1, static_cast<int>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) limits(static_cast<int>(i) + 1) = found[i];
  return limits;
}

/// The same for any curve, between `limits` that follow its turns. The first and last knots break
/// nothing: an edge that runs along one would cross it by its noise many times.
void add_crossings(const Geom2dAdaptor_Curve& curve, const SurfaceSpans& knots,
                   std::vector<double>& limits) {
  std::vector<gp_Pnt2d> places;
  places.reserve(limits.size());
  for (const double t : limits) places.push_back(curve.Value(t));
  std::vector<double> found;
  const auto add = [&](const std::vector<double>& values, int axis) {
    const double tolerance = 1e-9 * (values.back() - values.front());
    for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
      const double low = places[i].Coord(axis);
      const double high = places[i + 1].Coord(axis);
      const double way = high < low ? -1 : 1;
      for (std::size_t k = 1; k + 1 < values.size(); ++k) {
        const double value = values[k];
        if ((low < value) == (high < value)) continue;
        const auto beyond = [&](double t) {
          gp_Pnt2d p;
          gp_Vec2d d;
          curve.D1(t, p, d);
          return RootSample{way * (p.Coord(axis) - value), way * d.Coord(axis)};
        };
        const double start = std::lerp(limits[i], limits[i + 1], (value - low) / (high - low));
        found.push_back(rising_root(beyond, limits[i], limits[i + 1], start, tolerance).x);
      }
    }
  };
  add(knots.u, 1);
  add(knots.v, 2);
  limits.insert(limits.end(), found.begin(), found.end());
  std::sort(limits.begin(), limits.end());
}

/// Closed integral along the parameter curves of `integrand(p, dp)`, spans of lines no longer than
/// `longest`. The integrand is G dv, or -H du: it vanishes along lines of constant v, or u.
template <class Integrand>
Sums integral_along(const TopoDS_Face& face, const Integrand& integrand, double longest,
                    Reach& reach, const SurfaceSpans& knots = {}) {
  Sums sums = Sums::Zero();
  for_each_edge(face, [&](const TopoDS_Edge& edge, double sign) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (pcurve.IsNull()) throw Standard_Failure("an edge has no curve on its surface");
    const Geom2dAdaptor_Curve curve(pcurve, first, last);
    for (const double t : {first, last}) {
      const double u = curve.Value(t).X();
      reach.low = std::min(reach.low, u);
      reach.high = std::max(reach.high, u);
    }
    Handle(Geom2d_BSplineCurve) spline;
    if (curve.GetType() == GeomAbs_BSplineCurve) spline = curve.BSpline();
    double width = (last - first) / 4;
    if (curve.GetType() == GeomAbs_Line) {
      const double across = std::abs(curve.Line().Direction().X());
      width = across > 1e-14 ? std::min(longest, std::numbers::pi / 4 / across) : longest;
    }
    std::vector<double> limits =
        spans(first, last, spline.IsNull() ? nullptr : &spline->Knots(), width);
    if (curve.GetType() == GeomAbs_Line) {
      const TColStd_Array1OfReal at_knots = crossings(curve.Line(), first, last, knots);
      limits = spans(first, last, &at_knots, width);
    } else if (!knots.u.empty()) {
      add_crossings(curve, knots, limits);
    }
    const auto add = [&](double t, double weight) {
      gp_Pnt2d p;
      gp_Vec2d d;
      curve.D1(t, p, d);
      reach.low = std::min(reach.low, p.X());
      reach.high = std::max(reach.high, p.X());
      integrand(p, d, sign * weight, sums);
    };
    for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
      at_gauss_points(limits[i], limits[i + 1], add, limits.size());
    }
  });
  return sums;
}

void store(const Sums& sums, Face& result) {
  result.area = std::abs(sums(0));
  result.normal_integral = sums.segment<3>(1);
  for (int i = 0; i < 3; ++i) {
    result.moment_integral.row(i) = sums.segment<3>(4 + 3 * i).transpose();
  }
}

Sums density(const BRepAdaptor_Surface& surface, double u, double v) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface.D1(u, v, p, du, dv);
  const Eigen::Vector3d normal = vector(du).cross(vector(dv));
  return sums_of(normal.norm(), normal, vector(p) * normal.transpose());
}

/// Integral of `f` from a to b over the spans between knots; one point of a thin one, such as an
/// edge leaves that runs along a by its noise.
template <class F>
Sums integral_across(double a, double b, const std::vector<double>& knots, const F& f) {
  Sums sums = Sums::Zero();
  const double sign = b < a ? -1 : 1;
  const double thin = 1e-4 * (knots.back() - knots.front());
  const std::vector<double> limits = spans(std::min(a, b), std::max(a, b), &knots, HUGE_VAL);
  for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
    const double width = limits[i + 1] - limits[i];
    if (width < 1e-12) continue;
    if (width < thin) {
      sums += sign * width * f(std::midpoint(limits[i], limits[i + 1]));
      continue;
    }
    at_gauss_points(limits[i], limits[i + 1],
                    [&](double t, double weight) { sums += sign * weight * f(t); });
  }
  return sums;
}

/// Any other surface: the primitive by Gauss points across, in the direction of fewer spans.
void integrate_numerically(const TopoDS_Face& face, const BRepAdaptor_Surface& surface,
                           Face& result) {
  const SurfaceSpans knots = surface_spans(surface);
  const double u0 = surface.FirstUParameter();
  const double v0 = surface.FirstVParameter();
  const auto along_u = [&](const gp_Pnt2d& p, const gp_Vec2d& d, double weight, Sums& sums) {
    if (std::abs(d.Y()) < 1e-14) return;
    sums += weight * d.Y() * integral_across(u0, p.X(), knots.u, [&](double u) {
              return density(surface, u, p.Y());
            });
  };
  const auto along_v = [&](const gp_Pnt2d& p, const gp_Vec2d& d, double weight, Sums& sums) {
    if (std::abs(d.X()) < 1e-14) return;
    sums -= weight * d.X() * integral_across(v0, p.Y(), knots.v, [&](double v) {
              return density(surface, p.X(), v);
            });
  };
  Reach reach;
  const bool is_round = surface.GetType() == GeomAbs_SurfaceOfRevolution;
  const double longest = is_round ? std::numbers::pi / 2 : HUGE_VAL;
  store(knots.v.size() < knots.u.size() ? integral_along(face, along_v, longest, reach, knots)
                                        : integral_along(face, along_u, longest, reach, knots),
        result);
}

}  // namespace

double integral_along(const BRepAdaptor_Curve& curve, const Solid::Integrand& f) {
  double sum = 0;
  const std::vector<double> limits = curve_spans(curve);
  for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
    at_gauss_points(
        limits[i], limits[i + 1],
        [&](double t, double weight) {
          gp_Pnt p;
          gp_Vec d;
          curve.D1(t, p, d);
          sum += weight * f(vector(p), vector(d));
        },
        limits.size());
  }
  return sum;
}

void integrate(const TopoDS_Face& face, const BRepAdaptor_Surface& surface, Face& result) {
  if (surface.GetType() == GeomAbs_Plane) return integrate_plane(face, surface.Plane(), result);
  const std::optional<Revolution> round = revolution(surface);
  if (!round) return integrate_numerically(face, surface, result);
  Reach reach;
  const bool is_curved = round->type == GeomAbs_Sphere || round->type == GeomAbs_Torus;
  const auto along_u = [&](const gp_Pnt2d& p, const gp_Vec2d& d, double weight, Sums& sums) {
    if (std::abs(d.Y()) > 1e-14) sums += weight * d.Y() * round->primitive(p.X(), p.Y());
  };
  const Sums local =
      integral_along(face, along_u, is_curved ? std::numbers::pi / 4 : HUGE_VAL, reach);
  store(round->placed(local), result);
  result.sweep = std::min(reach.high - reach.low, 2 * std::numbers::pi);
}

}  // namespace ridgeline::part
