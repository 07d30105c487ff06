// How time and memory grow with what is asked: each row says its exponent over the row before,
// log(time ratio) / log(size ratio), so that a bend shows.
//   bench_growth [points] [library] [clients] [instances]      (default: all)

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <iostream>
#include <set>
#include <stdexcept>

#include "clients/client.hpp"
#include "jobs/answer.hpp"
#include "jobs/memory.hpp"
#include "service/library.hpp"
#include "tests/bench/service/load.hpp"
#include "tests/loopback/network.hpp"
#include "tests/support/named_tube.hpp"

namespace {

using namespace ridgeline;
using namespace ridgeline::bench;
using Json = nlohmann::json;

constexpr int columns = 3;
using Figures = std::array<double, columns>;

/// What `work` measures in a process of its own, and the most memory that this takes [MB].
struct Alone {
  Figures figures{};
  double megabytes = 0;
};
template <class F>
Alone alone(F&& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    int status = 1;
    try {
      const Figures figures = work();
      status = write(ends[1], figures.data(), sizeof figures) == sizeof figures ? 0 : 1;
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
    }
    _exit(status);
  }
  close(ends[1]);
  Alone result;
  const bool is_whole =
      read(ends[0], result.figures.data(), sizeof result.figures) == sizeof result.figures;
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (!is_whole || status != 0) throw std::runtime_error("a measuring process failed");
  result.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return result;
}

/// A table whose first figure's exponent is told.
class Table {
public:
  Table(const std::string& size, const std::string& figures) {
    std::cout << fmt::format("\n| {} | {} | exponent |\n|{:-<4}|", size, figures, "");
    for (const char c : figures) std::cout << (c == '|' ? "---|" : "");
    std::cout << "---|---|\n";
  }
  void row(double size, double figure, const std::string& text) {
    const std::string exponent =
        size_ > 0 ? fmt::format("{:.2f}", std::log(figure / figure_) / std::log(size / size_)) : "";
    std::cout << fmt::format("| {:.0f} | {} | {} |\n", size, text, exponent) << std::flush;
    size_ = size;
    figure_ = figure;
  }

private:
  double size_ = 0, figure_ = 0;
};

std::string job(int points) {
  Json workpiece = named_tube("tube-40");
  workpiece.erase("kind");
  const Json tool = {{"number", 12}, {"shape", "ball"}, {"radius", 3}};
  return Json{{"job", "chamfer"}, {"workpiece", workpiece}, {"hole", "H1"},
              {"edge", "inner"},  {"tool", tool},           {"width", 0.5},
              {"points", points}, {"method", "section"}}
      .dump();
}

void require_ok(const jobs::Answer& answer) {
  if (jobs::is_error(answer)) throw std::runtime_error(answer.document.dump());
}

void points() {
  Table table("points of a loop", "job in-process [s] | its JSON as text [s] | memory [MB]");
  for (const int count : {1'000, 10'000, 100'000, 1'000'000, 2'000'000}) {
    const Alone run = alone([&] {
      jobs::Answer answer;
      const double solving =
          seconds([&] { answer = jobs::answer(job(count), "json", jobs::NoDefinitions()); });
      require_ok(answer);
      std::size_t bytes = 0;
      const double writing = seconds([&] { bytes = jobs::to_json(answer).size(); });
      return Figures{solving, writing, static_cast<double>(bytes)};
    });
    table.row(
        count, run.figures[0],
        fmt::format("{:.3f} | {:.3f} | {:.0f}", run.figures[0], run.figures[1], run.megabytes));
  }
}

void library() {
  Table table("workpieces in a library",
              "find by name [us] | put one more [ms] | open the file [ms] | memory [MB]");
  for (const int count : {10, 100, 1'000, 10'000, 100'000}) {
    const TemporaryFolder folder;
    alone([&] {
      service::Library all(folder / "all.db");
      std::vector<Json> batch;
      for (int i = 0; i < count; ++i) {
        batch.push_back(named_tube("tube-" + std::to_string(i)));
        if (batch.size() < 1'000 && i + 1 < count) continue;
        all.put_all(batch);
        batch.clear();
      }
      return Figures{};
    });
    const Alone run = alone([&] {
      std::unique_ptr<service::Library> all;
      const double opening =
          seconds([&] { all = std::make_unique<service::Library>(folder / "all.db"); });
      constexpr int finds = 2'000, puts = 20;
      const double finding = seconds([&] {
        for (int i = 0; i < finds; ++i)
          if (!all->find("workpiece", "tube-" + std::to_string(i * 7919 % count)))
            throw std::runtime_error("a definition is lost");
      });
      const double putting = seconds([&] {
        for (int i = 0; i < puts; ++i) all->put(named_tube("more-" + std::to_string(i)));
      });
      return Figures{finding / finds, putting / puts, opening};
    });
    table.row(count, run.figures[0],
              fmt::format("{:.1f} | {:.2f} | {:.2f} | {:.0f}", run.figures[0] * 1e6,
                          run.figures[1] * 1e3, run.figures[2] * 1e3, run.megabytes));
  }
}

/// Services in a domain of their own.
class Network : public Loopback {
public:
  void TestBody() override {}
  void add() { services_.push_back(start("s" + std::to_string(services_.size()))); }
  std::unique_ptr<client::Client> client() const {
    client::Options asked = options();
    asked.discovery = 30s;
    return std::make_unique<client::Client>(asked);
  }

private:
  std::vector<std::unique_ptr<Process>> services_;
};

void clients() {
  Table table("clients of one instance", "p50 [ms] | p99 [ms] | requests a second");
  Network network;
  network.add();
  for (const int count : {1, 2, 4, 8, 16, 32, 64}) {
    std::vector<std::unique_ptr<client::Client>> all;
    for (int i = 0; i < count; ++i) all.push_back(network.client());
    for (const auto& each : all) require_ok(each->echo("first"));
    std::atomic<std::size_t> next = 0;
    const Load measured = load(count, 4'000, [&] {
      thread_local std::size_t mine = next++ % all.size();
      require_ok(all[mine]->echo("x"));
    });
    table.row(count, measured.latency.p50,
              fmt::format("{:.2f} | {:.2f} | {:.0f}", measured.latency.p50 * 1e3,
                          measured.latency.p99 * 1e3, measured.rate));
  }
}

void instances() {
  Table table("instances, 16 jobs in flight", "seconds a job | jobs a second");
  Network network;
  const std::unique_ptr<client::Client> client = network.client();
  for (const std::size_t count : {1U, 2U, 3U, 4U}) {
    network.add();
    while (client->status(2s).size() < count) std::this_thread::sleep_for(50ms);
    const Load measured = load(16, 60, [&] { require_ok(client->ask(job(500), "json")); });
    table.row(static_cast<double>(count), 1 / measured.rate,
              fmt::format("{:.4f} | {:.0f}", 1 / measured.rate, measured.rate));
  }
}

}  // namespace

int main(int argc, char** argv) {
  jobs::keep_freed_memory();  // as the programs do
  const std::set<std::string> known = {"points", "library", "clients", "instances"};
  std::set<std::string> asked(argv + 1, argv + argc);
  for (const std::string& each : asked) {
    if (known.count(each) == 0) {
      std::cerr << "usage: bench_growth [points] [library] [clients] [instances]\n";
      return 2;
    }
  }
  if (asked.empty()) asked = known;
  try {
    if (asked.count("points") != 0) points();
    if (asked.count("library") != 0) library();
    if (asked.count("clients") != 0) clients();
    if (asked.count("instances") != 0) instances();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
