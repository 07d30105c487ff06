#include <algorithm>
#include <sstream>

#include "core/base/text.hpp"
#include "jobs/reader.hpp"
#include "tests/schema/schema.hpp"

namespace ridgeline::schema {
namespace {

using jobs::Reading;
using jobs::Record;
using Type = Reading::Type;

/// One key of a definition and where it stands: "output/decimals", "holes/*/radius".
struct Key {
  std::string path;
  const Record::Member* member = nullptr;
  bool is_required = false;
};

void collect(const Record& record, const std::string& path, std::vector<Key>& keys) {
  for (const Record::Member& member : record.members) {
    const std::string at = path.empty() ? member.key : path + "/" + member.key;
    keys.push_back({at, &member, member.required == record.visits && record.visits > 0});
    collect(*member.value, at, keys);
  }
  if (record.each) collect(*record.each, path + "/*", keys);
}

std::vector<Key> keys_of(const Record& record) {
  std::vector<Key> keys;
  collect(record, {}, keys);
  return keys;
}

std::string limits_of(const Reading& reading) {
  const jobs::Range range{reading.min, reading.max, reading.unit, reading.open_min,
                          reading.open_max};
  const std::string text = jobs::text(range);
  return text == "a finite number" ? (reading.unit.empty() ? "" : reading.unit) : text;
}

std::string joined(std::vector<std::string> parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts)
    if (!part.empty()) text += (text.empty() ? "" : separator) + part;
  return text;
}

std::string type_of(const Record& record);

std::string type_of(const Reading& reading, const Record& record) {
  switch (reading.type) {
    case Type::Number: return joined({"number", limits_of(reading)}, " ");
    case Type::NumberOrText: return joined({"number or its text", limits_of(reading)}, ", ");
    case Type::Integer: return joined({"whole number", limits_of(reading)}, " ");
    case Type::Boolean: return "true or false";
    case Type::String: return "text";
    case Type::Name: return "name";
    case Type::Null: return "null";
    case Type::Vector: return joined({"[x, y, z]", limits_of(reading)}, ", each ");
    case Type::Direction: return "direction [i, j, k]";
    case Type::Numbers: return joined({"numbers", limits_of(reading)}, ", each ");
    case Type::Object: return record.each && record.members.empty() ? "object by key" : "object";
    case Type::Words: {
      std::string words;
      for (const std::string& word : reading.words)
        words += (words.empty() ? "`" : ", `") + word + "`";
      return words;
    }
    case Type::Array: {
      const std::string of = record.each ? type_of(*record.each) : std::string();
      return of.empty() || of == "object" ? "list" : "list of (" + of + ")";
    }
  }
  return {};
}

std::string type_of(const Record& record) {
  std::vector<std::string> types;
  for (const std::string& definition : record.definitions)
    types.push_back("[" + definition + "](#" + definition + ")");
  for (const Reading& reading : record.readings)
    if (is_shown(reading, record)) types.push_back(type_of(reading, record));
  return joined(types, "; ");
}

std::string default_of(const Key& key) {
  if (key.is_required) return "required";
  const auto& otherwise = key.member->otherwise;
  if (!otherwise || otherwise->is_null()) return "";
  return "`" + (otherwise->is_number() ? text(otherwise->get<double>()) : otherwise->dump()) + "`";
}

void write_definition(const std::string& name, const Record& record,
                      const nlohmann::ordered_json& known, std::ostringstream& page) {
  page << "\n## " << name << "\n\n" << known.value("", "") << "\n\n";
  if (!record.members.empty() && record.readings.size() > 1)
    page << "Given as: " << type_of(record) << ".\n\n";
  page << "| key | takes | default | meaning |\n|---|---|---|---|\n";
  for (const Key& key : keys_of(record)) {
    const std::string meaning = known.value(key.path, "");
    const bool is_alias = meaning.starts_with("= ");
    const std::string takes = key.path == "job" || key.path == known.value("is", "")
                                  ? "`" + word_of(name) + "`"
                              : is_alias ? "as `" + meaning.substr(2) + "`"
                                         : type_of(*key.member->value);
    page << "| `" << key.path << "` | " << takes << " | " << default_of(key) << " | "
         << (is_alias ? "" : meaning) << " |\n";
  }
}

}  // namespace

std::string word_of(const std::string& definition) {
  const std::string elsewhere = "along_";
  return definition.starts_with(elsewhere) ? definition.substr(elsewhere.size()) : definition;
}

bool is_shown(const Reading& reading, const Record& record) {
  const auto has = [&record](Type type) {
    return std::ranges::find(record.readings, type, &Reading::type) != record.readings.end();
  };
  return !(reading.type == Type::Words && has(Type::String)) &&
         !(reading.type == Type::Vector && has(Type::Direction));
}

std::string reference(const jobs::Recording& recording, const Descriptions& descriptions) {
  std::ostringstream page;
  page
      << "# Jobs and definitions, key by key\n\n"
         "Made by `scripts/reference` from what the program's own readers ask for, as is\n"
         "[the JSON Schema](schema/ridgeline.schema.json); a test holds both to the program. A key "
         "that is not here is refused. Lengths mm,\n"
         "angles degrees, feeds mm/min, speeds rev/min, forces N. `a/b` is the key `b` of the "
         "object `a`, `*` each element of a list or any key.\n"
         "Where a limit hangs on another value, none is stated here: the refusal names it.\n\n";
  for (const auto& [name, known] : descriptions.items())
    page << "[" << name << "](#" << name << ") ";
  page << "\n";
  for (const auto& [name, known] : descriptions.items())
    write_definition(name, recording.definitions.at(name), known, page);
  return page.str();
}

std::string gaps(const jobs::Recording& recording, const Descriptions& descriptions) {
  std::string lines;
  for (const auto& [name, record] : recording.definitions) {
    if (name.empty()) continue;
    if (!descriptions.contains(name)) lines += "no descriptions of " + name + "\n";
    const nlohmann::ordered_json known =
        descriptions.contains(name) ? descriptions.at(name) : nlohmann::ordered_json::object();
    std::vector<std::string> paths = {"", "is"};
    for (const Key& key : keys_of(record)) {
      paths.push_back(key.path);
      const bool is_word = key.path == "job" || key.path == known.value("is", "");
      if (!is_word && !known.contains(key.path)) lines += name + ": \"" + key.path + "\": \"\",\n";
      const std::string meaning = known.value(key.path, "");
      const bool is_alias = meaning.starts_with("= ") || meaning.ends_with("not read");
      if (!is_word && !is_alias && key.member->value->readings.empty() &&
          key.member->value->definitions.empty())
        lines += name + " " + key.path + ": no sample gives it\n";
    }
    for (const auto& [path, text] : known.items())
      if (std::ranges::find(paths, path) == paths.end())
        lines += name + " " + path + ": described, but nobody reads it\n";
  }
  return lines;
}

}  // namespace ridgeline::schema
