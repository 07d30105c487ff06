#include "core/cutting/chip_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeline::cutting {
namespace {

double value(const Term& term, const Curve& curve, const Eigen::Vector2d& U) {
  double g = term.g0 + term.gx * U.x() + term.gy * U.y();
  if (curve.sign != 0) {
    const double along = curve.ax * U.x() + curve.ay * U.y();
    g += curve.sign * (U.squaredNorm() - along * along);
  }
  return g;
}

Eigen::Vector3d on_map(const Stock& stock, const Eigen::Vector3d& P) {
  return stock.map_origin + stock.map_axes * P;
}

bool is_under_map(const Stock& stock, const Eigen::Vector3d& P) {
  const Eigen::Vector3d p = on_map(stock, P);
  return p.z() <= height_at(*stock.map, p.x(), p.y());
}

Eigen::Vector3d origin_at(const Chip& chip, const Eigen::Vector2d& U) {
  return {U.x(), U.y(), chip.base};
}

// Where the ray O' + U + s N enters the material of a face; -infinity: it comes from inside.
double entry(const Face& face, const Eigen::Vector3d& U, const Eigen::Vector3d& N) {
  constexpr double inside = -std::numeric_limits<double>::infinity();
  if (const auto* plane = std::get_if<HalfSpace>(&face)) {
    const double fall = N.dot(plane->n);
    return fall < 0 ? (plane->h - U.dot(plane->n)) / fall : inside;
  }
  const Round& round = std::get<Round>(face);
  const auto across = [&round](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return v - v.dot(round.axis) * round.axis;
  };
  const Eigen::Vector3d W = across(U - round.centre);
  const Eigen::Vector3d M = across(N);
  const double a = M.squaredNorm();
  const double b = W.dot(M);
  const double disc = b * b - a * (W.squaredNorm() - round.R * round.R);
  if (!(a > 0 && disc >= 0)) return inside;
  const double root = std::sqrt(disc);
  return round.material == MaterialSide::Outside ? (-b + root) / a : (-b - root) / a;
}

// The surface of the map between the element, which is inside, and t back along N, by bisection.
double map_limited(const Stock& stock, const Chip& chip, const Eigen::Vector2d& U, double t) {
  const Eigen::Vector3d P = origin_at(chip, U) + chip.r * chip.N;
  if (is_under_map(stock, P - t * chip.N)) return t;
  double in = 0;
  double out = t;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (in + out);
    (is_under_map(stock, P - middle * chip.N) ? in : out) = middle;
  }
  return out;
}

}  // namespace

bool is_engaged(const ChipTable& table, const ChipPlace& at, const Eigen::Vector2d& U) {
  const Stock& stock = table.cut.stock;
  const std::size_t faces = stock.faces.size();
  const Term* terms = at.first_term();
  for (std::size_t i = faces; i < at.terms; ++i) {
    if (!(value(terms[i], table.curves[i], U) <= 0)) return false;
  }
  const bool all = stock.combine == Combine::All;
  bool inside = all || faces == 0;
  for (std::size_t i = 0; i < faces; ++i) {
    const bool in = value(terms[i], table.curves[i], U) <= 0;
    inside = all ? inside && in : inside || in;
  }
  if (!inside || !stock.map) return inside;
  const Chip& chip = at.chip();
  return is_under_map(stock, origin_at(chip, U) + chip.r * chip.N);
}

double boundary_value(const ChipTable& table, const ChipPlace& at, std::size_t boundary,
                      const Eigen::Vector2d& U) {
  return value(at.first_term()[boundary], table.curves[boundary], U);
}

Eigen::Vector2d boundary_gradient(const ChipTable& table, const ChipPlace& at, std::size_t boundary,
                                  const Eigen::Vector2d& U) {
  const Term& term = at.first_term()[boundary];
  const Curve& curve = table.curves[boundary];
  const Eigen::Vector2d a(curve.ax, curve.ay);
  return Eigen::Vector2d(term.gx, term.gy) + 2 * curve.sign * (U - U.dot(a) * a);
}

// A convex edge begins where its last face does; a concave one where the first face does that holds
// the element.
double stock_limited(const ChipTable& table, const ChipPlace& at, const Eigen::Vector2d& U,
                     double t) {
  const Stock& stock = table.cut.stock;
  const Chip& chip = at.chip();
  const Eigen::Vector3d from = origin_at(chip, U);
  const bool all = stock.combine == Combine::All;
  constexpr double none = std::numeric_limits<double>::infinity();
  double rho = all || stock.faces.empty() ? -none : none;
  for (std::size_t i = 0; i < stock.faces.size(); ++i) {
    const double s = entry(stock.faces[i], from, chip.N);
    const bool holds = value(at.first_term()[i], table.curves[i], U) <= 0;
    if (all) {
      rho = std::max(rho, s);
    } else if (holds) {
      rho = std::min(rho, s);
    }
  }
  for (const Round& groove : stock.grooves) rho = std::max(rho, entry(groove, from, chip.N));
  const double limited = std::min(t, chip.r - rho);
  return stock.map && limited > 0 ? map_limited(stock, chip, U, limited) : limited;
}

}  // namespace ridgeline::cutting
