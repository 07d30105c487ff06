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
};

/// Bulk numbers of a result, kept out of the document: placed back at `pointer` by assemble().
struct Array {
  std::string pointer;             ///< JSON pointer, e.g. "/centres"
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

/// Reads, runs and answers one job document. `format`: "json", "nc", "cl", "csv", "svg", "html",
/// ... Never throws: every failure is the error object of interfaces.md.
Answer answer(std::string_view job, std::string_view format, const Definitions& definitions,
              const Progress& progress = {}) noexcept;

/// The whole result document, arrays in their places.
nlohmann::json assemble(const Answer& answer);

}  // namespace ridgeline::jobs
