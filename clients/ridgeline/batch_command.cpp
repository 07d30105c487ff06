#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/progress_bar.hpp"
#include "clients/ridgeline/subcommand.hpp"
#include "jobs/parse.hpp"
#include "jobs/refuse.hpp"
#include "service/instance_status.hpp"

namespace ridgeline::command {
namespace {

struct Arguments {
  std::vector<std::string> jobs;
  std::string folder;
  std::string format = "json";
  int at_once = 0;
  bool is_again = false;
};

/// One job of a batch: its file, its result file and what became of it.
struct Item {
  std::string job;
  std::string output;
  Outcome outcome;
  bool was_there = false;  ///< done by an earlier run
};

/// What is done, kept beside the results: a batch that was interrupted goes on where it stopped. A
/// line for each result: a hash of its job's text, and its file. Written when the result is there.
class Journal {
public:
  explicit Journal(const std::string& folder)
      : file_(std::filesystem::path(folder) / ".ridgeline-batch") {
    std::ifstream stream(file_);
    for (std::string line; std::getline(stream, line);) done_.insert(line);
  }

  bool has(const Item& item, const std::string& job) const {
    return done_.contains(line(item, job)) && std::filesystem::exists(item.output);
  }

  void add(const Item& item, const std::string& job) {
    const std::scoped_lock lock(mutex_);
    std::ofstream stream(file_, std::ios::app);
    stream << line(item, job) << std::endl;
    if (!stream) {
      throw Error(ErrorCode::BadFile, "cannot write " + file_.string() +
                                          ": the batch could not go on where it stopped");
    }
  }

private:
  /// FNV-1a: another job under the same file name is not done.
  static std::string line(const Item& item, const std::string& job) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : job) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return fmt::format("{:016x} {}", hash, std::filesystem::path(item.output).filename().string());
  }

  std::filesystem::path file_;
  std::set<std::string> done_;
  std::mutex mutex_;
};

std::vector<Item> items_of(const Arguments& arguments) {
  std::vector<Item> items;
  std::set<std::string> outputs;
  for (const std::string& job : arguments.jobs) {
    const std::filesystem::path name =
        std::filesystem::path(job).stem().concat("." + arguments.format);
    const std::string output = (std::filesystem::path(arguments.folder) / name).string();
    if (!outputs.insert(output).second) {
      jobs::refuse({.value = job,
                    .limit = "job files of different names",
                    .message = "two jobs would write " + output});
    }
    items.push_back({job, output, {}});
  }
  return items;
}

/// As many jobs at once as the instances have workers, or this machine has processors.
std::size_t jobs_at_once(const Session& session, const Arguments& arguments) {
  std::size_t count = static_cast<std::size_t>(arguments.at_once);
  if (count == 0 && session.options().local) count = std::thread::hardware_concurrency();
  if (count == 0) {
    for (const wire::InstanceStatus& status : session.status()) count += status.workers;
  }
  return std::clamp<std::size_t>(count, 1, arguments.jobs.size());
}

Outcome run_item(const Session& session, Item& item, const Arguments& arguments, Journal& journal) {
  return attempt([&] {
    const std::string& format = arguments.format;
    const std::string text = read_file(item.job);
    item.was_there = !arguments.is_again && journal.has(item, text);
    if (item.was_there) return Outcome{};
    jobs::parse(text);
    const auto listener = [](double, std::string_view) {};
    Outcome outcome = outcome_of(session.ask(text, format, listener), format);
    if (outcome.status != ExitStatus::Done) return outcome;
    write_file(item.output, outcome.text);
    journal.add(item, text);
    return outcome;
  });
}

/// Every thread takes the next job until there is none.
void run_all(const Session& session, const Arguments& arguments, std::vector<Item>& items) {
  ProgressBar bar(session.options().quiet ? ProgressBar::Mode::Off : ProgressBar::Mode::Automatic);
  Journal journal(arguments.folder);
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < items.size(); i = next++) {
      if (session.interrupt().is_interrupted()) return;
      items[i].outcome = run_item(session, items[i], arguments, journal);
      bar.show(static_cast<double>(++done) / static_cast<double>(items.size()), items[i].job);
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t i = jobs_at_once(session, arguments); i > 0; --i) threads.emplace_back(work);
}

nlohmann::json line_of(const Item& item) {
  nlohmann::json line = {{"job", item.job}};
  if (item.outcome.status == ExitStatus::Done) {
    line["status"] = "ok";
    line["output"] = item.output;
    if (item.was_there) line["earlier"] = true;
  } else {
    const nlohmann::json document = nlohmann::json::parse(item.outcome.text);
    line["status"] = "error";
    if (document.contains("error")) line["error"] = document.at("error");
  }
  return line;
}

/// The worst that became of any job decides the exit status: its number grows with it.
Outcome summary(const Session& session, const std::vector<Item>& items) {
  Outcome outcome;
  jobs::Answer answer;
  std::size_t failed = 0;
  answer.document = {{"jobs", nlohmann::json::array()}};
  for (const Item& item : items) {
    answer.document["jobs"].push_back(line_of(item));
    outcome.status = std::max(outcome.status, item.outcome.status);
    failed += item.outcome.status == ExitStatus::Done ? 0 : 1;
  }
  answer.document["status"] = failed == 0 ? "ok" : "error";
  if (session.interrupt().is_interrupted()) outcome.status = ExitStatus::Interrupted;
  if (failed > 0) {
    outcome.diagnostic =
        std::to_string(failed) + " of " + std::to_string(items.size()) + " jobs failed";
  }
  outcome.text = jobs::to_json(answer);
  return outcome;
}

Outcome run(const Session& session, const Arguments& arguments) {
  std::vector<Item> items = items_of(arguments);
  std::error_code error;
  std::filesystem::create_directories(arguments.folder, error);
  if (error) {
    throw Error(ErrorCode::BadFile,
                "cannot make the folder " + arguments.folder + ": " + error.message());
  }
  for (Item& item : items) {
    item.outcome =
        unusable(Error(ErrorCode::Cancelled, "not begun when the batch was interrupted"));
  }
  run_all(session, arguments, items);
  return summary(session, items);
}

}  // namespace

void add_batch_command(CLI::App& app, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      add_bare_subcommand(app, selected, arguments, "batch",
                          "Compute many jobs at once, over all instances of the service", run);
  command.add_option("JOBS", arguments->jobs, "Job files (JSON)")->required();
  command.add_option("-o,--output", arguments->folder, "Folder for the results, one file a job")
      ->required()
      ->type_name("DIR");
  command.add_option("--format", arguments->format, "What to write: json, nc, cl, csv or svg")
      ->check(CLI::IsMember({"json", "nc", "cl", "csv", "svg"}))
      ->capture_default_str();
  command
      .add_option("--at-once", arguments->at_once, "Jobs under way at a time (default: workers)")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--again", arguments->is_again,
                   "Compute also what an earlier run left in DIR from the same job file");
  command.footer(
      "Prints what became of each job; exit status 1 when any was refused. An interrupted batch, "
      "started\nagain, computes what is missing; after a change of the library use --again.");
}

}  // namespace ridgeline::command
