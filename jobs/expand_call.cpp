#include "jobs/expand_call.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using nc::CallArgument;

/// Meanings that are a number of the chamfer job, under their own name there.
constexpr std::array<std::string_view, 11> numbers{
    "width",   "cutting_amount", "tolerance",     "section_angle", "points",   "start_angle",
    "overlap", "passes",         "spindle_speed", "feed",          "clearance"};
/// Meanings that name something or describe a workpiece, a hole or a tool in the call itself.
constexpr std::array<std::string_view, 15> others{
    "workpiece",         "hole",         "tool",       "edge",        "side",
    "inner_radius",      "outer_radius", "length",     "hole_radius", "eccentric_distance",
    "penetration_angle", "position_x",   "position_y", "position_z",  "tool_radius"};
constexpr std::string_view arrangement = "arrangement_angle";

constexpr double wall_of_bore = 1;        ///< of the bore's radius, where a call gives no outside
constexpr double length_of_outside = 10;  ///< of the outer radius, where a call gives no length

bool is_meaning(std::string_view text) {
  return text == arrangement || std::ranges::find(numbers, text) != numbers.end() ||
         std::ranges::find(others, text) != others.end();
}

std::string meanings() {
  std::vector<std::string_view> all(numbers.begin(), numbers.end());
  all.insert(all.end(), others.begin(), others.end());
  all.push_back(arrangement);
  return alternatives(all);
}

[[noreturn]] void refuse_argument(const CallArgument& argument, const std::string& limit) {
  throw Error(ErrorCode::BadInput, argument.text + " (" + argument.meaning + ") must be " + limit,
              {.field = "/program", .value = argument.text, .limit = limit});
}

/// The arguments of one call by meaning.
class Arguments {
public:
  explicit Arguments(const nc::Call& call) : call_(call) {}

  const CallArgument* find(std::string_view meaning) const {
    const auto found = std::ranges::find(call_.arguments, meaning, &CallArgument::meaning);
    return found == call_.arguments.end() ? nullptr : &*found;
  }
  bool has(std::string_view meaning) const { return find(meaning) != nullptr; }
  double number(std::string_view meaning, double otherwise) const {
    const CallArgument* argument = find(meaning);
    return argument ? argument->value : otherwise;
  }
  /// Copies a number of the call to a member, when it is there.
  void copy(std::string_view meaning, Json& to, std::string_view key) const {
    if (const CallArgument* argument = find(meaning)) to[std::string(key)] = argument->value;
  }
  /// 1 or 2 as the first or the second word.
  void choose(std::string_view meaning, const char* first, const char* second, Json& to) const {
    const CallArgument* argument = find(meaning);
    if (!argument) return;
    if (argument->value != 1 && argument->value != 2) {
      refuse_argument(*argument, std::string("1 (") + first + ") or 2 (" + second + ")");
    }
    to[std::string(meaning)] = argument->value == 1 ? first : second;
  }

private:
  const nc::Call& call_;
};

std::string whole(const CallArgument& argument) {
  if (argument.value != std::floor(argument.value) || std::abs(argument.value) > 1e9) {
    refuse_argument(argument, "a whole number");
  }
  return std::to_string(static_cast<long long>(argument.value));
}

/// The name that the binding gives the number, or the number as text.
std::string named(const CallArgument& argument, const BoundCall& bound) {
  std::string number = whole(argument);
  const auto letter = bound.names.find(argument.letter);
  if (letter == bound.names.end()) return number;
  const auto name = letter->second.find(number);
  return name == letter->second.end() ? number : name->second;
}

/// A hole by number: the one of that name, of the name H and the number, or at that place in the
/// workpiece's list.
std::string hole_name(const CallArgument& argument, const BoundCall& bound, const Json& workpiece) {
  std::string name = named(argument, bound);
  if (!workpiece.is_object() || !workpiece.contains("holes")) return name;
  const Json& holes = workpiece.at("holes");
  const auto has = [&](const std::string& wanted) {
    return std::ranges::any_of(holes, [&](const Json& h) { return h.value("name", "") == wanted; });
  };
  if (has(name)) return name;
  if (has("H" + name)) return "H" + name;
  const double place = argument.value;
  if (place >= 1 && place <= static_cast<double>(holes.size())) {
    return holes.at(static_cast<std::size_t>(place) - 1).value("name", name);
  }
  return name;
}

/// A workpiece that the call describes itself.
Json described_workpiece(const Arguments& arguments) {
  const double outer = arguments.number("outer_radius", 0);
  const double inner = arguments.number("inner_radius", outer / (1 + wall_of_bore));
  const double outside = outer > 0 ? outer : inner * (1 + wall_of_bore);
  Json hole = {{"name", "H1"}, {"shape", "circle"}};
  arguments.copy("hole_radius", hole, "radius");
  arguments.copy("eccentric_distance", hole, "eccentric_distance");
  arguments.copy("penetration_angle", hole, "penetration_angle");
  Json workpiece = {{"kind", "workpiece"},
                    {"name", "of the call"},
                    {"shape", "thick_walled_cylinder"},
                    {"inner_radius", inner},
                    {"outer_radius", outside},
                    {"length", arguments.number("length", length_of_outside * outside)},
                    {"position",
                     {arguments.number("position_x", 0), arguments.number("position_y", 0),
                      arguments.number("position_z", 0)}},
                    {"holes", {hole}}};
  arguments.copy(arrangement, workpiece, arrangement);
  return workpiece;
}

