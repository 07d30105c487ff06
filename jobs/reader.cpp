#include "jobs/reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
constexpr auto replace_invalid = Json::error_handler_t::replace;
constexpr std::size_t max_name_bytes = 64;

std::string_view kind_of(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: return "an object";
    case Json::value_t::array: return "an array";
    default: return "a value";
  }
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

void note(const std::string& pointer, Reading::Type type, const Range& range = {}) {
  if (Recording* recording = Recording::current()) {
    recording->read(pointer, reading_of(type, range));
  }
}

/// An array is noted with its sizes.
Range sizes(std::size_t min, std::size_t max) {
  const bool is_limited = max != std::numeric_limits<std::size_t>::max();
  return {static_cast<double>(min), is_limited ? static_cast<double>(max) : Range{}.max, {}};
}

}  // namespace

bool contains(const Range& range, double number) {
  const bool above_min = range.open_min ? number > range.min : number >= range.min;
  const bool below_max = range.open_max ? number < range.max : number <= range.max;
  return above_min && below_max;
}

std::string text(const Range& range) {
  const bool has_min = range.min != std::numeric_limits<double>::lowest();
  const bool has_max = range.max != std::numeric_limits<double>::max();
  if (!has_min && !has_max) return "a finite number";
  std::string limit;
  if (has_min) limit = (range.open_min ? "greater than " : "at least ") + text(range.min);
  if (has_min && has_max) limit += " and ";
  if (has_max) limit += (range.open_max ? "less than " : "at most ") + text(range.max);
  return range.unit.empty() ? limit : limit + " " + std::string(range.unit);
}

std::string Value::shown() const {
  // A large array or object is not worth its text: say what it is.
  if (json_->is_structured() && json_->size() > 8) {
    return std::string(kind_of(*json_)) + " of " + std::to_string(json_->size());
  }
  return shortened(json_->dump(-1, ' ', false, replace_invalid));
}

void Value::refuse(std::string_view limit) const {
  jobs::refuse({.field = pointer_, .value = shown(), .limit = std::string(limit)});
}

double Value::number(const Range& range) const {
  note(pointer_, Reading::Type::Number, range);
  if (!json_->is_number()) refuse("a number " + text(range));
  const double number = json_->get<double>();
  if (!contains(range, number)) refuse(text(range));
  return number;
}

double Value::number_or_text(const Range& range) const {
  note(pointer_, Reading::Type::NumberOrText, range);
  if (!json_->is_string()) return number(range);
  std::string_view literal = json_->get_ref<const std::string&>();
  if (literal.starts_with('+')) literal.remove_prefix(1);
  double number = 0;
  const auto [end, error] =
      std::from_chars(literal.data(), literal.data() + literal.size(), number);
  if (error != std::errc() || end != literal.data() + literal.size() || !contains(range, number)) {
    refuse("a number " + text(range));
  }
  return number;
}

