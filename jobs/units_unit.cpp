#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tools.hpp"
#include "jobs/limits.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_program.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::State;
using units::ToolRow;
using units::Unit;
using units::UnitKind;

constexpr std::array unit_kinds{UnitKind::FaceFront, UnitKind::FaceBack,   UnitKind::BarOuter,
                                UnitKind::BarInner,  UnitKind::Groove,     UnitKind::Hole,
                                UnitKind::FaceMill,  UnitKind::Unexplained};
constexpr std::array states{State::Auto, State::Edited, State::Frozen, State::Kept};

template <class Enum, std::size_t n>
Enum read_enum(const Value& value, const std::array<Enum, n>& all) {
  std::array<std::string_view, n> names;
  for (std::size_t i = 0; i < n; ++i) names[i] = name(all[i]);
  const std::string& wanted = value.string();
  for (std::size_t i = 0; i < n; ++i) {
    if (names[i] == wanted) return all[i];
  }
  value.refuse(alternatives(names));
}

constexpr double metres_per_minute = 1000.0 / 60;  // [mm/s]

Json tool_document(const ToolRow& row) {
  return {{"tool", row.tool},
          {"number", row.number},
          {"pattern", row.pattern},
          {"nominal_diameter", row.nominal_diameter},
          {"nose_radius", row.nose_radius},
          {"depth_of_cut", row.depth_of_cut},
          {"finish_allowance", row.finish_allowance},
          {"cutting_speed", row.cutting_speed / metres_per_minute},
          {"feed_per_revolution", row.feed_per_revolution}};
}

ToolRow read_tool_row(const Value& value) {
  Object object(value);
  ToolRow row;
  if (const std::optional<Value> tool = object.optional("tool")) row.tool = tool->name();
  row.number = object.integer("number", 1, max_tool_number, 1);
  row.pattern = object.required("pattern").name();
  row.nominal_diameter = object.number("nominal_diameter", between(0, 1000, "mm"), 0);
  row.nose_radius = object.number("nose_radius", between(0, 50, "mm"), 0);
  row.depth_of_cut = object.number("depth_of_cut", between(0, 1000, "mm"), 0);
  row.finish_allowance = object.number("finish_allowance", between(0, 100, "mm"), 0);
  row.cutting_speed =
      object.number("cutting_speed", above(0, 5000, "m/min"), 100) * metres_per_minute;
  row.feed_per_revolution =
      object.number("feed_per_revolution", above(0, 10, "mm per revolution"), 0.1);
  object.finish();
  return row;
}

Json machining_document(const Unit& unit) {
  if (unit.hole) {
    Json document = hole_document(*unit.hole);
    document.erase("volume");
    return document;
  }
  if (unit.face) {
    Json document = face_document(*unit.face);
    document.erase("volume");
    document["direction"] = document["normal"];  // 380 of document 004, out of the product
    document.erase("normal");
    return document;
  }
  if (unit.remainder) {
    Json document = remainder_document(*unit.remainder);
    document.erase("volume");
    return document;
  }
  return {{"start", point_document(unit.start)}};
}

/// A copy of the unit's machining data in the form of a product's feature.
Json feature_form(const Value& machining, const char* direction_key) {
  Json document = machining.json();
  if (!document.is_object()) machining.refuse("an object");
  if (document.contains("volume")) machining.refuse("without \"volume\"");
  if (direction_key != nullptr && document.contains("direction")) {
    document[direction_key] = document["direction"];
    document.erase("direction");
  }
  return document;
}

void read_machining(const Value& machining, Unit& unit, double volume) {
  switch (unit.kind) {
    case UnitKind::Hole: {
      const Json document = feature_form(machining, nullptr);
      unit.hole = read_product_hole(Value(document, machining.pointer()));
      unit.hole->volume = volume;
      return;
    }
    case UnitKind::FaceMill: {
      const Json document = feature_form(machining, "normal");
      unit.face = read_face(Value(document, machining.pointer()));
      unit.face->volume = volume;
      return;
    }
    case UnitKind::Unexplained: {
      Json document = feature_form(machining, nullptr);
      document["volume"] = volume;
      unit.remainder = read_remainder(Value(document, machining.pointer()));
      return;
    }
    default: {
      Object object(machining);
      unit.start = read_point(object.required("start"));
      object.finish();
    }
  }
}

