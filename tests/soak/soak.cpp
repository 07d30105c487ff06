// Clients and instances that come, go and are killed, until enough requests are answered. Every
// request of a client that lived on must have been answered with its own answer or have failed by
// name; the instance that is never killed must not grow. Exit status 1 when not.

#include <fmt/format.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "tests/loopback/network.hpp"
#include "tests/soak/asking.hpp"

namespace {

using namespace ridgeline;
using Clock = std::chrono::steady_clock;

struct Options {
  int requests = 10'000;
  int clients = 16;
  int each = 200;                               ///< requests of one client, unless it is killed
  double kill_client = 0.5, kill_instance = 3;  ///< seconds between
  double timeout = 20;
  int kept_answers = 8;   ///< of an instance [MB]: full before half of the requests, so that the
                          ///< memory can be judged
  bool may_grow = false;  ///< too short to tell: what is kept to answer duplicates is not full yet
  std::string service_prefix, client_prefix;  ///< e.g. "ip netns exec a"
  std::string ask;                            ///< "DOMAIN SEED": be a client
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// What the clients told.
struct Tally {
  std::map<std::string, int> codes;
  std::set<std::pair<std::uint64_t, int>> open;  ///< begun and not ended
  int ended = 0;

  void read(const std::filesystem::path& file) {
    std::ifstream stream(file);
    stream.seekg(position);
    for (std::string line; std::getline(stream, line) && !stream.eof(); position = stream.tellg()) {
      const std::vector<std::string> word = words(line);
      const std::pair request(std::stoull(word.at(1)), std::stoi(word.at(2)));
      if (word[0] == "begin") {
        open.insert(request);
      } else {
        if (open.erase(request) != 1) ++codes["ended twice"];
        ++codes[word.at(3)];
        ++ended;
      }
    }
  }
  std::streamoff position = 0;
};

std::uint64_t resident(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  std::uint64_t total = 0, pages = 0;
  file >> total >> pages;
  return pages * 4096;
}

long open_files(pid_t pid) {
  const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid) + "/fd");
  return std::distance(begin(all), end(all));
}

class Soak : public Loopback {
public:
  explicit Soak(const Options& options) : options_(options) {}
  void TestBody() override {}

