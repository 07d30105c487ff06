#include "core/macro/cycle_program.hpp"
#include "core/macro/listing.hpp"
#include "jobs/cycle_job.hpp"
#include "jobs/kinds.hpp"
#include "jobs/macro_motion.hpp"
#include "jobs/macro_page.hpp"

namespace ridgeline::jobs {
namespace {

/// The core names parameters as the document does; here the name becomes a pointer into it.
[[noreturn]] void rethrow_at_params(const Error& error) {
  ErrorDetails details = error.details();
  if (!details.field.empty()) details.field = "/params/" + details.field;
  throw Error(error.code(), error.what(), details);
}

macro::CycleResult solved(const macro::Cycle& cycle, const Progress& progress) {
  try {
    return macro::solve(cycle, progress);
  } catch (const Error& error) {
    rethrow_at_params(error);
  }
}

constexpr int max_program_number = 99'999'998;  // the contour of an outline is the next one

/// "program": how the text of `--format nc` is written.
macro::CycleProgram read_program(const Value& value) {
  Object object(value);
  macro::CycleProgram program;
  constexpr Choices<macro::CycleProgram::Kind, 2> kinds{
      {{"main", macro::CycleProgram::Kind::Main}, {"macro", macro::CycleProgram::Kind::Macro}}};
  constexpr Choices<macro::ProgramDialect, 2> dialects{
      {{"fanuc", macro::ProgramDialect::Fanuc}, {"linuxcnc", macro::ProgramDialect::LinuxCnc}}};
  program.kind = object.choice("kind", kinds, program.kind);
  program.dialect = object.choice("dialect", dialects, program.dialect);
  program.number = object.integer("number", 1, max_program_number, program.number);
  constexpr Choices<const char*, 6> offsets{{{"G54", "G54"},
                                             {"G55", "G55"},
                                             {"G56", "G56"},
                                             {"G57", "G57"},
                                             {"G58", "G58"},
                                             {"G59", "G59"}}};
  program.work_offset = object.choice("work_offset", offsets, "G54");
  program.tool = object.integer("tool", 0, 400, program.tool);
  program.spindle_speed = object.number("spindle_speed", between(0, 1e6, "rev/min"), 0);
  object.finish();
  return program;
}

std::string program_text(const macro::Cycle& cycle, const macro::CycleResult& solved,
                         const macro::CycleProgram& program, const Progress& progress) {
  try {
    return macro::cycle_program(cycle, solved, program, progress);
  } catch (const Error& error) {
    rethrow_at_params(error);
  }
}

}  // namespace

Answer cycle(const Request& request) {
  Object object{Value(request.document)};
  object.required("job");
  for (const char* label : {"id", "frame"}) object.has(label);  // the author's own labels
  const macro::Cycle cycle = read_cycle(object);
  const std::optional<Value> program_value = object.optional("program");
  const macro::CycleProgram program =
      program_value ? read_program(*program_value) : macro::CycleProgram();
  object.finish();
  const macro::CycleResult result = solved(cycle, request.progress.part(0, 0.6));
  const Progress rest = request.progress.part(0.8, 1);

  Answer answer;
  answer.document = cycle_document(cycle, result, request.progress.part(0.6, 0.8));
  answer.document["job"] = "cycle";
  answer.document["status"] = "ok";
  answer.document["family"] = request.document.at("family");
  if (request.document.contains("method")) {
    answer.document["method"] = request.document.at("method");
  }
  answer.document["machining_seconds"] = result.motion.seconds;
  if (request.format == "json") {
    answer.arrays.push_back(macro_moves_array("/motion", result.motion, answer.document, rest));
  }
  if (request.format == "nc") answer.text = program_text(cycle, result, program, rest);
  if (request.format == "csv") answer.text = macro::csv_text(result.motion, rest);
  if (request.format == "svg")
    answer.text = macro_drawing(result.motion, "Motion of a cycle", rest);
  if (request.format == "html") {
    const std::string title = "Cycle: " + request.document.at("family").get<std::string>();
    answer.text = macro_page(result.motion, title, answer.document, rest);
  }
  return answer;
}

}  // namespace ridgeline::jobs
