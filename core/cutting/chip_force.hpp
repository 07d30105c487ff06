#pragma once

#include <algorithm>
#include <cstddef>

#include "core/cutting/chips.hpp"

namespace ridgeline::cutting {

/// A chip does not cut below this thickness: at theta = 180 degrees sin(pi) = 1e-16 would else
/// switch the edge force on [mm].
constexpr double least_chip = 1e-9;

/// Where one chip stands in its table.
struct ChipPlace {
  const ToothChips* tooth = nullptr;
  std::size_t index = 0;
  std::size_t terms = 0;  ///< per chip
  std::size_t back = 0;   ///< earlier teeth beyond the first

  const Chip& chip() const { return tooth->chips[index]; }
  const Term* first_term() const { return tooth->terms.data() + index * terms; }
  const Earlier* further() const { return tooth->earlier.data() + index * back; }
};

/// S202: is the element in the stock when the tool is displaced by U?
bool is_engaged(const ChipTable& table, const ChipPlace& at, const Eigen::Vector2d& U);

/// g(U) of one face or groove at an element: <= 0 inside the material.
double boundary_value(const ChipTable& table, const ChipPlace& at, std::size_t boundary,
                      const Eigen::Vector2d& U);
/// Its gradient by U.
Eigen::Vector2d boundary_gradient(const ChipTable& table, const ChipPlace& at, std::size_t boundary,
                                  const Eigen::Vector2d& U);

/// min(t, r - rho): rho is where the ray from O' through the element enters the stock.
double stock_limited(const ChipTable& table, const ChipPlace& at, const Eigen::Vector2d& U,
                     double t);

/// Chip thickness t = ts + td (8)..(10), the least over the earlier teeth, ended by the stock if
/// asked. `deflection_at(earlier)` gives the deflection at theta_o.
template <typename DeflectionAt>
double chip_thickness(const ChipTable& table, const ChipPlace& at, const Eigen::Vector2d& U,
                      const DeflectionAt& deflection_at) {
  const Chip& chip = at.chip();
  const auto thickness = [&](const Earlier& earlier) {
    const Eigen::Vector2d moved = U - deflection_at(earlier);
    return earlier.ts + (chip.N.x() * moved.x() + chip.N.y() * moved.y());
  };
  double t = thickness(chip.earlier);
  for (std::size_t m = 0; m < at.back; ++m) t = std::min(t, thickness(at.further()[m]));
  if (table.cut.chip_end == ChipEnd::StockLimited && t > least_chip) {
    t = stock_limited(table, at, U, t);
  }
  return t;
}

}  // namespace ridgeline::cutting
