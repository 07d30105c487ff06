#pragma once

#include <optional>
#include <variant>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// A given stock: a cylinder about the axis, its middle on the middle of the product, or any half
/// section in the product's frame.
struct StockCylinder {
  double diameter = 0;
  double length = 0;
};
using GivenStock = std::variant<StockCylinder, Region>;

/// Everything that decides a program.
struct PlanJob {
  Product product;
  Parameters parameters;
  std::optional<GivenStock> stock;  ///< absent: made by S201 to S205
  std::optional<Split> split;       ///< absent: usual_split
};

/// S101 to S107 of document 004 with the decisions of design/units.md. Throws Error{BadInput}:
/// stock that does not hold the product, parameters out of range, with the JSON pointer of the job.
Program plan(const PlanJob& job);

/// S201 to S205. Document 004, equations (1), (2).
Region made_stock(const Product& product, const Parameters& parameters);

}  // namespace ridgeline::units