void add_workpiece(const Arguments& arguments, const BoundCall& bound,
                   const Definitions& definitions, Json& job) {
  if (const CallArgument* workpiece = arguments.find("workpiece")) {
    job["workpiece"] = named(*workpiece, bound);
  }
  if (arguments.has("inner_radius") || arguments.has("outer_radius")) {
    if (const CallArgument* workpiece = arguments.find("workpiece")) {
      refuse_argument(*workpiece, "left out where the call gives the radii of the workpiece");
    }
    job["workpiece"] = described_workpiece(arguments);
    job["hole"] = "H1";
    return;
  }
  for (const std::string_view meaning :
       {"length", "hole_radius", "eccentric_distance", "penetration_angle", "arrangement_angle",
        "position_x", "position_y", "position_z"}) {
    if (const CallArgument* argument = arguments.find(meaning)) {
      refuse_argument(*argument, "beside inner_radius or outer_radius: the workpiece is named");
    }
  }
  const CallArgument* hole = arguments.find("hole");
  if (!hole) return;
  Json workpiece = job.value("workpiece", Json());
  if (workpiece.is_string()) {
    const auto found = definitions.find("workpiece", workpiece.get<std::string>());
    workpiece = found ? found->document : Json();
  }
  job["hole"] = hole_name(*hole, bound, workpiece);
}

void add_tool(const Arguments& arguments, const BoundCall& bound, Json& job) {
  const CallArgument* tool = arguments.find("tool");
  if (tool) {
    const std::string name = named(*tool, bound);
    job["tool"] = name == whole(*tool) ? Json(std::stoll(name)) : Json(name);
  }
  const CallArgument* radius = arguments.find("tool_radius");
  if (!radius) return;
  const double number = tool ? tool->value : 1;
  job["tool"] = {{"kind", "tool"},
                 {"number", static_cast<long long>(number)},
                 {"name", "of the call"},
                 {"shape", "ball"},
                 {"radius", radius->value}};
}

char read_letter(const std::string& key, const Value& value) {
  const bool is_letter = key.size() == 1 && key[0] >= 'A' && key[0] <= 'Z';
  if (!is_letter || std::string_view("GLNOP").find(key[0]) != std::string_view::npos) {
    value.refuse("under a letter A to Z other than G, L, N, O and P");
  }
  return key[0];
}

nc::BoundMacro read_letters(int number, const Value& value) {
  nc::BoundMacro macro{.number = number, .letters = {}};
  Object object(value);
  for (const auto& [key, text] : value.json().items()) {
    const Value meaning(text, value.pointer() + "/" + pointer_token(key));
    if (!is_meaning(meaning.string())) meaning.refuse(meanings());
    macro.letters.push_back({read_letter(key, meaning), meaning.string()});
  }
  return macro;
}

void read_names(const Value& value, BoundCall& bound) {
  Object letters(value);
  for (const auto& [key, table] : value.json().items()) {
    const Value of_letter(table, value.pointer() + "/" + pointer_token(key));
    Object names(of_letter);
    for (const auto& [number, name] : table.items()) {
      const Value named(name, of_letter.pointer() + "/" + pointer_token(number));
      bound.names[read_letter(key, of_letter)][number] = named.name();
    }
  }
}

}  // namespace

CallBinding read_binding(const std::optional<Value>& value) {
  CallBinding binding;
  if (!value) {
    binding.letters = nc::default_binding();
    for (const nc::BoundMacro& macro : binding.letters) binding.calls[macro.number];
    return binding;
  }
  Object object(*value);
  for (const Value& entry : object.required("macros").array(1, 100)) {
    Object macro(entry);
    const int number = macro.required("number").integer(1, 99999999);
    if (binding.calls.contains(number)) macro.refuse("number", "bound once");
    BoundCall& bound = binding.calls[number];
    const std::optional<Value> letters = macro.optional("letters");
    nc::BoundMacro of_default = nc::default_binding().front();
    of_default.number = number;
    binding.letters.push_back(letters ? read_letters(number, *letters) : of_default);
    if (const std::optional<Value> names = macro.optional("names")) read_names(*names, bound);
    if (const std::optional<Value> job = macro.optional("job")) {
      Object(*job).value();
      bound.job = job->json();
    }
    macro.finish();
  }
  object.finish();
  return binding;
}

nlohmann::json job_of(const nc::Call& call, const BoundCall& bound,
                      const Definitions& definitions) {
  const Arguments arguments(call);
  Json job = bound.job;
  job["job"] = "chamfer";
  if (!job.contains("edge")) job["edge"] = "inner";
  add_workpiece(arguments, bound, definitions, job);
  add_tool(arguments, bound, job);
  arguments.choose("edge", "inner", "outer", job);
  arguments.choose("side", "entry", "exit", job);
  if (arguments.has("width")) job.erase("cutting_amount");
  if (arguments.has("cutting_amount")) job.erase("width");
  for (const std::string_view meaning : numbers) arguments.copy(meaning, job, meaning);
  return job;
}

}  // namespace ridgeline::jobs