bool has_shape(UnitKind kind) {
  return kind != UnitKind::Hole && kind != UnitKind::FaceMill && kind != UnitKind::Unexplained;
}

/// Rounding noise of a file as the nought that it means.
double tidy(double x) {
  return std::abs(x) < 1e-6 ? 0 : x;
}

std::string span(double a, double b) {
  return fmt::format("{:.6g} to {:.6g}", tidy(a), tidy(b));
}

std::string triple(const Eigen::Vector3d& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", tidy(v.x()), tidy(v.y()), tidy(v.z()));
}

}  // namespace

Json unit_document(const Unit& unit) {
  Json document = {{"number", unit.number},
                   {"kind", name(unit.kind)},
                   {"process", unit.process},
                   {"state", name(unit.state)},
                   {"machining", machining_document(unit)},
                   {"tools", Json::array()},
                   {"shape", rows_document(unit.shape)},
                   {"volume", unit.volume}};
  for (const ToolRow& row : unit.tools) document["tools"].push_back(tool_document(row));
  if (unit.is_closed) document["closed"] = true;
  if (unit.feature) document["feature"] = *unit.feature;
  if (!unit.notes.empty()) document["notes"] = unit.notes;
  if (!units::is_empty(unit.region)) {
    document["region"] = region_document(unit.region);
    if (!units::is_empty(units::difference_of(unit.region, unit.core))) {
      document["core"] = region_document(unit.core);
    }
  }
  return document;
}

Unit read_unit(const Value& value) {
  Object object(value);
  Unit unit;
  unit.number = object.integer("number", 0, 1'000'000, 0);
  unit.kind = read_enum(object.required("kind"), unit_kinds);
  const bool needs_process = unit.kind != UnitKind::FaceFront && unit.kind != UnitKind::FaceBack;
  const int usual_process = unit.kind == UnitKind::FaceBack ? 2 : 1;
  if (needs_process) object.required("process");
  unit.process = object.integer("process", 1, 2, usual_process);
  if (const auto state = object.optional("state")) unit.state = read_enum(*state, states);
  unit.volume = object.number("volume", section_volume_range, 0);
  if (has_shape(unit.kind)) {
    unit.shape = read_rows(object.required("shape"));
    unit.start = unit.shape.front().start;
    if (const auto machining = object.optional("machining")) {
      read_machining(*machining, unit, unit.volume);
    }
  } else {
    read_machining(object.required("machining"), unit, unit.volume);
    if (const auto shape = object.optional("shape")) shape->array(0, 0);
  }
  unit.is_closed = object.boolean("closed", unit.kind == UnitKind::Groove);
  if (object.has("feature")) {
    unit.feature = static_cast<std::size_t>(object.integer("feature", 0, 1'000'000, 0));
  }
  if (const auto region = object.optional("region")) unit.region = read_region(*region);
  unit.core = unit.region;
  if (const auto core = object.optional("core")) unit.core = read_region(*core);
  if (const auto notes = object.optional("notes")) {
    for (const Value& note : notes->array(0, 1000)) unit.notes.push_back(note.string());
  }
  if (const auto tools = object.optional("tools")) {
    for (const Value& row : tools->array(0, 100)) unit.tools.push_back(read_tool_row(row));
  } else {
    unit.tools = units::usual_tools(unit);
  }
  object.finish();
  return unit;
}

std::string unit_label(const Unit& unit) {
  std::string text = fmt::format("{:2} {}", unit.number, name(unit.kind));
  if (unit.hole) {
    text += fmt::format("  diameter {:.6g}, depth {:.6g}, at {} along {}", unit.hole->diameter,
                        unit.hole->depth, triple(unit.hole->start), triple(unit.hole->direction));
  } else if (unit.face) {
    text += fmt::format("  {}, depth {:.6g}, Z {}, out of {}", unit.face->form, unit.face->depth,
                        span(unit.face->z0, unit.face->z1), triple(unit.face->normal));
  } else if (unit.remainder) {
    text += fmt::format("  {}, X {}, Z {}", unit.remainder->why,
                        span(unit.remainder->r0, unit.remainder->r1),
                        span(unit.remainder->z0, unit.remainder->z1));
  } else if (!unit.shape.empty()) {
    text += fmt::format("  X {}, Z {}", span(unit.shape.front().start.r, unit.shape.back().end.r),
                        span(unit.shape.front().start.z, unit.shape.back().end.z));
  }
  return text;
}

}  // namespace ridgeline::jobs
