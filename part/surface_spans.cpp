#include "part/surface_spans.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "part/quadrature.hpp"

namespace ridgeline::part {
namespace {

template <class Fill>
std::vector<double> intervals(int count, const Fill& fill) {
  TColStd_Array1OfReal limits(1, count + 1);
  fill(limits);
  return {limits.begin(), limits.end()};
}

std::vector<double> intervals_u(const BRepAdaptor_Surface& surface) {
  return intervals(surface.NbUIntervals(GeomAbs_CN),
                   [&](TColStd_Array1OfReal& t) { surface.UIntervals(t, GeomAbs_CN); });
}

std::vector<double> intervals_v(const BRepAdaptor_Surface& surface) {
  return intervals(surface.NbVIntervals(GeomAbs_CN),
                   [&](TColStd_Array1OfReal& t) { surface.VIntervals(t, GeomAbs_CN); });
}

/// One of the two directions of a B-spline surface.
struct Direction {
  const TColStd_Array1OfReal& knots;
  bool is_periodic = false;
  double weight_ratio = 1;
  int degree = 0;
};

/// From the knots themselves: Open CASCADE 7.6 counts a single interval along the second parameter
/// of a periodic surface.
std::vector<double> spans_of(const Direction& direction, double first, double last) {
  const TColStd_Array1OfReal& knots = direction.knots;
  const double period = knots.Last() - knots.First();
  const double before = direction.is_periodic ? std::floor((first - knots.First()) / period) : 0;
  constexpr int turns = 3;  // that a face of at most a period reaches into
  std::vector<double> found{first};
  for (int turn = 0; turn < (direction.is_periodic ? turns : 1); ++turn) {
    for (const double knot : knots) {
      const double at = knot + (before + turn) * period;
      if (at > found.back() + 1e-12 && at < last - 1e-12) found.push_back(at);
    }
  }
  found.push_back(last);
  return needs_halves(direction.weight_ratio, direction.degree, found.size()) ? halved(found)
                                                                              : found;
}

enum class Along { U, V };

/// The least ratio of weights in a row of poles along one direction.
double weight_ratio(const Geom_BSplineSurface& s, Along along) {
  if (!(along == Along::U ? s.IsURational() : s.IsVRational())) return 1;
  const int rows = along == Along::U ? s.NbVPoles() : s.NbUPoles();
  const int columns = along == Along::U ? s.NbUPoles() : s.NbVPoles();
  double least = 1;
  for (int row = 1; row <= rows; ++row) {
    Weights weights;
    for (int i = 1; i <= columns; ++i) {
      weights.add(along == Along::U ? s.Weight(i, row) : s.Weight(row, i));
    }
    least = std::min(least, weights.ratio());
  }
  return least;
}

}  // namespace

SurfaceSpans surface_spans(const BRepAdaptor_Surface& surface) {
  const double u0 = surface.FirstUParameter(), u1 = surface.LastUParameter();
  if (surface.GetType() == GeomAbs_SurfaceOfRevolution) {
    const std::vector<double> whole{u0, u1};
    return {spans(u0, u1, &whole, std::numbers::pi / 2), halved(intervals_v(surface))};
  }
  if (surface.GetType() != GeomAbs_BSplineSurface) {
    return {intervals_u(surface), intervals_v(surface)};
  }
  const Handle(Geom_BSplineSurface) s = surface.BSpline();
  return {
      spans_of({s->UKnots(), s->IsUPeriodic(), weight_ratio(*s, Along::U), s->UDegree()}, u0, u1),
      spans_of({s->VKnots(), s->IsVPeriodic(), weight_ratio(*s, Along::V), s->VDegree()},
               surface.FirstVParameter(), surface.LastVParameter())};
}

}  // namespace ridgeline::part
