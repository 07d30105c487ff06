#include "jobs/units_program.hpp"

#include <array>

#include "core/units/names.hpp"
#include "core/units/order.hpp"
#include "core/units/volumes.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::Parameters;
using units::Program;
using units::Split;
using units::StockRule;
using units::Unit;
using units::UnitKind;

constexpr Choices<StockRule, 2> stock_rules{{
    {"tight", StockRule::Tight},
    {"document", StockRule::Document},
}};
constexpr Range allowance_range = between(0, 1000, "mm");
constexpr std::size_t max_units = 20'000;

Json volumes_document(const units::Volumes& v) {
  return {{"stock", v.stock},
          {"product", v.product},
          {"turned", v.turned},
          {"units", v.units},
          {"overlap_declared", v.overlap_declared},
          {"overlap_undeclared", v.overlap_undeclared},
          {"left", v.left},
          {"unexplained", v.unexplained}};
}

/// Program, its processes, their units, the tools of each: figure 4 of document 004.
Json tree_document(const Program& program) {
  Json processes = Json::array();
  for (const int process : {1, 2}) {
    Json children = Json::array();
    for (const Unit& unit : program.units) {
      if (unit.process != process) continue;
      Json tools = Json::array();
      for (const units::ToolRow& row : unit.tools) {
        tools.push_back({{"label", row.pattern + ": " + row.tool}});
      }
      children.push_back({{"label", unit_label(unit)},
                          {"unit", unit.number},
                          {"state", name(unit.state)},
                          {"children", std::move(tools)}});
    }
    if (!children.empty()) {
      processes.push_back({{"label", "process " + std::to_string(process)},
                           {"process", process},
                           {"children", std::move(children)}});
    }
  }
  const std::string& name = program.product.name;
  return {{"label", name.empty() ? "program" : name}, {"children", std::move(processes)}};
}

Json removed_document(const units::Removed& removed) {
  Json document = {{"kind", name(removed.kind)}, {"process", removed.process}};
  if (!units::is_empty(removed.region)) document["region"] = region_document(removed.region);
  if (removed.feature) document["feature"] = *removed.feature;
  return document;
}

units::Removed read_removed(const Value& value) {
  Object object(value);
  units::Removed removed;
  const Value kind = object.required("kind");
  const std::optional<UnitKind> found = units::unit_kind(kind.string());
  if (!found) kind.refuse("a kind of unit");
  removed.kind = *found;
  removed.process = object.integer("process", 1, 2, 1);
  if (const auto region = object.optional("region")) removed.region = read_region(*region);
  if (object.has("feature")) {
    removed.feature = static_cast<std::size_t>(object.integer("feature", 0, 1'000'000, 0));
  }
  object.finish();
  return removed;
}

std::size_t feature_count(const units::Product& product, UnitKind kind) {
  switch (kind) {
    case UnitKind::Hole: return product.holes.size();
    case UnitKind::FaceMill: return product.faces.size();
    case UnitKind::Unexplained: return product.remainders.size();
    default: return 0;
  }
}

/// Core and service index the product's lists with these.
void check_feature(const Program& program, UnitKind kind, std::optional<std::size_t> feature,
                   const Value& value) {
  if (!feature) return;
  const std::size_t count = feature_count(program.product, kind);
  if (*feature < count) return;
  refuse({.field = value.pointer() + "/feature",
          .value = std::to_string(*feature),
          .limit = "the place of one of the product's " + std::to_string(count)});
}

void read_units(const Value& value, Program& program) {
  for (const Value& each : value.array(0, max_units)) {
    program.units.push_back(read_unit(each));
    check_feature(program, program.units.back().kind, program.units.back().feature, each);
  }
  units::number(program.units);
}

}  // namespace

Json parameters_document(const Parameters& parameters) {
  return {{"radial_allowance", parameters.radial_allowance},
          {"end_allowance", parameters.end_allowance},
          {"stock_rule", name_of(stock_rules, parameters.stock_rule)},
          {"smallest_boring_bar", parameters.smallest_boring_bar}};
}

Parameters read_parameters(const Value& value) {
  Object object(value);
  Parameters p;
  p.radial_allowance = object.number("radial_allowance", allowance_range, p.radial_allowance);
  p.end_allowance = object.number("end_allowance", allowance_range, p.end_allowance);
  p.stock_rule = object.choice("stock_rule", stock_rules, p.stock_rule);
  p.smallest_boring_bar =
      object.number("smallest_boring_bar", allowance_range, p.smallest_boring_bar);
  object.finish();
  return p;
}

Json split_document(const Split& split) {
  return {{"outer", split.outer},
          {"inner", split.inner},
          {"outer_overlap", split.outer_overlap},
          {"inner_overlap", split.inner_overlap}};
}

Split read_split(const Value& value) {
  Object object(value);
  Split split;
  split.outer = object.number("outer", section_range);
  split.inner = object.number("inner", section_range, split.outer);
  split.outer_overlap = object.number("outer_overlap", section_radius_range, 0);
  split.inner_overlap = object.number("inner_overlap", section_radius_range, 0);
  object.finish();
  return split;
}

Json program_document(const UnitsProgram& whole) {
  const Program& program = whole.program;
  Json document = {{"job", "units"},
                   {"status", "ok"},
                   {"revision", whole.edits.size()},
                   {"units", Json::array()},
                   {"volumes", volumes_document(program.volumes)},
                   {"tree", tree_document(program)},
                   {"notes", program.notes},
                   {"parameters", parameters_document(program.parameters)},
                   {"split", split_document(program.split)},
                   {"stock", {{"shape", region_document(program.stock)}}},
                   {"product", product_document(program.product)},
                   {"removed", Json::array()},
                   {"edits", whole.edits}};
  for (const Unit& unit : program.units) document["units"].push_back(unit_document(unit));
  for (const units::Removed& one : program.removed) {
    document["removed"].push_back(removed_document(one));
  }
  if (!whole.placement.is_null()) document["placement"] = whole.placement;
  return document;
}

UnitsProgram read_program(const Value& value) {
  Object object(value);
  UnitsProgram whole;
  Program& program = whole.program;
  constexpr Choices<int, 1> job{{{"units", 0}}};
  constexpr Choices<int, 1> status{{{"ok", 0}}};
  object.choice("job", job, 0);
  object.choice("status", status, 0);
  program.product = read_product(object.required("product"));
  const Value stock = object.required("stock");
  Object stock_object(stock);
  program.stock = read_region(stock_object.required("shape"));
  stock_object.finish();
  if (units::is_empty(program.stock)) stock.refuse("contours that bound an area");
  program.parameters = read_parameters(object.required("parameters"));
  program.split = read_split(object.required("split"));
  read_units(object.required("units"), program);
  if (const auto removed = object.optional("removed")) {
    for (const Value& each : removed->array(0, max_units)) {
      program.removed.push_back(read_removed(each));
      check_feature(program, program.removed.back().kind, program.removed.back().feature, each);
    }
  }
  if (const auto notes = object.optional("notes")) {
    for (const Value& note : notes->array(0, max_units)) program.notes.push_back(note.string());
  }
  if (const auto placement = object.optional("placement")) whole.placement = placement->json();
  if (const auto edits = object.optional("edits")) {
    edits->array();
    whole.edits = edits->json();
  }
  for (const std::string_view made : {"revision", "volumes", "tree"}) object.has(made);
  object.finish();
  program.volumes = units::measured_volumes(program);
  return whole;
}

}  // namespace ridgeline::jobs
