#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/recording.hpp"
#include "jobs/refuse.hpp"
#include "jobs/text.hpp"

/// Typed reading of a parsed document. Every refusal is Error{BadInput} that names the field by its
/// JSON pointer, its value and the limit that it breaks.
namespace ridgeline::jobs {

/// Numbers that a field takes, with their unit. NaN and infinities never pass.
struct Range {
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
  std::string_view unit = {};
  bool open_min = false;  ///< min itself is refused
  bool open_max = false;  ///< max itself is refused
};

inline constexpr Range any_number{};
/// min <= number <= max.
constexpr Range between(double min, double max, std::string_view unit) {
  return {min, max, unit, false, false};
}
/// min < number <= max.
constexpr Range above(double min, double max, std::string_view unit) {
  return {min, max, unit, true, false};
}
/// min < number < max.
constexpr Range inside(double min, double max, std::string_view unit) {
  return {min, max, unit, true, true};
}
bool contains(const Range& range, double number);
/// E.g. "greater than 0 and at most 1000 mm".
std::string text(const Range& range);

template <class E>
struct Choice {
  std::string_view name;
  E value;
};
/// The names of an enumeration in documents, e.g. {{"inner", EdgeKind::Inner}, ...}.
template <class E, std::size_t n>
using Choices = std::array<Choice<E>, n>;

/// The name of a value in its table; the table holds every value.
template <class E, std::size_t n>
std::string_view name_of(const Choices<E, n>& choices, E value) {
  for (const Choice<E>& choice : choices)
    if (choice.value == value) return choice.name;
  throw Error(ErrorCode::Internal, "a value without a name in its table");
}

class Object;

/// One value of a document and where it stands.
class Value {
public:
  /// The document outlives the Value.
  explicit Value(const nlohmann::json& json, std::string pointer = {})
      : json_(&json), pointer_(std::move(pointer)) {}

  const nlohmann::json& json() const { return *json_; }
  const std::string& pointer() const { return pointer_; }
  /// The value as text for a message, shortened.
  std::string shown() const;
  /// Refuses this value: it must be `limit`.
  [[noreturn]] void refuse(std::string_view limit) const;

  double number(const Range& range = {}) const;
  /// A number, or a string that holds nothing but one, e.g. "-1.25".
  double number_or_text(const Range& range = {}) const;
  /// A whole number (8000 and 8e3 alike).
  int integer(int min, int max) const;
  bool boolean() const;
  bool is_null() const;
  /// Is it this word? Otherwise it may be something else.
  bool is_word(std::string_view word) const;
  /// Any string, e.g. a program.
  const std::string& string() const;
  /// A string of 1 to 64 bytes of valid UTF-8 without control characters.
  const std::string& name() const;
  /// One of the names; see Choices.
  template <class E, std::size_t n>
  E choice(const Choices<E, n>& choices) const {
    std::array<std::string_view, n> names;
    for (std::size_t i = 0; i < n; ++i) names[i] = choices[i].name;
    note_words(names);
    if (json_->is_string())
      for (const Choice<E>& choice : choices)
        if (choice.name == json_->get_ref<const std::string&>()) return choice.value;
    refuse(alternatives(names));
  }
  /// [x, y, z], each in the range.
  Eigen::Vector3d vector3(const Range& range = {}) const;
  /// [i, j, k] of any length but 0, made a unit vector.
  Eigen::Vector3d direction() const;
  /// An array of numbers.
  std::vector<double> numbers(const Range& range = {}) const;
  /// The values of an array of min_size to max_size.
  std::vector<Value> array(std::size_t min_size = 0,
                           std::size_t max_size = std::numeric_limits<std::size_t>::max()) const;
  Object object() const;

private:
  friend class Object;
  void note_words(std::span<const std::string_view> words) const;
  Value at(std::size_t index) const;
  const nlohmann::json* json_;
  std::string pointer_;
};

/// An object of a document: hands out its members by key and then refuses, in finish(), those that
/// nobody asked for.
class Object {
public:
  explicit Object(const Value& value);

  const std::string& pointer() const { return value_.pointer(); }
  const Value& value() const { return value_; }

  /// Is there such a member? The key counts as known from then on.
  bool has(std::string_view key);
  /// Throws when there is none.
  Value required(std::string_view key);
  std::optional<Value> optional(std::string_view key);

  // The common cases: required; with a default; optional.
  double number(std::string_view key, const Range& range);
  double number(std::string_view key, const Range& range, double otherwise);
  std::optional<double> optional_number(std::string_view key, const Range& range);
  int integer(std::string_view key, int min, int max, int otherwise);
  template <class E, std::size_t n>
  E choice(std::string_view key, const Choices<E, n>& choices, E otherwise) {
    const std::optional<Value> value = optional(key);
    if (value) return value->choice(choices);
    if (Recording::current() != nullptr) {
      std::array<std::string_view, n> names;
      for (std::size_t i = 0; i < n; ++i) names[i] = choices[i].name;
      Value(value_.json(), pointer_of(key)).note_words(names);
      note_default(key, name_of(choices, otherwise));
    }
    return otherwise;
  }
  bool boolean(std::string_view key, bool otherwise);

  /// Refuses the object because of its member `key`, there or not.
  [[noreturn]] void refuse(std::string_view key, std::string_view limit) const;
  /// At most one of the two keys may be there.
  void exclude(std::string_view key, std::string_view other);
  /// Refuses members that were never asked for. Call it when all has been read.
  void finish() const;

private:
  void note_default(std::string_view key, const nlohmann::json& otherwise) const;
  std::string pointer_of(std::string_view key) const;
  Value value_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace ridgeline::jobs
