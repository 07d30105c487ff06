#include "jobs/part.hpp"

#include <list>
#include <mutex>

#include "jobs/step_reader.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

/// The last few files and what was found in them.
class Memory {
public:
  std::optional<Json> find(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (entry->key != key) continue;
      entries_.splice(entries_.begin(), entries_, entry);
      return entries_.front().document;
    }
    return std::nullopt;
  }

  void keep(const std::string& key, const Json& document) {
    if (key.size() > most_bytes / 2) return;
    const std::scoped_lock lock(mutex_);
    entries_.push_front({key, document});
    bytes_ += key.size();
    while (entries_.size() > most_files || bytes_ > most_bytes) {
      bytes_ -= entries_.back().key.size();
      entries_.pop_back();
    }
  }

private:
  static constexpr std::size_t most_files = 16;
  static constexpr std::size_t most_bytes = 32'000'000;
  struct Entry {
    std::string key;
    Json document;
  };
  std::mutex mutex_;
  std::list<Entry> entries_;
  std::size_t bytes_ = 0;
};

/// An Error of the reader, from its error object.
[[noreturn]] void rethrow(const Json& error, const std::string& field) {
  ErrorDetails details;
  details.field = field;
  details.value = error.value("value", "");
  details.limit = error.value("limit", "");
  throw Error(error_code(error.value("code", "")).value_or(ErrorCode::Internal),
              error.value("message", ""), details);
}

/// What is found in a file, by ridgeline-step or from memory. `wish` as in step/reading.hpp.
Json read_file(const Value& step, const Json& wish, const Progress& progress) {
  static Memory memory;
  const std::string key = wish.dump() + "\n" + step.string();
  if (std::optional<Json> known = memory.find(key)) return *std::move(known);
  Json document = read_step_file(wish, step.string(), progress);
  if (document.contains("error")) rethrow(document["error"], step.pointer());
  memory.keep(key, document);
  return document;
}

/// "axis": a direction or {"direction", "point"}.
Json axis_document(const Value& axis) {
  if (axis.json().is_array()) return {{"direction", vector_document(axis.direction())}};
  Object object(axis);
  Json document = {{"direction", vector_document(object.required("direction").direction())}};
  if (const auto point = object.optional("point")) {
    document["point"] = vector_document(point->vector3(section_range));
  }
  object.finish();
  return document;
}

Part part_of(const Json& document) {
  return {read_product(Value(document.at("product"), "/product")), document.at("placement")};
}

}  // namespace

Part part_of_step(const Value& step, const std::optional<Value>& axis, const Progress& progress) {
  Json wish = {{"want", "product"}};
  if (axis) wish["axis"] = axis_document(*axis);
  return part_of(read_file(step, wish, progress));
}

units::Region stock_of_step(const Value& step, const Progress& progress) {
  const Json document = read_file(step, {{"want", "stock"}}, progress);
  return read_region(Value(document.at("shape"), step.pointer()));
}

Json mouths_of_step(const Value& step, const Progress& progress) {
  return read_file(step, {{"want", "mouths"}}, progress);
}

Part part_of_document(const Value& product, const Definitions& definitions) {
  if (!product.json().is_string()) return {read_product(product), nullptr};
  const std::string& name = product.string();
  const std::optional<Definition> found = definitions.find("part", name);
  if (!found) {
    refuse({.code = ErrorCode::UnknownDefinition,
            .field = product.pointer(),
            .value = name,
            .limit = "the name of a part in the library, or part values",
            .message = "the library has no part \"" + shortened(name) +
                       "\"; the service reads no files: their text goes into \"product_step\""});
  }
  Part part = part_of({{"product", found->document.at("product")},
                       {"placement", found->document.value("placement", Json())}});
  if (part.product.name.empty()) part.product.name = name;
  return part;
}

}  // namespace ridgeline::jobs
