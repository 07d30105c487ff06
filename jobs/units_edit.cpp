#include "jobs/units_edit.hpp"

#include <algorithm>
#include <array>

#include "core/units/plan.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::Edit;
using units::Program;
using units::Unit;

constexpr std::size_t max_edits = 1000;
constexpr std::array<std::string_view, 5> settable{"machining", "shape", "tools", "process",
                                                   "closed"};

/// The path of a "set", as a JSON pointer into the unit.
Json::json_pointer path_of(const std::string& path, const Value& at) {
  const std::string head = path.substr(0, path.find('/', 1));
  const std::string_view first = head.starts_with('/') ? std::string_view(head).substr(1) : head;
  if (std::ranges::find(settable, first) == settable.end()) {
    at.refuse("set by paths that begin with " + alternatives(settable));
  }
  try {
    return Json::json_pointer(path.starts_with('/') ? path : "/" + path);
  } catch (const Json::exception&) {
    at.refuse("set by paths such as \"shape/1/end\"");
  }
}

/// A row whose arc was given another end, radius or sense has another centre too.
void forget_centre(Json& unit, const std::string& path) {
  const std::size_t slash = path.find("shape/");
  const std::size_t end = path.find('/', slash + 6);
  if (slash == std::string::npos || end == std::string::npos) return;
  if (path.substr(end + 1).starts_with("centre")) return;
  Json& row = unit.at(Json::json_pointer("/" + path.substr(slash, end - slash)));
  if (row.is_object()) row.erase("centre");
}

/// Rows that met before the edit and were moved at one side meet again.
void join_rows(const Json& before, Json& after) {
  if (!before.is_array() || !after.is_array() || before.size() != after.size()) return;
  for (std::size_t i = 0; i + 1 < after.size(); ++i) {
    if (!after[i].is_object() || !after[i + 1].is_object()) continue;
    if (before[i].at("end") != before[i + 1].at("start")) continue;
    const bool is_end_moved = after[i].value("end", Json()) != before[i].at("end");
    const bool is_start_moved = after[i + 1].value("start", Json()) != before[i + 1].at("start");
    if (is_end_moved == is_start_moved) continue;
    if (is_end_moved) {
      after[i + 1]["start"] = after[i].value("end", Json());
    } else {
      after[i]["end"] = after[i + 1].value("start", Json());
    }
    after[is_end_moved ? i + 1 : i].erase("centre");
  }
}

const Unit& unit_of(const Program& program, const Value& number) {
  const int count = static_cast<int>(program.units.size());
  if (count == 0) number.refuse("absent: the program has no unit");
  return program.units[static_cast<std::size_t>(number.integer(1, count) - 1)];
}

struct Change {
  Unit unit;
  bool is_of_tools = true;  ///< only
};

Change changed(const Unit& unit, const Value& set) {
  if (!set.json().is_object() || set.json().empty()) {
    set.refuse("an object of paths and their new values");
  }
  const Json before = unit_document(unit);
  Json after = before;
  Change change;
  for (const auto& [path, value] : set.json().items()) {
    const Value at(value, set.pointer() + "/" + pointer_token(path));
    const Json::json_pointer pointer = path_of(path, at);
    try {
      after.at(pointer) = value;
    } catch (const Json::exception&) {
      at.refuse("set by the path of a value that the unit has");
    }
    forget_centre(after, path);
    const std::size_t start = path.starts_with('/') ? 1 : 0;
    change.is_of_tools = change.is_of_tools && path.substr(start).starts_with("tools");
  }
  join_rows(before.at("shape"), after.at("shape"));
  change.unit = read_unit(Value(after, set.pointer()));
  return change;
}

Unit inserted(const Value& value) {
  const Json& document = value.json();
  if (document.is_object()) {
    for (const char* key : {"region", "core", "number", "state", "volume", "feature"}) {
      if (document.contains(key)) {
        value.refuse("without \"" + std::string(key) + "\", which the planner makes");
      }
    }
  }
  return read_unit(value);
}

/// A changed unit that an edit of the same list changes again.
Unit* pending(std::vector<Edit>& edits, int number) {
  for (Edit& edit : edits) {
    if (auto* change = std::get_if<units::ChangeUnit>(&edit); change && change->number == number) {
      return &change->unit;
    }
  }
  return nullptr;
}

}  // namespace

Program edited(const Program& program, const Value& value) {
  std::vector<Edit> edits;
  Program result = program;
  bool is_edited = false;
  for (const Value& each : value.array(1, max_edits)) {
    Object object(each);
    is_edited = true;
    if (object.has("remove")) {
      edits.emplace_back(units::RemoveUnit{unit_of(program, object.required("remove")).number});
    } else if (object.has("insert_after")) {
      const int last = static_cast<int>(program.units.size());
      const int after = object.required("insert_after").integer(0, last);
      edits.emplace_back(units::InsertUnit{after, inserted(object.required("unit"))});
    } else if (object.has("unit")) {
      const Unit& unit = unit_of(program, object.required("unit"));
      Unit* before = pending(edits, unit.number);
      Unit& with_tools = result.units[static_cast<std::size_t>(unit.number - 1)];
      const Change change =
          changed(before != nullptr ? *before : with_tools, object.required("set"));
      with_tools.tools = change.unit.tools;
      if (before != nullptr) {
        *before = change.unit;
      } else if (!change.is_of_tools) {
        edits.emplace_back(units::ChangeUnit{unit.number, change.unit});
      }
    } else {
      each.refuse("{\"unit\", \"set\"}, {\"insert_after\", \"unit\"} or {\"remove\"}");
    }
    object.finish();
  }
  if (!is_edited) value.refuse("at least one edit");
  return edits.empty() ? result : units::edit(result, edits);
}

UnitsProgram undone(const UnitsProgram& program, const Value& count) {
  const int revision = static_cast<int>(program.edits.size());
  if (revision == 0) count.refuse("absent: the program has no edit to undo");
  const int left = revision - count.integer(1, revision);
  units::PlanJob job{.product = program.program.product,
                     .parameters = program.program.parameters,
                     .stock = program.program.stock,
                     .split = program.program.split};
  UnitsProgram before{units::plan(job), program.placement, Json::array()};
  for (int i = 0; i < left; ++i) {
    const Json& edits = program.edits[static_cast<std::size_t>(i)];
    before.program = edited(before.program, Value(edits, "/program/edits/" + std::to_string(i)));
    before.edits.push_back(edits);
  }
  return before;
}

}  // namespace ridgeline::jobs
