#include "jobs/part.hpp"

#include <algorithm>
#include <list>
#include <mutex>

#include "jobs/part_mouths.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_shape.hpp"
#include "part/isolate.hpp"
#include "part/product.hpp"
#include "part/step.hpp"

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

/// An Error of the child, from its error object.
[[noreturn]] void rethrow(const Json& error, const std::string& field) {
  ErrorDetails details;
  details.field = field;
  details.value = error.value("value", "");
  details.limit = error.value("limit", "");
  throw Error(error_code(error.value("code", "")).value_or(ErrorCode::Internal),
              error.value("message", ""), details);
}

/// What `read` makes of a file, in a process of its own or from memory.
Json read_isolated(const Value& step, const std::string& how, const Progress& progress,
                   const std::function<Json()>& read) {
  static Memory memory;
  const std::string key = how + "\n" + step.string();
  if (std::optional<Json> known = memory.find(key)) return *std::move(known);
  part::prepare();
  const std::string text = part::isolated(
      [&] {
        try {
          return read().dump(-1, ' ', false, Json::error_handler_t::replace);
        } catch (const Error& error) {
          return refusal(error).document.dump(-1, ' ', false, Json::error_handler_t::replace);
        }
      },
      progress);
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded())
    throw Error(ErrorCode::Internal, "the part reader answered no document");
  if (document.contains("error")) rethrow(document["error"], step.pointer());
  memory.keep(key, document);
  return document;
}

std::optional<part::GivenAxis> read_axis(const std::optional<Value>& axis) {
  if (!axis) return std::nullopt;
  if (axis->json().is_array()) return part::GivenAxis{{}, axis->direction()};
  Object object(*axis);
  part::GivenAxis given;
  given.direction = object.required("direction").direction();
  if (const auto point = object.optional("point")) given.point = point->vector3(section_range);
  object.finish();
  return given;
}

Json placement_document(const geometry::Frame& frame) {
  return {{"origin", vector_document(frame.origin)},
          {"x", vector_document(frame.axes.col(0))},
          {"y", vector_document(frame.axes.col(1))},
          {"z", vector_document(frame.axes.col(2))}};
}

Part part_of(const Json& document) {
  return {read_product(Value(document.at("product"), "/product")), document.at("placement")};
}

}  // namespace

Part part_of_step(const Value& step, const std::optional<Value>& axis, const Progress& progress) {
  const std::optional<part::GivenAxis> given = read_axis(axis);
  const std::string how = "product" + (axis ? axis->json().dump() : std::string());
  return part_of(read_isolated(step, how, progress, [&]() -> Json {
    const part::TurnedPart found = part::read_product(step.string(), given);
    return {{"product", product_document(found.product)},
            {"placement", placement_document(found.placement)}};
  }));
}

units::Region stock_of_step(const Value& step, const Progress& progress) {
  const Json document = read_isolated(step, "stock", progress, [&]() -> Json {
    return {{"shape", region_document(part::read_stock(step.string()))}};
  });
  return read_region(Value(document.at("shape"), step.pointer()));
}

Json mouths_of_step(const Value& step, const Progress& progress) {
  return read_isolated(step, "mouths", progress, [&] {
    const std::vector<part::Solid> solids = part::read_step(step.string());
    const auto largest = std::ranges::max_element(
        solids, {}, [](const part::Solid& solid) { return solid.model().volume; });
    return mouths_document(largest->model());
  });
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
