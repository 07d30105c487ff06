#include "service/job_kind.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "jobs/parse.hpp"

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;

/// Reads up to the member "job" of the outermost object.
class KindReader : public nlohmann::json_sax<Json> {
public:
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool string(string_t& text) override {
    if (is_kind_) kind = text;
    return value();
  }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& key) override {
    is_kind_ = depth_ == 1 && key == "job";
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;  // whoever reads the whole document says what is wrong
  }

  std::string kind;

private:
  bool value() const { return !is_kind_; }  // false ends the reading
  bool open() {
    ++depth_;
    return value();
  }
  bool close() {
    --depth_;
    return true;
  }

  int depth_ = 0;
  bool is_kind_ = false;
};

/// The text of a member; empty when there is none.
std::string_view text_of(const Json& document, const char* key) {
  const auto member = document.find(key);
  if (member == document.end() || !member->is_string()) return {};
  return member->get_ref<const std::string&>();
}

}  // namespace

std::string job_kind(std::string_view document) {
  KindReader reader;
  Json::sax_parse(document, &reader);
  return reader.kind;
}

bool is_change(const Json& document) {
  if (!document.is_object()) return false;
  const std::string_view operation = text_of(document, "operation");
  constexpr std::array<std::string_view, 3> library{"put", "remove", "import"};
  if (text_of(document, "job") == "library") {
    return std::ranges::find(library, operation) != library.end();
  }
  return text_of(document, "job") == "service" && operation == "log_level";
}

bool asks_for_change(std::string_view document) {
  const std::string kind = job_kind(document);
  if (kind != "library" && kind != "service") return false;
  try {
    return is_change(jobs::parse(document));
  } catch (const Error&) {
    return false;  // the service says what is wrong with it
  }
}

}  // namespace ridgeline::service
