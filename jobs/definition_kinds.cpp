#include <array>

#include "jobs/definitions.hpp"
#include "jobs/limits.hpp"
#include "jobs/material.hpp"
#include "jobs/units_product.hpp"

namespace ridgeline::jobs {
namespace {

void check_workpiece(const Value& value) {
  read_workpiece(value);
  Object(value).required("name");
}

void check_tool(const Value& value) {
  read_tool(value);
  Object object(value);
  if (!object.has("number")) object.required("name");
}

void check_material(const Value& value) {
  read_material(value);
  Object(value).required("name");
}

/// A part and what was found in it: what turning programs are planned from.
void check_part(const Value& value) {
  Object object(value);
  object.required("kind");
  object.required("name").name();
  read_product(object.required("product"));
  object.has("placement");
  object.finish();
}

struct DefinitionKind {
  std::string_view name;
  void (*check)(const Value&);
};
constexpr std::array kinds{
    DefinitionKind{"workpiece", check_workpiece},
    DefinitionKind{"tool", check_tool},
    DefinitionKind{"material", check_material},
    DefinitionKind{"part", check_part},
};

}  // namespace

void validate_definition(const nlohmann::json& definition) {
  const Value value(definition);
  const Value kind = Object(value).required("kind");
  const std::string& name = kind.string();
  for (const DefinitionKind& each : kinds) {
    if (each.name == name) return each.check(value);
  }
  std::array<std::string_view, kinds.size()> names;
  for (std::size_t i = 0; i < kinds.size(); ++i) names[i] = kinds[i].name;
  kind.refuse(alternatives(names));
}

DefinitionKey key_of(const nlohmann::json& definition) {
  Object object{Value(definition)};
  DefinitionKey key;
  key.kind = object.required("kind").string();
  if (const std::optional<Value> name = object.optional("name")) key.name = name->string();
  if (const std::optional<Value> number = object.optional("number")) {
    key.alias = std::to_string(number->integer(1, max_tool_number));
  }
  if (key.name.empty()) key.name = key.alias.value();
  return key;
}

}  // namespace ridgeline::jobs
