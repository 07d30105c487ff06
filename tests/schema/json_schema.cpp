#include "jobs/reader.hpp"
#include "tests/schema/schema.hpp"

namespace ridgeline::schema {
namespace {

using Json = nlohmann::ordered_json;
using jobs::Reading;
using jobs::Record;
using Type = Reading::Type;

constexpr jobs::Range unlimited;

void add_limits(const Reading& reading, Json& schema) {
  if (reading.min != unlimited.min)
    schema[reading.open_min ? "exclusiveMinimum" : "minimum"] = reading.min;
  if (reading.max != unlimited.max)
    schema[reading.open_max ? "exclusiveMaximum" : "maximum"] = reading.max;
  if (!reading.unit.empty()) schema["unit"] = reading.unit;
}

Json number_of(const Reading& reading, Json schema) {
  add_limits(reading, schema);
  return schema;
}

Json vector_of(const Reading& reading) {
  return {{"type", "array"},
          {"items", number_of(reading, {{"type", "number"}})},
          {"minItems", 3},
          {"maxItems", 3}};
}

/// The schema of places below a definition, with the descriptions of their keys.
class Writer {
public:
  Writer(std::string definition, const Descriptions& descriptions)
      : definition_(std::move(definition)), descriptions_(descriptions) {}

  Json schema_of(const Record& record, const std::string& path) const {
    Json alternatives = Json::array();
    for (const std::string& name : record.definitions)
      alternatives.push_back({{"$ref", "#/$defs/" + name}});
    for (const Reading& reading : record.readings)
      if (is_shown(reading, record)) alternatives.push_back(schema_of(reading, record, path));
    if (alternatives.empty()) return Json::object();
    return alternatives.size() == 1 ? alternatives[0] : Json{{"anyOf", alternatives}};
  }

private:
  Json schema_of(const Reading& reading, const Record& record, const std::string& path) const {
    switch (reading.type) {
      case Type::Number: return number_of(reading, {{"type", "number"}});
      case Type::NumberOrText: return number_of(reading, {{"type", {"number", "string"}}});
      case Type::Integer: return number_of(reading, {{"type", "integer"}});
      case Type::Boolean: return {{"type", "boolean"}};
      case Type::String: return {{"type", "string"}};
      case Type::Name: return {{"type", "string"}, {"minLength", 1}, {"maxLength", 64}};
      case Type::Words: return {{"enum", reading.words}};
      case Type::Null: return {{"type", "null"}};
      case Type::Vector:
      case Type::Direction: return vector_of(reading);
      case Type::Numbers:
        return {{"type", "array"}, {"items", number_of(reading, {{"type", "number"}})}};
      case Type::Array: return array_of(reading, record, path);
      case Type::Object: return object_of(record, path);
    }
    return {};
  }

  /// What takes the place of a key that is another name of its neighbour: "= width".
  static const Record& same_as(const Record& record, const Record::Member& member,
                               const std::string& description) {
    if (!description.starts_with("= ")) return *member.value;
    for (const Record::Member& other : record.members)
      if (other.key == description.substr(2)) return *other.value;
    throw std::runtime_error(member.key + " " + description + ": there is no such key beside it");
  }

  Json array_of(const Reading& reading, const Record& record, const std::string& path) const {
    Json schema = {{"type", "array"}};
    if (reading.min > 0) schema["minItems"] = static_cast<std::uint64_t>(reading.min);
    if (reading.max != unlimited.max && reading.max >= 0)
      schema["maxItems"] = static_cast<std::uint64_t>(reading.max);
    if (record.each) schema["items"] = schema_of(*record.each, path + "*");
    return schema;
  }

  Json object_of(const Record& record, const std::string& path) const {
    Json schema = {{"type", "object"}};
    Json required = Json::array();
    for (const Record::Member& member : record.members) {
      const std::string at = path.empty() ? member.key : path + "/" + member.key;
      const Json& known = descriptions_.at(definition_);
      Json value = schema_of(same_as(record, member, known.value(at, "")), at);
      if (at == "job" || at == known.value("is", "")) value = {{"const", word_of(definition_)}};
      if (known.contains(at)) value["description"] = known.at(at);
      if (member.otherwise && !member.otherwise->is_null()) value["default"] = *member.otherwise;
      schema["properties"][member.key] = std::move(value);
      if (member.required == record.visits) required.push_back(member.key);
    }
    if (!required.empty()) schema["required"] = std::move(required);
    if (record.each)
      schema["additionalProperties"] = schema_of(*record.each, path + "/*");
    else if (record.visits > 0 && record.finished == record.visits)
      schema["additionalProperties"] = false;
    return schema;
  }

  std::string definition_;
  const Descriptions& descriptions_;
};

/// Documents are told apart by a word.
Json when(const char* key, const std::string& word, Json then) {
  return {{"if", {{"properties", {{key, {{"const", word}}}}}, {"required", {key}}}},
          {"then", std::move(then)}};
}

}  // namespace

Json json_schema(const jobs::Recording& recording, const Descriptions& descriptions) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Job files and definitions of Ridgeline"},
                 {"type", "object"},
                 {"anyOf", {{{"required", {"job"}}}, {{"required", {"kind"}}}}}};
  Json jobs = Json::array(), kinds = Json::array(), cases = Json::array();
  for (const auto& [name, record] : recording.definitions) {
    if (name.empty()) continue;
    const Json& described = descriptions.at(name);
    Json definition = Writer(name, descriptions).schema_of(record, {});
    if (described.contains("")) definition["description"] = described.at("");
    schema["$defs"][name] = std::move(definition);
    const Json reference = {{"$ref", "#/$defs/" + name}};
    if (described.value("is", "") == "job") {
      jobs.push_back(name);
      cases.push_back(when("job", name, reference));
    } else if (described.value("is", "") == "kind") {
      kinds.push_back(name);
      cases.push_back(when("kind", name, reference));
    }
  }
  schema["properties"] = {{"job", {{"enum", jobs}}}, {"kind", {{"enum", kinds}}}};
  schema["allOf"] = std::move(cases);
  return schema;
}

}  // namespace ridgeline::schema
