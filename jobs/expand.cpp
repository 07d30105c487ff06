#include "core/nc/expand.hpp"

#include "jobs/chamfer_program.hpp"
#include "jobs/expand_call.hpp"
#include "jobs/kinds.hpp"

namespace ridgeline::jobs {
namespace {

/// The same refusal with the place of the call in front.
[[noreturn]] void refuse_at(const nc::Call& call, const Error& error) {
  throw Error(error.code(),
              "line " + std::to_string(call.line) + ", " + call.text + ": " + error.what(),
              error.details());
}

}  // namespace

Answer expand(const Request& request) {
  Object object{Value(request.document)};
  object.required("job");
  const std::string& program = object.required("program").string();
  const CallBinding binding = read_binding(object.optional("binding"));
  object.finish();

  Answer answer;
  answer.document = {{"job", "expand"}, {"status", "ok"}, {"calls", nlohmann::json::array()}};
  std::string text = nc::expand(
      program, binding.letters,
      [&](const nc::Call& call) {
        try {
          const nlohmann::json job =
              job_of(call, binding.calls.at(call.macro), request.definitions);
          InlineProgram motion = inline_program(job, request.definitions, request.progress);
          answer.document["calls"].push_back({{"line", call.line},
                                              {"macro", call.macro},
                                              {"text", call.text},
                                              {"report", std::move(motion.report)}});
          return motion.text;
        } catch (const Error& error) {
          refuse_at(call, error);
        }
      },
      request.progress);
  if (request.format == "json") {
    answer.document["program"] = std::move(text);
  } else {
    answer.text = std::move(text);
  }
  return answer;
}

}  // namespace ridgeline::jobs
