#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "jobs/answer.hpp"
#include "jobs/text.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

/// A column of a table description; see Array.
struct Column {
  std::string key;
  std::string quoted_key;          ///< as JSON text
  std::size_t size = 0;            ///< > 0: an array of so many cells
  std::vector<std::string> names;  ///< non-empty: the cell is an index
  std::vector<std::string> quoted_names;
  std::vector<Column> columns;  ///< non-empty: an object
};

std::string json_text(const std::string& text) {
  return Json(valid_utf8(text)).dump();
}

std::vector<Column> read_columns(const Json& description) {
  std::vector<Column> columns;
  for (const Json& each : description.at("columns")) {
    Column column;
    column.key = each.at("key").get<std::string>();
    column.quoted_key = json_text(column.key);
    column.size = each.value("size", std::size_t{0});
    if (each.contains("names")) column.names = each.at("names").get<std::vector<std::string>>();
    for (const std::string& name : column.names) column.quoted_names.push_back(json_text(name));
    if (each.contains("columns")) column.columns = read_columns(each);
    columns.push_back(std::move(column));
  }
  return columns;
}

std::size_t width(const Column& column) {
  if (column.columns.empty()) return std::max<std::size_t>(column.size, 1);
  return std::accumulate(column.columns.begin(), column.columns.end(), std::size_t{0},
                         [](std::size_t sum, const Column& c) { return sum + width(c); });
}

std::size_t name_index(const Column& column, double cell) {
  if (!(cell >= 0 && cell < static_cast<double>(column.names.size()))) {
    throw Error(ErrorCode::Internal, "a table cell without a name in column " + column.key);
  }
  return static_cast<std::size_t>(cell);
}

/// Receives the parts of a document in order: one builds the document, one writes its text.
/// `Sink`: number(double), name(column, index), begin_array/end_array, begin_row/key/end_row.
template <class Sink>
void give_row(Sink& sink, const std::vector<Column>& columns, const double* cell) {
  sink.begin_row();
  for (const Column& column : columns) {
    if (!std::isnan(*cell)) {
      sink.key(column);
      if (!column.columns.empty()) {
        give_row(sink, column.columns, cell);
      } else if (!column.names.empty()) {
        sink.name(column, name_index(column, *cell));
      } else if (column.size > 0) {
        sink.begin_array();
        for (std::size_t i = 0; i < column.size; ++i) sink.number(cell[i]);
        sink.end_array();
      } else {
        sink.number(*cell);
      }
    }
    cell += width(column);
  }
  sink.end_row();
}

template <class Sink>
void give_numbers(Sink& sink, std::span<const std::size_t> shape, const double*& cell) {
  sink.begin_array();
  for (std::size_t i = 0; i < shape.front(); ++i) {
    if (shape.size() == 1) {
      sink.number(*cell++);
    } else {
      give_numbers(sink, shape.subspan(1), cell);
    }
  }
  sink.end_array();
}

/// An array with its table description, if it has one. Throws Error{Internal} when the shape does
/// not hold the values.
struct Placed {
  const Array* array = nullptr;
  std::vector<Column> columns;
};

Placed placed(const Array& array, const Json& document) {
  const std::size_t count =
      std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>());
  if (array.shape.empty() || count != array.values.size()) {
    throw Error(ErrorCode::Internal, "the shape of " + array.pointer + " does not hold its values");
  }
  Placed result{&array, {}};
  const Json::json_pointer pointer(array.pointer);
  if (!document.contains(pointer)) return result;
  result.columns = read_columns(document.at(pointer));
  std::size_t cells = 0;
  for (const Column& column : result.columns) cells += width(column);
  if (array.shape.size() != 2 || array.shape[1] != cells) {
    throw Error(ErrorCode::Internal, "the rows of " + array.pointer + " do not fit its columns");
  }
  return result;
}

template <class Sink>
void give(Sink& sink, const Placed& placed) {
  const double* cell = placed.array->values.data();
  if (placed.columns.empty()) return give_numbers(sink, placed.array->shape, cell);
  sink.begin_rows();
  for (std::size_t i = 0; i < placed.array->shape[0]; ++i, cell += placed.array->shape[1]) {
    give_row(sink, placed.columns, cell);
  }
  sink.end_array();
}

/// Builds the values of an array as a document.
class DomSink {
public:
  void number(double value) { put(std::isfinite(value) ? Json(value) : Json()); }
  void name(const Column& column, std::size_t index) { put(column.names[index]); }
  void begin_array() { open(Json::array()); }
  void begin_rows() { open(Json::array()); }
  void end_array() { open_.pop_back(); }
  void begin_row() { open(Json::object()); }
  void key(const Column& column) { key_ = column.key; }
  void end_row() { open_.pop_back(); }
  Json take() { return std::move(root_); }

private:
  Json* put(Json&& value) {
    if (open_.empty()) return &(root_ = std::move(value));
    if (open_.back()->is_array()) return &open_.back()->emplace_back(std::move(value));
    return &((*open_.back())[key_] = std::move(value));
  }
  void open(Json&& value) { open_.push_back(put(std::move(value))); }

  Json root_;
  std::vector<Json*> open_;
  std::string key_;
};

