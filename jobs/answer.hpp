#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"

/// Jobs as JSON documents: what the service and `ridgeline --local` run alike. Knows no middleware,
/// no file, no console.
namespace ridgeline::jobs {

/// A named definition as the library keeps it.
struct Definition {
  nlohmann::json document;
  int revision = 0;
};

/// Where jobs look names up. Implemented by the library of the service and by tests.
class Definitions {
public:
  virtual ~Definitions() = default;
  /// kind: "workpiece", "tool", "material", ...; name: the name, or a tool's number as text.
  virtual std::optional<Definition> find(std::string_view kind, std::string_view name) const = 0;
  /// Every name of a kind, for the message of an unknown one.
  virtual std::vector<std::string> names(std::string_view kind) const = 0;
};

/// A library without any definition.
class NoDefinitions : public Definitions {
public:
  std::optional<Definition> find(std::string_view, std::string_view) const override { return {}; }
  std::vector<std::string> names(std::string_view) const override { return {}; }
};

/// Bulk numbers of a result, kept out of the document: placed back at `pointer` by assemble().
///
/// Numbers alone (points, parameters) become nested arrays of the shape. Where the document already
/// holds a value at `pointer`, that value is a table description and every row becomes an object:
///
///     {"columns": [ {"key": "kind", "names": ["rapid", "cut"]},      a number 0, 1, ... as a name
///                   {"key": "to", "size": 3},                        an array of 3 numbers
///                   {"key": "feed"},                                 a number
///                   {"key": "arc", "columns": [...]} ]}              an object
///
/// Columns take the cells of the row in order. A cell that is NaN leaves its key out; an object
/// whose first cell is NaN is left out whole.
struct Array {
  std::string pointer;             ///< JSON pointer of a member of an object, e.g. "/centres"
  std::vector<std::size_t> shape;  ///< e.g. {360, 3}: row-major
  std::vector<double> values;
};

/// What a job gives. `document` is the result of interfaces.md without its bulk arrays, or the
/// error object.
struct Answer {
  nlohmann::json document;
  std::vector<Array> arrays;
  std::string text;  ///< in the format asked for (NC program, CSV, ...); empty for json
};

/// Is the document an error object?
bool is_error(const Answer& answer);

/// The error object of interfaces.md.
Answer refusal(const Error& error);

/// Reads, runs and answers one job document. `format`: "json", "nc", "cl", "csv", "svg", "html",
/// ... Never throws: every failure is the error object of interfaces.md.
Answer answer(std::string_view job, std::string_view format, const Definitions& definitions,
              const Progress& progress = {}) noexcept;

/// The kinds of job that answer() knows, for an instance to announce.
std::vector<std::string> job_names();

/// The whole result document, arrays in their places.
nlohmann::json assemble(const Answer& answer);

/// The text of assemble(answer), written without building it (docs/benchmarks.md, growth).
/// Indented, arrays of numbers on one line; every number reads back as the same double.
std::string to_json(const Answer& answer);

}  // namespace ridgeline::jobs
