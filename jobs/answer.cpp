#include "jobs/answer.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <span>

#include "jobs/kinds.hpp"
#include "jobs/parse.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {
namespace {

struct Kind {
  std::string_view name;  ///< value of "job"
  Answer (*run)(const Request&);
  std::span<const std::string_view> formats;
};

constexpr std::array<std::string_view, 5> predict_formats{"json", "csv", "svg", "html", "nc"};
constexpr std::array<std::string_view, 1> json_only{"json"};
constexpr std::array<std::string_view, 5> units_formats{"json", "text", "svg", "html", "nc"};
constexpr std::array<std::string_view, 7> chamfer_formats{"json", "nc",   "cl",   "csv",
                                                          "svg",  "html", "macro"};
constexpr std::array<std::string_view, 2> expand_formats{"json", "nc"};
constexpr std::array<std::string_view, 5> cycle_formats{"json", "nc", "csv", "svg", "html"};
constexpr std::array<std::string_view, 7> macro_formats{"json", "nc",    "csv", "svg",
                                                        "html", "trace", "text"};

/// Every kind of job. A new one is one line here and one function in kinds.hpp.
constexpr std::array kinds{
    Kind{"chamfer", chamfer, chamfer_formats}, Kind{"cycle", cycle, cycle_formats},
    Kind{"expand", expand, expand_formats},    Kind{"macro", macro_program, macro_formats},
    Kind{"predict", predict, predict_formats}, Kind{"units", units_program, units_formats},
    Kind{"verify", verify, json_only},
};

const Kind& kind_of(const nlohmann::json& document) {
  const Value value = Object(Value(document)).required("job");
  const std::string& name = value.string();
  const auto* found = std::ranges::find(kinds, name, &Kind::name);
  if (found != kinds.end()) return *found;
  std::array<std::string_view, kinds.size()> names;
  std::ranges::transform(kinds, names.begin(), &Kind::name);
  value.refuse(alternatives(names));
}

Answer run(std::string_view job, std::string_view format, const Definitions& definitions,
           const Progress& progress) {
  const nlohmann::json document = parse(job, progress);
  const Kind& kind = kind_of(document);
  if (std::ranges::find(kind.formats, format) == kind.formats.end()) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = std::string(format),
            .limit = alternatives(kind.formats),
            .message = "a " + std::string(kind.name) + " job has no format \"" + shortened(format) +
                       "\": ask for " + alternatives(kind.formats)});
  }
  return kind.run({document, format, definitions, progress});
}

}  // namespace

Answer answer(std::string_view job, std::string_view format, const Definitions& definitions,
              const Progress& progress) noexcept {
  try {
    return run(job, format, definitions, progress);
  } catch (const Error& error) {
    return refusal(error);
  } catch (const std::bad_alloc&) {
    return refusal(Error(ErrorCode::Internal, "the job needs more memory than there is"));
  } catch (const std::exception& error) {
    return refusal(Error(ErrorCode::Internal, error.what()));
  }
}

std::vector<std::string> job_names() {
  std::vector<std::string> names;
  names.reserve(kinds.size());
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

}  // namespace ridgeline::jobs
