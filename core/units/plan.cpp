#include "core/units/plan.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/units/divide.hpp"
#include "core/units/features.hpp"
#include "core/units/order.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"
#include "core/units/tools.hpp"
#include "core/units/volumes.hpp"

namespace ridgeline::units {
namespace {

constexpr double largest = 1e5;      // [mm]: no lathe is longer
constexpr double poking_out = 1e-3;  // [mm^3] of product outside the stock that is rounding

void check(double value, double low, double high, const std::string& field) {
  if (value >= low && value <= high) return;
  const auto text = [](double x) { return std::to_string(x); };
  throw Error(ErrorCode::BadInput,
              field + " is " + text(value) + " mm; from " + text(low) + " to " + text(high) +
                  " mm is allowed",
              {.field = "/" + field, .value = text(value), .limit = text(low) + ".." + text(high)});
}

void validate(const PlanJob& job) {
  const Parameters& p = job.parameters;
  check(p.radial_allowance, 0, 1000, "parameters/radial_allowance");
  check(p.end_allowance, 0, 1000, "parameters/end_allowance");
  check(p.smallest_boring_bar, 0, 1000, "parameters/smallest_boring_bar");
  if (is_empty(job.product.shadow)) {
    throw Error(ErrorCode::BadInput, "the product has no half section", {.field = "/product"});
  }
  const Box s = box(job.product.shadow);
  check(s.r1, 1e-3, largest, "product/shadow");
  check(std::abs(s.z0), 0, 1e-3, "product/shadow");
  if (job.split) {
    check(job.split->outer, -largest, largest, "split/outer");
    check(job.split->inner, -largest, largest, "split/inner");
    check(job.split->outer_overlap, 0, largest, "split/outer_overlap");
    check(job.split->inner_overlap, 0, largest, "split/inner_overlap");
  }
}

Region placed_stock(const PlanJob& job) {
  if (!job.stock) return made_stock(job.product, job.parameters);
  if (const Region* region = std::get_if<Region>(&*job.stock)) return *region;
  const StockCylinder& cylinder = std::get<StockCylinder>(*job.stock);
  check(cylinder.diameter, 1e-3, largest, "stock/diameter");
  check(cylinder.length, 1e-3, largest, "stock/length");
  const Box s = box(job.product.shadow);
  const double middle = (s.z0 + s.z1) / 2;
  return rectangle(0, cylinder.diameter / 2, middle - cylinder.length / 2,
                   middle + cylinder.length / 2);
}

void check_stock(const Product& product, const Region& stock) {
  const double outside = volume(difference_of(product.shadow, stock));
  if (outside < poking_out) return;
  const Box s = box(product.shadow);
  throw Error(ErrorCode::BadInput,
              "the stock does not hold the product: " + std::to_string(outside) +
                  " mm3 lie outside; at least diameter " + std::to_string(2 * s.r1) +
                  " mm and length " + std::to_string(s.z1 - s.z0) + " mm are needed",
              {.field = "/stock"});
}

/// What the features of a product do not account for.
void explain_rest(Program& program) {
  const Product& product = program.product;
  double found = 0;
  for (const Hole& hole : product.holes) found += hole.volume;
  for (const MilledFace& face : product.faces) found += face.volume;
  for (const Remainder& rest : product.remainders) found += rest.volume;
  const double milled = volume(product.shadow) - product.volume;
  const double gap = milled - found;
  if (std::abs(gap) < 1e-6 * product.volume) return;
  if (gap < 0) {
    program.notes.push_back("the features add up to " + std::to_string(-gap) +
                            " mm3 more than lies between envelope and product");
    return;
  }
  const Box s = box(product.shadow);
  Unit unit;
  unit.kind = UnitKind::Unexplained;
  unit.volume = gap;
  unit.remainder = Remainder{.name = "difference",
                             .why = "envelope less product less all features found",
                             .r0 = s.r0,
                             .r1 = s.r1,
                             .z0 = s.z0,
                             .z1 = s.z1,
                             .volume = gap};
  unit.process = 2;
  program.units.push_back(std::move(unit));
}

}  // namespace

// D = 2 r_max + ra; document mode (1) D = sqrt(Xlen^2 + Ylen^2) + ra;  (2) L = Zlen + 2 ea, from
// -ea to Zlen + ea.
Region made_stock(const Product& product, const Parameters& parameters) {
  const Box s = box(product.shadow);
  const double ra = parameters.radial_allowance;
  const double ea = parameters.end_allowance;
  const double D = parameters.stock_rule == StockRule::Tight
                       ? 2 * s.r1 + ra
                       : std::hypot(product.x_length, product.y_length) + ra;  // (1)
  return rectangle(0, D / 2, s.z0 - ea, s.z1 + ea);                            // (2)
}

Program plan(const PlanJob& job) {
  validate(job);
  Program program;
  program.parameters = job.parameters;
  program.product = job.product;
  program.stock = placed_stock(job);
  check_stock(job.product, program.stock);
  program.split = job.split ? *job.split : usual_split(job.product);
  const std::vector<Zone> around =
      zones(program.product, program.stock, program.split, program.parameters);
  const Region T = difference_of(program.stock, program.product.shadow);
  const Division division{
      .remaining = T, .turned = T, .blocked = {}, .zones = around, .removed = {}, .process = 1};
  Divided divided = divide(division);
  program.units = std::move(divided.units);
  program.notes = std::move(divided.notes);
  for (Unit& unit : feature_units(program.product, program.split)) {
    program.units.push_back(std::move(unit));
  }
  explain_rest(program);
  put_in_order(program.units);
  number(program.units);
  for (Unit& unit : program.units) unit.tools = usual_tools(unit);
  program.volumes = measured_volumes(program);
  return program;
}

}  // namespace ridgeline::units