/// Writes values as text: arrays of numbers on one line, rows and nested arrays one a line.
class TextSink {
public:
  TextSink(std::string& out, std::size_t indent) : out_(out), line_(1, '\n') {
    line_.append(indent, ' ');
  }
  void number(double value) {
    separate();
    if (!std::isfinite(value)) {
      out_ += "null";
      return;
    }
    std::array<char, 32> buffer;
    out_.append(buffer.data(), std::to_chars(buffer.begin(), buffer.end(), value).ptr);
  }
  void name(const Column& column, std::size_t index) {
    separate();
    out_ += column.quoted_names[index];
  }
  void begin_array() {
    if (depth_ > 0 && rows_ == 0) break_line();
    separate();
    open('[');
  }
  void begin_rows() {
    open('[');
    rows_ = 1;
  }
  void end_array() { close(']'); }
  void begin_row() {
    if (depth_ == 1) break_line();
    separate();
    open('{');
  }
  void key(const Column& column) {
    separate();
    out_ += column.quoted_key;
    out_ += ':';
    fresh_ = true;
  }
  void end_row() { close('}'); }

private:
  void separate() {
    if (!fresh_) out_ += ',';
    fresh_ = false;
  }
  void break_line() {
    if (!fresh_) out_ += ',';
    fresh_ = true;
    out_ += line_;
  }
  void open(char bracket) {
    out_ += bracket;
    fresh_ = true;
    ++depth_;
  }
  void close(char bracket) {
    out_ += bracket;
    fresh_ = false;
    --depth_;
  }

  std::string& out_;
  std::string line_;
  std::size_t depth_ = 0;
  std::size_t rows_ = 0;  ///< 1 in a table: only its rows begin a line
  bool fresh_ = true;     ///< nothing to separate from
};

/// The members of a document that are arrays in the Answer, by the pointer of their object.
using Members = std::multimap<std::string, std::pair<std::string, Placed>>;

bool is_plain(const Json& json) {
  for (const Json& element : json) {
    if (element.is_structured()) return false;
  }
  return true;
}

class Writer {
public:
  explicit Writer(const Members& members) : members_(members) {}

  void write(const Json& json, const std::string& pointer, std::size_t indent) {
    if (json.is_object()) {
      write_object(json, pointer, indent);
    } else if (json.is_array()) {
      write_array(json, pointer, indent);
    } else {
      out_ += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
  }
  std::string take() { return std::move(out_); }

private:
  void write_object(const Json& json, const std::string& pointer, std::size_t indent) {
    out_ += '{';
    bool first = true;
    const auto begin = [&](const std::string& key) {
      out_ += first ? "\n" : ",\n";
      out_.append(indent + 2, ' ');
      out_ += json_text(key) + ": ";
      first = false;
    };
    const auto [from, to] = members_.equal_range(pointer);
    for (const auto& [key, member] : json.items()) {
      const std::string path = pointer + "/" + pointer_token(key);
      bool is_table = false;
      for (auto it = from; it != to; ++it) is_table = is_table || it->second.first == key;
      if (is_table) continue;
      begin(key);
      write(member, path, indent + 2);
    }
    for (auto it = from; it != to; ++it) {
      begin(it->second.first);
      TextSink sink(out_, indent + 4);
      give(sink, it->second.second);
    }
    if (!first) {
      out_ += '\n';
      out_.append(indent, ' ');
    }
    out_ += '}';
  }

  void write_array(const Json& json, const std::string& pointer, std::size_t indent) {
    const bool on_one_line = is_plain(json);
    out_ += '[';
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (i > 0) out_ += on_one_line ? ", " : ",";
      if (!on_one_line) {
        out_ += '\n';
        out_.append(indent + 2, ' ');
      }
      write(json[i], pointer + "/" + std::to_string(i), indent + 2);
    }
    if (!on_one_line) {
      out_ += '\n';
      out_.append(indent, ' ');
    }
    out_ += ']';
  }

  const Members& members_;
  std::string out_;
};

}  // namespace

bool is_error(const Answer& answer) {
  return answer.document.is_object() && answer.document.value("status", "") == "error";
}

Answer refusal(const Error& error) {
  const ErrorDetails& details = error.details();
  Json object = {{"code", name(error.code())}, {"message", valid_utf8(error.what())}};
  if (!details.field.empty()) object["field"] = valid_utf8(details.field);
  if (!details.value.empty()) object["value"] = valid_utf8(details.value);
  if (!details.limit.empty()) object["limit"] = valid_utf8(details.limit);
  if (details.parameter) object["at"]["parameter"] = *details.parameter;
  if (details.target) {
    object["at"]["target"] = {details.target->x(), details.target->y(), details.target->z()};
  }
  return {{{"status", "error"}, {"error", object}}, {}, {}};
}

Json assemble(const Answer& answer) {
  Json document = answer.document;
  for (const Array& array : answer.arrays) {
    DomSink sink;
    give(sink, placed(array, answer.document));
    document[Json::json_pointer(array.pointer)] = sink.take();
  }
  return document;
}

std::string to_json(const Answer& answer) {
  Members members;
  for (const Array& array : answer.arrays) {
    const Json::json_pointer pointer(array.pointer);
    const Json::json_pointer parent = pointer.parent_pointer();
    if (!answer.document.contains(parent) || !answer.document.at(parent).is_object()) {
      throw Error(ErrorCode::Internal, "the document has no object to hold " + array.pointer);
    }
    members.emplace(parent.to_string(), std::pair(pointer.back(), placed(array, answer.document)));
  }
  Writer writer(members);
  writer.write(answer.document, "", 0);
  return writer.take() + "\n";
}

}  // namespace ridgeline::jobs
