#include <optional>

#include "core/macro/check.hpp"
#include "core/macro/listing.hpp"
#include "jobs/kinds.hpp"
#include "jobs/macro_job.hpp"
#include "jobs/macro_motion.hpp"
#include "jobs/macro_page.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json number_or_null(const macro::Value& value) {
  return value.vacant ? Json(nullptr) : Json(value.number);
}

Json variables_of(const std::map<int, macro::Value>& variables) {
  Json object = Json::object();
  for (const auto& [number, value] : variables) {
    object[std::to_string(number)] = number_or_null(value);
  }
  return object;
}

Json array_of(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Json trace_of(const macro::Result& result, const Progress& progress) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < result.trace.size(); ++i) {
    progress.step(i, result.trace.size(), "trace");
    const macro::TraceStep& step = result.trace[i];
    Json each = {{"program", step.program},
                 {"line", step.line},
                 {"level", step.level},
                 {"text", step.text},
                 {"moves", step.moves}};
    if (step.variable) {
      each["set"] = {{std::to_string(*step.variable), number_or_null(step.value)}};
    }
    steps.push_back(std::move(each));
  }
  return steps;
}

Json document_of(const macro::Result& result, const Progress& progress) {
  Json document = {{"job", "macro"},
                   {"status", result.alarm ? "alarm" : "ok"},
                   {"position", array_of(result.position)},
                   {"machine", array_of(result.machine)},
                   {"variables", variables_of(result.variables)},
                   {"messages", result.messages},
                   {"statements", result.statements},
                   {"tool", result.tool},
                   {"spindle_speed", result.spindle_speed},
                   {"machining_seconds", result.seconds}};
  if (result.alarm) {
    const macro::Alarm& alarm = *result.alarm;
    document["alarm"] = {{"number", alarm.number},
                         {"message", alarm.message},
                         {"program", alarm.program},
                         {"line", alarm.line},
                         {"column", alarm.column}};
  }
  if (!result.locals.empty()) document["locals"] = variables_of(result.locals);
  if (!result.prints.empty()) document["prints"] = result.prints;
  if (!result.warnings.empty()) document["warnings"] = result.warnings;
  if (!result.trace.empty()) document["trace"] = trace_of(result, progress.part(0, 0.6));
  Json events = Json::array();
  const Progress events_part = progress.part(0.6, 0.8), axes_part = progress.part(0.8, 1);
  for (std::size_t i = 0; i < result.events.size(); ++i) {
    events_part.step(i, result.events.size(), "answer");
    const macro::Event& event = result.events[i];
    events.push_back({{"before", event.before},
                      {"word", event.word},
                      {"program", event.program},
                      {"line", event.line}});
  }
  if (!events.empty()) document["events"] = std::move(events);
  Json axes = Json::array();
  for (std::size_t i = 0; i < result.axes.size(); ++i) {
    axes_part.step(i, result.axes.size(), "answer");
    const macro::AxisMove& axis = result.axes[i];
    axes.push_back({{"move", axis.move}, {"axis", std::string(1, axis.axis)}, {"to", axis.to}});
  }
  if (!axes.empty()) document["axes"] = std::move(axes);
  return document;
}

Answer run(const MacroJob& job, const Request& request) {
  macro::Options options = job.options;
  options.library = library_of(job);
  options.named_library = named_library_of(job);
  if (request.format == "trace") options.trace = true;
  const macro::Result result = macro::run(job.program, options, request.progress.part(0, 0.7));
  const Progress rest = request.progress.part(0.85, 1);
  Answer answer;
  answer.document = document_of(result, request.progress.part(0.7, 0.85));
  if (request.format == "json") {
    answer.arrays.push_back(macro_moves_array("/motion", result, answer.document, rest));
  }
  constexpr std::string_view title = "Motion of a macro program";
  if (request.format == "nc") {
    answer.text = macro::nc_text(result, {.decimals = job.decimals}, rest);
  }
  if (request.format == "csv") answer.text = macro::csv_text(result, rest);
  if (request.format == "trace") answer.text = macro::trace_text(result, rest);
  if (request.format == "svg") answer.text = macro_drawing(result, title, rest);
  if (request.format == "html") answer.text = macro_page(result, title, answer.document, rest);
  return answer;
}

Answer check(const MacroJob& job, const Request& request) {
  if (request.format != "json" && request.format != "text") {
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = std::string(request.format),
            .limit = "json or text",
            .message = "a check has no motion: ask for json or text"});
  }
  const std::vector<macro::Finding> findings =
      macro::check(job.program, job.options.profile,
                   [&job](int number) { return job.programs.contains(number); });
  Answer answer;
  Json list = Json::array();
  for (const macro::Finding& finding : findings) {
    const char* severity = finding.severity == macro::Severity::Error ? "error" : "warning";
    list.push_back({{"rule", finding.rule},
                    {"severity", severity},
                    {"message", finding.message},
                    {"program", finding.program},
                    {"line", finding.line},
                    {"column", finding.column}});
    answer.text += std::to_string(finding.line) + ":" + std::to_string(finding.column) + ": " +
                   severity + ": " + finding.message + " [" + finding.rule + "]\n";
  }
  answer.document = {
      {"job", "macro"}, {"operation", "check"}, {"status", "ok"}, {"findings", std::move(list)}};
  return answer;
}

}  // namespace

Answer macro_program(const Request& request) {
  Object object{Value(request.document)};
  object.required("job");
  const MacroJob job = read_macro_job(object);
  object.finish();
  return job.operation == MacroJob::Operation::Check ? check(job, request) : run(job, request);
}

}  // namespace ridgeline::jobs