  int run() {
    for (const char* name : {"rock", "north", "south"}) instances_[name] = start_instance(name);
    std::this_thread::sleep_for(2s);
    const pid_t rock = instances_["rock"]->pid();
    for (int i = 0; i < options_.clients; ++i) start_client();
    auto next_client = later(options_.kill_client), next_instance = later(options_.kill_instance),
         next_report = Clock::now();
    std::uint64_t warm = 0;
    const auto begin = Clock::now();
    while (tally_.ended < options_.requests) {
      std::this_thread::sleep_for(20ms);
      tally_.read(told());
      if (warm == 0 && tally_.ended > options_.requests / 2) warm = resident(rock);
      if (Clock::now() > next_client) kill_client(), next_client = later(options_.kill_client);
      if (Clock::now() > next_instance)
        kill_instance(), next_instance = later(options_.kill_instance);
      if (Clock::now() > next_report) report(rock), next_report = later(10);
      replace_finished();
    }
    for (auto& [seed, client] : clients_)
      if (client->wait(std::chrono::seconds(60)) < 0) client->signal(SIGKILL), killed_.insert(seed);
    tally_.read(told());
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    report(rock);
    return verdict(rock, warm, seconds);
  }

private:
  Clock::time_point later(double seconds) {
    const double random = std::uniform_real_distribution(0.5, 1.5)(random_);
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(seconds * random));
  }
  std::filesystem::path told() const { return folder_ / "told"; }

  std::unique_ptr<Process> start_instance(const std::string& name) {
    std::vector<std::string> command = words(options_.service_prefix);
    const std::vector<std::string> daemon = daemon_command(
        name, {"--log-level", "warning", "--kept-answers", std::to_string(options_.kept_answers)});
    command.insert(command.end(), daemon.begin(), daemon.end());
    return std::make_unique<Process>(command, folder_ / (name + ".log"));
  }

  void start_client() {
    std::vector<std::string> command = words(options_.client_prefix);
    const std::vector<std::string> asks = {"/bin/sh",
                                           "-c",
                                           "exec \"$@\" >>" + told().string(),
                                           "sh",
                                           std::filesystem::read_symlink("/proc/self/exe").string(),
                                           "--ask",
                                           fmt::format("{} {}", domain_, ++seed_),
                                           "--each",
                                           std::to_string(options_.each),
                                           "--timeout",
                                           std::to_string(options_.timeout)};
    command.insert(command.end(), asks.begin(), asks.end());
    clients_[seed_] = std::make_unique<Process>(command, folder_ / "client.log");
  }

  void kill_client() {
    auto victim = clients_.begin();
    std::advance(victim, random_() % clients_.size());
    victim->second->signal(random_() % 2 == 0 ? SIGKILL : SIGTERM);
    victim->second->wait(5s);
    killed_.insert(victim->first);
    clients_.erase(victim);
    start_client();
  }

  void kill_instance() {
    const std::string name = random_() % 2 == 0 ? "north" : "south";
    instances_[name]->signal(random_() % 3 == 0 ? SIGTERM : SIGKILL);
    instances_[name]->wait(10s);
    instances_[name] = start_instance(name);
    ++restarts_;
  }

  void replace_finished() {
    std::vector<std::uint64_t> finished;
    for (auto& [seed, client] : clients_)
      if (const int status = client->wait(0ms); status >= 0) {
        if (status != 0) ++crashed_;
        finished.push_back(seed);
      }
    for (const std::uint64_t seed : finished) {
      clients_.erase(seed);
      if (tally_.ended < options_.requests) start_client();
    }
  }

  void report(pid_t rock) const {
    std::cout << fmt::format(
                     "{:6} answered, {} clients killed, {} instances restarted, rock {:.1f} MB, "
                     "{} files\n",
                     tally_.ended, killed_.size(), restarts_,
                     static_cast<double>(resident(rock)) / 1e6, open_files(rock))
              << std::flush;
  }

  int verdict(pid_t rock, std::uint64_t warm, double seconds) {
    const std::uint64_t now = resident(rock);
    int silent = 0;
    for (const auto& [seed, number] : tally_.open) silent += killed_.contains(seed) ? 0 : 1;
    std::cout << fmt::format("{} requests in {:.0f} s:", tally_.ended, seconds);
    for (const auto& [code, count] : tally_.codes) std::cout << fmt::format(" {} {}", code, count);
    const int wrong = silent + crashed_ + tally_.codes["foreign"] + tally_.codes["ended twice"];
    const bool has_grown = !options_.may_grow && now > warm + warm / 4;
    std::cout << fmt::format(
        "\nwithout an end {}, foreign {}, ended twice {}, clients that failed {}\n"
        "resident memory of the instance that lived: {:.1f} MB after half, {:.1f} MB at the "
        "end{}\n",
        silent, tally_.codes["foreign"], tally_.codes["ended twice"], crashed_,
        static_cast<double>(warm) / 1e6, static_cast<double>(now) / 1e6,
        has_grown ? ": IT GROWS" : "");
    return wrong == 0 && !has_grown ? 0 : 1;
  }

  Options options_;
  std::mt19937_64 random_{20240501};
  std::map<std::string, std::unique_ptr<Process>> instances_;
  std::map<std::uint64_t, std::unique_ptr<Process>> clients_;
  std::set<std::uint64_t> killed_;
  std::uint64_t seed_ = 0;
  int restarts_ = 0, crashed_ = 0;
  Tally tally_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Soaks the service: see the head of soak.cpp");
  app.add_option("--requests", options.requests, "Requests to be answered")->capture_default_str();
  app.add_option("--clients", options.clients, "Clients at once")->capture_default_str();
  app.add_option("--each", options.each, "Requests of a client")->capture_default_str();
  app.add_option("--kill-client", options.kill_client, "Seconds between")->capture_default_str();
  app.add_option("--kill-instance", options.kill_instance, "Seconds between")
      ->capture_default_str();
  app.add_option("--timeout", options.timeout, "Of a request [s]")->capture_default_str();
  app.add_option("--kept-answers", options.kept_answers, "Of an instance [MB]")
      ->capture_default_str();
  app.add_flag("--allow-growth", options.may_grow, "Too short a run to judge the memory");
  app.add_option("--service-prefix", options.service_prefix, "Command to run instances with");
  app.add_option("--client-prefix", options.client_prefix, "Command to run clients with");
  app.add_option("--ask", options.ask, "\"DOMAIN SEED\": be one of the clients");
  CLI11_PARSE(app, argc, argv);
  if (!options.ask.empty()) {
    const std::vector<std::string> word = words(options.ask);
    return soak::ask(static_cast<unsigned>(std::stoul(word.at(0))), std::stoull(word.at(1)),
                     options.each, options.timeout);
  }
  return Soak(options).run();
}
