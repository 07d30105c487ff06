#include "jobs/material.hpp"

namespace ridgeline::jobs {
namespace {

constexpr Range per_area = between(0, 1e6, "N/mm2");
constexpr Range per_length = between(0, 1e6, "N/mm");
constexpr Range relative = between(0, 1, "of the value");

constexpr std::size_t longest_source = 400;

std::string read_source(Object& object) {
  const std::optional<Value> source = object.optional("source");
  if (!source) return {};
  if (source->string().size() > longest_source) {
    source->refuse("text of at most " + std::to_string(longest_source) + " bytes");
  }
  return source->string();
}

}  // namespace

cutting::Uncertainty read_uncertainty(const Value& value) {
  Object object(value);
  cutting::Uncertainty uncertainty;
  uncertainty.cutting = object.number("Kc", relative, 0);
  uncertainty.edge = object.number("Ke", relative, 0);
  uncertainty.stiffness = object.number("stiffness", relative, 0);
  object.finish();
  return uncertainty;
}

Material read_material(const Value& value) {
  Object object(value);
  if (const std::optional<Value> kind = object.optional("kind");
      kind && !kind->is_word("material")) {
    kind->refuse("\"material\"");
  }
  Material material;
  if (const std::optional<Value> name = object.optional("name")) material.name = name->name();
  material.coefficients = {.Ktc = object.number("Ktc", per_area),
                           .Kte = object.number("Kte", per_length),
                           .Krc = object.number("Krc", per_area),
                           .Kre = object.number("Kre", per_length),
                           .Kac = object.number("Kac", per_area, 0),
                           .Kae = object.number("Kae", per_length, 0)};
  if (const std::optional<Value> uncertainty = object.optional("uncertainty")) {
    material.uncertainty = read_uncertainty(*uncertainty);
  }
  material.source = read_source(object);
  material.is_estimate = object.boolean("estimate", false);
  object.finish();
  return material;
}

Material find_material(const std::string& name, const std::string& pointer,
                       const Definitions& definitions) {
  if (const std::optional<Definition> found = definitions.find("material", name)) {
    return read_material(Value(found->document, pointer));
  }
  const std::vector<std::string> like = nearest(name, definitions.names("material"));
  std::string exists = like.empty() ? "it has no materials" : "it has";
  for (const std::string& other : like) exists += " \"" + shortened(other) + "\"";
  refuse({.code = ErrorCode::UnknownMaterial,
          .field = pointer,
          .value = name,
          .limit = "in the library; " + exists,
          .message = "the library has no material \"" + shortened(name) + "\"; " + exists});
}

Material resolve_material(const Value& value, const Definitions& definitions) {
  if (value.json().is_object()) return read_material(value);
  if (!value.json().is_string()) value.refuse("a name of the library or a coefficient set");
  return find_material(value.string(), value.pointer(), definitions);
}

nlohmann::json document_of(const Material& material) {
  const tool::Coefficients& k = material.coefficients;
  nlohmann::json document = {{"name", nullptr},   {"estimate", material.is_estimate},
                             {"source", nullptr}, {"Ktc", k.Ktc},
                             {"Krc", k.Krc},      {"Kac", k.Kac},
                             {"Kte", k.Kte},      {"Kre", k.Kre},
                             {"Kae", k.Kae}};
  if (!material.name.empty()) document["name"] = material.name;
  if (!material.source.empty()) document["source"] = material.source;
  return document;
}

}  // namespace ridgeline::jobs
