#pragma once

#include <cmath>
#include <numbers>

#include "core/units/contour.hpp"
#include "core/units/product.hpp"

/// Products as plain values, written by hand from their drawings.
namespace ridgeline::units::products {

inline Contour chain(const std::vector<Point>& points) {
  Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({points[i], points[(i + 1) % points.size()], {}});
  return contour;
}

inline void round_corner(Contour& contour, std::size_t i, const Point& centre, double R,
                         Sense sense) {
  contour[i].arc = Segment::Round{centre, R, sense};
}

/// Segment of a circle of radius R beyond a chord at distance d.
inline double circle_segment(double R, double d) {
  return R * R * std::acos(d / R) - d * std::sqrt(R * R - d * d);
}

/// tests/parts/own_flanged_shaft.step: diameters 60, 120, 80, 62; bore 36, 24, 40; fillets R3,
/// chamfers; 4 holes d9 and 6 holes d6 with drill points, 8 flats at 38 on the diameter 80.
inline Product flanged_shaft() {
  Product product;
  product.name = "own_flanged_shaft";
  Contour contour = chain({{18, 0},
                           {28, 0},
                           {30, 2},
                           {30, 27},
                           {33, 30},
                           {60, 30},
                           {60, 50},
                           {40, 50},
                           {40, 90},
                           {34, 90},
                           {31, 93},
                           {31, 118},
                           {29, 120},
                           {22, 120},
                           {20, 118},
                           {20, 95},
                           {12, 91},
                           {12, 20},
                           {18, 20}});
  round_corner(contour, 3, {33, 27}, 3, Sense::CounterClockwise);
  round_corner(contour, 9, {34, 93}, 3, Sense::CounterClockwise);
  product.shadow = region_of(contour);
  product.volume = 502105.831320372;  // by Open CASCADE
  product.x_length = product.y_length = 120;
  const double pi = std::numbers::pi;
  const auto drilled = [&](double d, double depth) {
    const double R = d / 2;
    return pi * R * R * (depth + R / std::tan(drill_point_angle / 2) / 3);
  };
  for (int i = 0; i < 4; ++i) {
    const double a = pi / 4 + i * pi / 2;
    product.holes.push_back({.name = "",
                             .start = {46 * std::cos(a), 46 * std::sin(a), 30},
                             .direction = {0, 0, 1},
                             .diameter = 9,
                             .depth = 12,
                             .bottom = HoleBottom::Cone,
                             .steps = {{9, 9, 12}},
                             .volume = drilled(9, 12)});
  }
  for (int i = 0; i < 6; ++i) {
    const double a = i * pi / 3;
    product.holes.push_back({.name = "",
                             .start = {51 * std::cos(a), 51 * std::sin(a), 50},
                             .direction = {0, 0, -1},
                             .diameter = 6,
                             .depth = 10,
                             .bottom = HoleBottom::Cone,
                             .steps = {{6, 6, 10}},
                             .volume = drilled(6, 10)});
  }
  for (int i = 0; i < 8; ++i) {
    const double a = i * pi / 4;
    const Eigen::Vector3d n(std::cos(a), std::sin(a), 0);
    product.faces.push_back({.name = "",
                             .form = "flat",
                             .normal = n,
                             .point = 38 * n + Eigen::Vector3d(0, 0, 75),
                             .depth = 2,
                             .outline = {},
                             .z0 = 60,
                             .z1 = 90,
                             .volume = 30 * circle_segment(40, 38)});
  }
  return product;
}

}  // namespace ridgeline::units::products
