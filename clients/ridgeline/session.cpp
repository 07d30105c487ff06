#include "clients/ridgeline/session.hpp"

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "clients/client.hpp"
#include "clients/ridgeline/progress_bar.hpp"
#include "core/base/text.hpp"
#include "jobs/parse.hpp"
#include "service/job_kind.hpp"
#include "service/library.hpp"
#include "service/library_job.hpp"

namespace ridgeline::command {
namespace {

/// Requests a stop when the time is up.
class Deadline {
public:
  Deadline(const std::optional<double>& seconds, std::stop_source& stop) {
    if (!seconds) return;
    const auto time = std::chrono::duration<double>(*seconds);
    waiter_ = std::jthread([this, time, &stop](const std::stop_token& done) {
      std::unique_lock lock(mutex_);
      condition_.wait_for(lock, done, time, [&] { return done.stop_requested(); });
      if (done.stop_requested()) return;
      passed_ = true;
      stop.request_stop();
    });
  }
  bool has_passed() const { return passed_; }

private:
  std::atomic<bool> passed_ = false;
  std::mutex mutex_;
  std::condition_variable_any condition_;
  std::jthread waiter_;
};

bool is_library_job(const nlohmann::json& document) {
  return document.is_object() && document.value("job", nlohmann::json()) == "library";
}

/// The library that --local uses. A job that only looks names up does not make a file.
std::unique_ptr<service::Library> open_library(const Options& options, const nlohmann::json& job) {
  const bool is_named = !options.library.empty();
  const std::filesystem::path file =
      is_named ? std::filesystem::path(options.library) : service::default_library_file();
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  if (!is_there && !(is_library_job(job) && service::is_change(job))) {
    if (!is_named && !is_library_job(job)) return nullptr;
    ErrorDetails details;
    details.value = file.string();
    throw Error(ErrorCode::BadFile, "there is no library file " + file.string(), details);
  }
  return std::make_unique<service::Library>(file);
}

jobs::Answer answer(const Options& options, const std::string& job, const std::string& format,
                    const Progress& progress) {
  try {
    const nlohmann::json document = jobs::parse(job);
    const std::unique_ptr<service::Library> library = open_library(options, document);
    if (is_library_job(document)) return service::answer_library(document, *library);
    const jobs::NoDefinitions none;
    const jobs::Definitions& definitions =
        library ? static_cast<const jobs::Definitions&>(*library) : none;
    return jobs::answer(job, format, definitions, progress);
  } catch (const Error& error) {
    return jobs::refusal(error);
  }
}

}  // namespace

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(seconds));
}

Session::Session(const Options& options, const Interrupt& interrupt)
    : options_(options), interrupt_(interrupt) {}

Session::~Session() = default;

client::Client& Session::client() const {
  const std::lock_guard lock(mutex_);
  if (!client_) {
    client::Options options;
    options.domain = static_cast<unsigned>(options_.domain);
    options.instance = options_.instance;
    client_ = std::make_unique<client::Client>(options);
  }
  return *client_;
}

jobs::Answer Session::compute(const std::string& job, const std::string& format,
                              const Listener& listener) const {
  std::stop_source stop;
  const std::stop_callback forward(interrupt_.token(), [&stop] { stop.request_stop(); });
  const Deadline deadline(options_.timeout, stop);
  Progress progress;
  progress.report = listener;
  progress.stop = stop.get_token();
  jobs::Answer result = answer(options_, job, format, progress);
  const bool is_cancelled = jobs::is_error(result) &&
                            result.document.at("error").at("code") == name(ErrorCode::Cancelled);
  if (!is_cancelled || !deadline.has_passed() || interrupt_.is_interrupted()) return result;
  ErrorDetails details;
  details.limit = text(*options_.timeout, "s");
  return jobs::refusal(Error(ErrorCode::Timeout, "no answer within " + details.limit, details));
}

jobs::Answer Session::send(const std::string& job, const std::string& format,
                           const Listener& listener) const {
  try {
    client::Patience patience;
    if (options_.timeout) patience.timeout = milliseconds(*options_.timeout);
    patience.progress = [&listener](const client::ProgressReport& report) {
      listener(report.fraction, report.stage);
    };
    patience.stop = interrupt_.token();
    return client().ask(job, format, patience);
  } catch (const Error& error) {
    return jobs::refusal(error);
  }
}

jobs::Answer Session::ask(const std::string& job, const std::string& format,
                          const Listener& listener) const {
  return options_.local ? compute(job, format, listener) : send(job, format, listener);
}

jobs::Answer Session::ask(const std::string& job, const std::string& format) const {
  ProgressBar bar(options_.quiet ? ProgressBar::Mode::Off : ProgressBar::Mode::Automatic);
  return ask(job, format,
             [&bar](double fraction, std::string_view stage) { bar.show(fraction, stage); });
}

std::vector<wire::InstanceStatus> Session::status() const {
  constexpr double usual_wait = 3;
  const double wait = options_.timeout.value_or(usual_wait);
  std::vector<wire::InstanceStatus> statuses = client().status(milliseconds(wait));
  if (!statuses.empty()) return statuses;
  ErrorDetails details;
  details.value = "domain " + std::to_string(options_.domain);
  details.limit = "a running ridgelined within " + text(wait, "s");
  const std::string whom =
      options_.instance.empty() ? "no instance of the service" : "no instance " + options_.instance;
  throw Error(ErrorCode::NoService, whom + " answers in " + details.value, details);
}

}  // namespace ridgeline::command
