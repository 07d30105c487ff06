#include "jobs/parse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "jobs/refuse.hpp"
#include "jobs/text.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};

/// Line and column, from 1, of the byte at `offset`.
Place place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::size_t last = before.rfind('\n');
  return {1 + static_cast<std::size_t>(std::ranges::count(before, '\n')),
          last == std::string_view::npos ? before.size() + 1 : before.size() - last};
}

/// Builds the document from the events of nlohmann's parser, which keeps its own stack on the heap:
/// depth and repeated keys are refused as they come, before anything is built from them.
class Builder {
public:
  explicit Builder(std::string_view text) : text_(text) {}

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Json::number_integer_t value) { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
  bool number_float(Json::number_float_t value, const Json::string_t& literal) {
    if (!std::isfinite(value)) refuse_number(literal);
    return add(value);
  }
  bool string(Json::string_t& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { throw Error(ErrorCode::Internal, "JSON text has no binary"); }

  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(Json::string_t& key) {
    Level& level = levels_.back();
    level.key = key;
    if (!level.value->contains(key)) return true;
    refuse({.field = pointer(),
            .value = key,
            .limit = "each key once",
            .message = shortened(pointer()) + " is given twice"});
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) {
    constexpr int number_overflow = 406;  // nlohmann's out_of_range for 1e999
    if (error.id == number_overflow) refuse_number(token);
    const Place place = place_of(text_, position == 0 ? 0 : position - 1);
    const std::string read = shortened(token, 40);
    refuse({.field = pointer(),
            .value = read,
            .limit = "JSON text (RFC 8259)",
            .message = "not JSON: line " + std::to_string(place.line) + ", column " +
                       std::to_string(place.column) +
                       (read.empty() ? std::string(": the text ends too early")
                                     : ": unexpected text, last read \"" + read + "\"")});
  }

  Json take() { return std::move(root_); }

private:
  struct Level {
    Json* value;      ///< the open object or array
    std::string key;  ///< of the member being read
  };

  /// JSON pointer of the value being read.
  std::string pointer() const {
    std::string path;
    for (const Level& level : levels_) {
      path += "/" + (level.value->is_object() ? pointer_token(shortened(level.key))
                                              : std::to_string(level.value->size()));
    }
    return path;
  }

  [[noreturn]] void refuse_number(const std::string& literal) const {
    refuse({.field = pointer(), .value = literal, .limit = "a number within +-1.8e308"});
  }

  Json* place(Json&& value) {
    if (levels_.empty()) return &(root_ = std::move(value));
    Level& level = levels_.back();
    if (level.value->is_array()) return &level.value->emplace_back(std::move(value));
    return &((*level.value)[level.key] = std::move(value));
  }
  bool add(Json&& value) {
    place(std::move(value));
    return true;
  }
  bool open(Json&& value) {
    if (levels_.size() == max_document_levels) {
      refuse({.field = pointer(),
              .value = "deeper",
              .limit = "at most " + std::to_string(max_document_levels) + " levels deep",
              .message = "the document is nested more than " + std::to_string(max_document_levels) +
                         " levels deep"});
    }
    Json* placed = place(std::move(value));
    levels_.push_back({placed, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  Json root_;
  std::vector<Level> levels_;
};

/// The characters of a text, which look for a cancel as they are read.
class Reader {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Reader(std::string_view text, std::size_t at, const Progress& progress)
      : text_(text), at_(at), progress_(&progress) {}

  reference operator*() const { return text_[at_]; }
  Reader& operator++() {
    constexpr std::size_t between_looks = 1 << 20;
    if (++at_ % between_looks == 0) progress_->at(0, "parsing");
    return *this;
  }
  friend bool operator==(const Reader& a, const Reader& b) { return a.at_ == b.at_; }

private:
  std::string_view text_;
  std::size_t at_;
  const Progress* progress_;
};

}  // namespace

nlohmann::json parse(std::string_view text, const Progress& progress) {
  if (text.size() > max_document_bytes) {
    refuse({.value = std::to_string(text.size()) + " bytes",
            .limit = "at most " + std::to_string(max_document_bytes) + " bytes"});
  }
  Builder builder(text);
  Json::sax_parse(Reader(text, 0, progress), Reader(text, text.size(), progress), &builder);
  return builder.take();
}

}  // namespace ridgeline::jobs
