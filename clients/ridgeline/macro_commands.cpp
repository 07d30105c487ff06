#include <algorithm>
#include <charconv>
#include <memory>
#include <vector>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/program_library.hpp"
#include "clients/ridgeline/subcommand.hpp"
#include "jobs/parse.hpp"

namespace ridgeline::command {
namespace {

using Json = nlohmann::json;

/// What the parsed arguments of a command are kept in until it runs.
struct MacroArguments {
  std::string program;
  std::string library;
  std::string profile = "30i";
  std::vector<std::string> set, parameters;
  std::string format = "json";
  std::optional<int> dpi, nat, main;
  bool block_skip = false;
  bool trace = false;
};

// "#100=5"; "#100=" makes the variable vacant.
void add_variable(const std::string& text, Json& set) {
  const std::size_t equals = text.find('=');
  const std::size_t begin = text.starts_with('#') ? 1 : 0;
  double number = 0;
  const char* const end = text.data() + text.size();
  const bool is_vacant = equals + 1 == text.size();
  bool is_good = equals != std::string::npos && equals > begin;
  if (is_good && !is_vacant) {
    const auto [rest, error] = std::from_chars(text.data() + equals + 1, end, number);
    is_good = error == std::errc() && rest == end;
  }
  if (!is_good) {
    throw Error(ErrorCode::BadInput,
                "--set takes a variable and a number, e.g. '#100=5', not '" + text + "'");
  }
  set[text.substr(begin, equals - begin)] = is_vacant ? Json(nullptr) : Json(number);
}

// "6050=100", "3401#0=1" for a bit, "1240=0,0,250" for axes.
void add_parameter(const std::string& text, Json& parameters) {
  const std::size_t equals = text.find('=');
  Json values = Json::array();
  bool is_good = equals != std::string::npos && equals > 0;
  for (std::size_t at = equals; is_good && at < text.size();) {
    const std::size_t end = std::min(text.find(',', at + 1), text.size());
    double number = 0;
    const auto [rest, error] = std::from_chars(text.data() + at + 1, text.data() + end, number);
    is_good = error == std::errc() && rest == text.data() + end;
    values.push_back(number);
    at = end;
  }
  if (!is_good) {
    throw Error(ErrorCode::BadInput,
                "--parameter takes a number and a value, e.g. '6050=100', not '" + text + "'");
  }
  parameters[text.substr(0, equals)] = values.size() == 1 ? values[0] : values;
}

// A name, or a file with what differs from one.
Json profile_document(const MacroArguments& arguments) {
  Json profile = arguments.profile;
  if (arguments.profile.ends_with(".json")) profile = read_document(arguments.profile);
  if (arguments.parameters.empty()) return profile;
  if (profile.is_string()) profile = {{"name", profile}};
  if (!profile.is_object()) return profile;  // the reader of the job names what is wrong
  Json& parameters = profile["parameters"];
  if (!parameters.is_object()) parameters = Json::object();
  for (const std::string& each : arguments.parameters) add_parameter(each, parameters);
  return profile;
}

Json macro_document(const MacroArguments& arguments, const char* operation) {
  Json job = {{"job", "macro"},
              {"operation", operation},
              {"program", read_file(arguments.program)},
              {"profile", profile_document(arguments)}};
  if (arguments.dpi) job["opts"]["dpi"] = *arguments.dpi;
  if (arguments.nat) job["opts"]["nat"] = *arguments.nat;
  if (!arguments.library.empty()) {
    job["programs"] =
        read_programs(arguments.library, job.at("program").get_ref<const std::string&>());
  }
  return job;
}

Outcome ask(const Session& session, const Json& job, const std::string& format) {
  const std::string text = job.dump(-1, ' ', false, Json::error_handler_t::replace);
  const jobs::Answer answer = session.ask(text, format);
  Outcome outcome = outcome_of(answer, format);
  if (answer.document.value("status", "") == "alarm") {
    const Json& alarm = answer.document.at("alarm");
    outcome.diagnostic = "alarm " + std::to_string(alarm.at("number").get<int>()) + " " +
                         alarm.at("message").get<std::string>() + ", O" +
                         std::to_string(alarm.at("program").get<int>()) + " line " +
                         std::to_string(alarm.at("line").get<int>());
  }
  return outcome;
}

Outcome run_program(const Session& session, const MacroArguments& arguments) {
  Json job = macro_document(arguments, "run");
  Json set = Json::object();
  for (const std::string& each : arguments.set) add_variable(each, set);
  job["set"] = std::move(set);
  job["block_skip"] = arguments.block_skip;
  job["trace"] = arguments.trace;
  if (arguments.main) job["main"] = *arguments.main;
  return ask(session, job, arguments.format);
}

void add_control(CLI::App& command, MacroArguments& arguments) {
  command.add_option("PROGRAM", arguments.program, "NC program, or - for standard input")
      ->required();
  command
      .add_option("--library-dir", arguments.library,
                  "Folder of the programs that it may call (O9100, O9100.nc, 9100.nc)")
      ->type_name("DIR");
  command
      .add_option("--profile", arguments.profile, "Control: 16i, 18i, 0i or 30i, or a JSON file")
      ->capture_default_str();
  command
      .add_option("--parameter", arguments.parameters,
                  "Parameter of the control, e.g. 6050=100, 3401#0=1; repeatable")
      ->allow_extra_args(false);
  command.add_option("--dpi", arguments.dpi, "1: X10 without a point is 10 mm, not 0.010 mm")
      ->check(CLI::Range(0, 1));
  command.add_option("--nat", arguments.nat, "1: ATAN gives -180 to 180 and ASIN -90 to 90")
      ->check(CLI::Range(0, 1));
}

void add_run(CLI::App& macro, Selected& selected) {
  const auto arguments = std::make_shared<MacroArguments>();
  CLI::App& command = add_subcommand(macro, selected, arguments, "run",
                                     "Run a macro program and print its motion", run_program);
  add_control(command, *arguments);
  command.add_option("--set", arguments->set, "Variable before the run, e.g. '#100=5'; repeatable")
      ->allow_extra_args(false);
  command.add_option("--main", arguments->main, "O number to run (default: the first)");
  command.add_flag("--block-skip", arguments->block_skip, "Leave out blocks that begin with /");
  command.add_flag("--trace", arguments->trace, "With json: every block with what it assigned");
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember({"json", "nc", "csv", "svg", "html", "trace"}))
      ->capture_default_str();
  command.footer(
      "Formats: json (motion, variables, messages), nc (plain G code), csv (one line a move), svg\n"
      "(drawing), html (viewer for a browser), trace (one line a block).\n"
      "Exit status 1 when the program stops with an alarm.\n"
      "Example: ridgeline macro run O0001.nc --library-dir lib --set '#100=5' --format nc");
}

void add_check(CLI::App& macro, Selected& selected) {
  const auto arguments = std::make_shared<MacroArguments>();
  arguments->format = "text";
  CLI::App& command = add_subcommand(macro, selected, arguments, "check",
                                     "Report likely mistakes in a macro program without running it",
                                     [](const Session& session, const MacroArguments& a) {
                                       return ask(session, macro_document(a, "check"), a.format);
                                     });
  add_control(command, *arguments);
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember({"json", "text"}))
      ->capture_default_str();
}

void add_make(CLI::App& macro, Selected& selected) {
  const auto arguments = std::make_shared<MacroArguments>();
  CLI::App& command = add_subcommand(macro, selected, arguments, "make",
                                     "Write the program of a cycle, or its computed motion",
                                     [](const Session& session, const MacroArguments& a) {
                                       return ask(session, read_document(a.program), a.format);
                                     });
  command.add_option("CYCLE", arguments->program, "Cycle file (JSON), or - for standard input")
      ->required();
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember({"json", "nc", "csv", "svg", "html"}))
      ->capture_default_str();
  command.footer(
      "Formats: json (points, motion, cusp), nc (parametric program as \"program\" of the file "
      "says),\n"
      "csv (one line a move), svg (drawing), html (viewer for a browser).");
}

}  // namespace

void add_macro_commands(CLI::App& app, Selected& selected) {
  CLI::App* macro = app.add_subcommand("macro", "Custom Macro B programs and cycles");
  macro->require_subcommand(1);
  add_run(*macro, selected);
  add_check(*macro, selected);
  add_make(*macro, selected);
}

}  // namespace ridgeline::command
