#include "tests/loopback/network.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace ridgeline {
namespace {

int slowness_of_this_run() {
  const char* variable = std::getenv("RIDGELINE_SLOWNESS");
  if (variable != nullptr) return std::stoi(variable);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 5;
#else
  return 1;
#endif
}

}  // namespace

const int slowness = slowness_of_this_run();

Process::Process(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& each : command) arguments.push_back(const_cast<char*>(each.c_str()));
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  dup2(file, STDERR_FILENO);
  execv(arguments[0], arguments.data());
  _exit(127);
}

Process::~Process() {
  if (status_ >= 0 || pid_ <= 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const {
  ASSERT_EQ(kill(pid_, number), 0);
}

int Process::wait(std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + slowness * limit;
  while (status_ < 0) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_)
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    else if (std::chrono::steady_clock::now() > end)
      return -1;
    else
      std::this_thread::sleep_for(2ms);
  }
  return status_;
}

Loopback::Loopback() {
  static int count = 0;
  const int number = getpid() * 31 + ++count;
  domain_ = static_cast<unsigned>(1 + number % 99);
  const std::string tag =
      "ridgeline-test-" + std::to_string(getpid()) + "-" + std::to_string(count);
  setenv("DDS_TAG", tag.c_str(), 1);
  unsetenv("CYCLONEDDS_URI");
  unsetenv("RIDGELINE_CLIENT");
}

std::vector<std::string> Loopback::daemon_command(const std::string& name,
                                                  std::vector<std::string> more) const {
  std::vector<std::string> command = {RIDGELINED,
                                      "--instance",
                                      name,
                                      "--domain",
                                      std::to_string(domain_),
                                      "--library",
                                      (folder_ / (name + ".db")).string()};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

std::unique_ptr<Process> Loopback::start(const std::string& name, std::vector<std::string> more) {
  return std::make_unique<Process>(daemon_command(name, std::move(more)),
                                   folder_ / (name + ".log"));
}

client::Options Loopback::options() const {
  client::Options options;
  options.domain = domain_;
  options.discovery *= slowness;
  return options;
}

std::vector<nlohmann::json> Loopback::events(const std::string& name,
                                             const std::string& event) const {
  std::vector<nlohmann::json> events;
  std::ifstream log(folder_ / (name + ".log"));
  for (std::string line; std::getline(log, line);) {
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object() && json.value("event", "") == event) events.push_back(json);
  }
  return events;
}

std::string code(const jobs::Answer& answer) {
  return jobs::is_error(answer) ? answer.document.at("error").at("code").get<std::string>() : "ok";
}

}  // namespace ridgeline