int Value::integer(int min, int max) const {
  note(pointer_, Reading::Type::Integer, between(min, max, {}));
  const double number = json_->is_number() ? json_->get<double>() : std::nan("");
  if (!(number >= min && number <= max && std::trunc(number) == number)) {
    refuse("a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return static_cast<int>(number);
}

void Value::note_words(std::span<const std::string_view> words) const {
  Recording* recording = Recording::current();
  if (recording == nullptr) return;
  Reading reading = reading_of(Reading::Type::Words, any_number);
  reading.words.assign(words.begin(), words.end());
  recording->read(pointer_, std::move(reading));
}

bool Value::is_null() const {
  note(pointer_, Reading::Type::Null);
  return json_->is_null();
}

bool Value::is_word(std::string_view word) const {
  note_words(std::span(&word, 1));
  return json_->is_string() && json_->get_ref<const std::string&>() == word;
}

bool Value::boolean() const {
  note(pointer_, Reading::Type::Boolean);
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

const std::string& Value::string() const {
  note(pointer_, Reading::Type::String);
  if (!json_->is_string()) refuse("a string");
  return json_->get_ref<const std::string&>();
}

const std::string& Value::name() const {
  note(pointer_, Reading::Type::Name);
  const std::string limit =
      "a name of 1 to " + std::to_string(max_name_bytes) + " bytes without control characters";
  if (!json_->is_string()) refuse(limit);
  const std::string& name = json_->get_ref<const std::string&>();
  if (name.empty() || name.size() > max_name_bytes || std::ranges::any_of(name, is_control) ||
      !is_valid_utf8(name)) {
    refuse(limit);
  }
  return name;
}

Eigen::Vector3d Value::vector3(const Range& range) const {
  note(pointer_, Reading::Type::Vector, range);
  if (!json_->is_array() || json_->size() != 3) refuse("[x, y, z]");
  return {at(0).number(range), at(1).number(range), at(2).number(range)};
}

Eigen::Vector3d Value::direction() const {
  note(pointer_, Reading::Type::Direction);
  const Eigen::Vector3d d = vector3(between(-1e9, 1e9, ""));
  const double length = d.norm();
  if (!(length >= 1e-9)) refuse("a direction [i, j, k] of length at least 1e-9");
  return d / length;
}

std::vector<double> Value::numbers(const Range& range) const {
  note(pointer_, Reading::Type::Numbers, range);
  if (!json_->is_array()) refuse("an array of numbers");
  std::vector<double> numbers;
  numbers.reserve(json_->size());
  for (std::size_t i = 0; i < json_->size(); ++i) {
    const Json& element = (*json_)[i];
    const double number = element.is_number() ? element.get<double>() : std::nan("");
    if (!contains(range, number)) at(i).number(range);  // throws, naming the element
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<Value> Value::array(std::size_t min_size, std::size_t max_size) const {
  note(pointer_, Reading::Type::Array, sizes(min_size, max_size));
  if (!json_->is_array()) refuse("an array");
  if (json_->size() < min_size) {
    refuse("an array of at least " + std::to_string(min_size) + " elements");
  }
  if (json_->size() > max_size) {
    refuse("an array of at most " + std::to_string(max_size) + " elements");
  }
  std::vector<Value> values;
  values.reserve(json_->size());
  for (std::size_t i = 0; i < json_->size(); ++i) values.push_back(at(i));
  return values;
}

Object Value::object() const {
  return Object(*this);
}

Value Value::at(std::size_t index) const {
  return Value((*json_)[index], pointer_ + "/" + std::to_string(index));
}

Object::Object(const Value& value) : value_(value) {
  if (!value.json().is_object()) value.refuse("an object");
  if (Recording* recording = Recording::current()) recording->object(pointer());
}

void Object::note_default(std::string_view key, const nlohmann::json& otherwise) const {
  if (Recording* recording = Recording::current()) recording->otherwise(pointer(), key, otherwise);
}

std::string Object::pointer_of(std::string_view key) const {
  return pointer() + "/" + pointer_token(key);
}

bool Object::has(std::string_view key) {
  known_.emplace(key);
  if (Recording* recording = Recording::current()) recording->member(pointer(), key, false);
  return value_.json().contains(key);
}

Value Object::required(std::string_view key) {
  std::optional<Value> value = optional(key);
  if (Recording* recording = Recording::current()) recording->member(pointer(), key, true);
  if (!value) {
    jobs::refuse({.field = pointer_of(key),
                  .value = "missing",
                  .limit = "given",
                  .message = pointer_of(key) + " is missing"});
  }
  return *std::move(value);
}

std::optional<Value> Object::optional(std::string_view key) {
  known_.emplace(key);
  if (Recording* recording = Recording::current()) recording->member(pointer(), key, false);
  const auto found = value_.json().find(key);
  if (found == value_.json().end()) return std::nullopt;
  return Value(*found, pointer_of(key));
}

double Object::number(std::string_view key, const Range& range) {
  return required(key).number(range);
}

double Object::number(std::string_view key, const Range& range, double otherwise) {
  const std::optional<double> number = optional_number(key, range);
  if (!number && Recording::current() != nullptr) note_default(key, otherwise);
  return number.value_or(otherwise);
}

std::optional<double> Object::optional_number(std::string_view key, const Range& range) {
  const std::optional<Value> value = optional(key);
  if (value) return value->number(range);
  if (Recording::current() != nullptr) note(pointer_of(key), Reading::Type::Number, range);
  return std::nullopt;
}

int Object::integer(std::string_view key, int min, int max, int otherwise) {
  const std::optional<Value> value = optional(key);
  if (value) return value->integer(min, max);
  if (Recording::current() != nullptr) {
    note(pointer_of(key), Reading::Type::Integer, between(min, max, {}));
    note_default(key, otherwise);
  }
  return otherwise;
}

bool Object::boolean(std::string_view key, bool otherwise) {
  const std::optional<Value> value = optional(key);
  if (value) return value->boolean();
  if (Recording::current() != nullptr) {
    note(pointer_of(key), Reading::Type::Boolean);
    note_default(key, otherwise);
  }
  return otherwise;
}

void Object::refuse(std::string_view key, std::string_view limit) const {
  const auto found = value_.json().find(key);
  if (found != value_.json().end()) Value(*found, pointer_of(key)).refuse(limit);
  jobs::refuse({.field = pointer_of(key),
                .value = "missing",
                .limit = std::string(limit),
                .message = pointer_of(key) + " is missing: " + std::string(limit)});
}

void Object::exclude(std::string_view key, std::string_view other) {
  if (has(key) && has(other)) {
    jobs::refuse(
        {.field = pointer_of(other),
         .value = Value(value_.json().at(std::string(other))).shown(),
         .limit = "absent beside " + std::string(key),
         .message = "give " + pointer_of(key) + " or " + pointer_of(other) + ", not both"});
  }
}

void Object::finish() const {
  if (Recording* recording = Recording::current()) recording->finish(pointer());
  for (const auto& [key, member] : value_.json().items()) {
    if (known_.contains(key)) continue;
    const std::vector<std::string> like = nearest(key, {known_.begin(), known_.end()}, 1);
    const std::string hint = like.empty() ? std::string() : ", nearest known: " + like.front();
    jobs::refuse({.field = pointer_of(key),
                  .value = Value(member).shown(),
                  .limit = "a known key" + hint,
                  .message = shortened(pointer_of(key), 200) + " is not a known key" + hint});
  }
}

}  // namespace ridgeline::jobs
