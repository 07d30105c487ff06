// What the way to the service costs, each figure beside its floor and in the same run:
//   bench_service [REQUESTS]      (default 2000)
// Exit status 1 when a small job costs more than 1.5 x an empty request and reply plus its
// computation.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "clients/client.hpp"
#include "jobs/answer.hpp"
#include "jobs/memory.hpp"
#include "service/library.hpp"
#include "tests/bench/service/bare.hpp"
#include "tests/bench/service/load.hpp"
#include "tests/loopback/network.hpp"
#include "tests/support/named_tube.hpp"

namespace {

using namespace ridgeline;
using namespace ridgeline::bench;

constexpr char small_job[] = R"({"job": "chamfer", "workpiece": "tube-40", "hole": "H1",
  "edge": "inner", "tool": 12, "width": 0.5, "points": 8, "method": "section"})";
constexpr double allowed_ratio = 1.5;

void must_be_ok(const jobs::Answer& answer) {
  if (!jobs::is_error(answer)) return;
  std::cerr << answer.document << '\n';
  std::exit(2);
}

void print(const std::string& what, const Load& load) {
  std::cout << fmt::format("{:44} p50 {:8.1f} us   p99 {:8.1f} us   {:8.0f} /s\n", what,
                           load.latency.p50 * 1e6, load.latency.p99 * 1e6, load.rate);
}

/// The services, in a domain of their own.
class Bench : public Loopback {
public:
  Bench() {
    service::Library library(folder_ / "north.db");
    library.put(named_tube("tube-40"));
    library.put(nlohmann::json::parse(
        R"({"kind": "tool", "number": 12, "name": "b6", "shape": "ball", "radius": 3})"));
    service_ = start("north", {"--log-level", "warning"});
    bare_ = std::make_unique<Process>(
        std::vector<std::string>{"/proc/self/exe", "--bare", std::to_string(domain_)},
        folder_ / "bare.log");
  }
  void TestBody() override {}
  unsigned domain() const { return domain_; }
  std::filesystem::path library() const { return folder_ / "north.db"; }
  client::Client client(const std::string& instance) const {
    client::Options asked = options();
    asked.instance = instance;
    if (instance == "bare") asked.name = bench::bare_client;
    asked.discovery = 20s;
    return client::Client(asked);
  }

private:
  std::unique_ptr<Process> service_, bare_;
};

/// What a job spends in its own computation, as its report says.
double own_seconds(const jobs::Answer& answer) {
  const nlohmann::json& report = answer.document.at("report");
  return report.at("solve_seconds").get<double>() + report.at("verify_seconds").get<double>();
}

/// Asks of three kinds, one after the other, so that each meets the same machine.
bool compare_small(const Bench& bench, int count) {
  client::Client service = bench.client("north"), bare = bench.client("bare");
  const auto echo = [&] { must_be_ok(service.echo("")); };
  const auto bare_echo = [&] { must_be_ok(bare.echo("")); };
  jobs::Answer answer;
  const auto job = [&] { must_be_ok(answer = service.ask(small_job, "json")); };
  const service::Library library(bench.library());
  const auto here = [&] { must_be_ok(answer = jobs::answer(small_job, "json", library)); };
  for (int i = 0; i < 100; ++i) echo(), bare_echo(), job(), here();

  std::vector<double> times[5];
  for (int i = 0; i < count; ++i) {
    times[0].push_back(seconds(bare_echo));
    times[1].push_back(seconds(echo));
    times[2].push_back(seconds(job));
    times[3].push_back(times[2].back() - own_seconds(answer));
    const double in_process = seconds(here);
    times[4].push_back(in_process - own_seconds(answer));
  }
  const char* const names[5] = {"bare echo (one thread, same topics)", "empty request and reply",
                                "small chamfer job", "the same without solving and verifying",
                                "as much of it in-process"};
  Quantiles q[5];
  for (int i = 0; i < 5; ++i) {
    q[i] = quantiles(times[i]);
    print(names[i], {q[i], 1 / q[i].p50});
  }
  const double ratio = (q[3].p50 - q[4].p50) / q[1].p50;
  std::cout << fmt::format("(job - the job in-process) / empty: p50 {:.2f}; allowed {}\n", ratio,
                           allowed_ratio)
            << fmt::format("empty / bare echo: p50 {:.2f}, p99 {:.2f}\n\n", q[1].p50 / q[0].p50,
                           q[1].p99 / q[0].p99);
  for (const int in_flight : {1, 8, 32}) {
    const Load floor = load(in_flight, count, bare_echo), ours = load(in_flight, count, echo);
    print(fmt::format("bare echo, {} in flight", in_flight), floor);
    print(fmt::format("empty request, {} in flight", in_flight), ours);
    std::cout << fmt::format("ratio: p50 {:.2f}, p99 {:.2f}\n",
                             ours.latency.p50 / floor.latency.p50,
                             ours.latency.p99 / floor.latency.p99);
  }
  return ratio <= allowed_ratio;
}

/// A large answer: asked again under the same id it is sent from what was computed.
void compare_large(const Bench& bench, int points) {
  const std::string job = fmt::format(
      R"({{"job": "chamfer", "workpiece": "tube-40", "hole": "H1", "edge": "inner", "tool": 12,
          "width": 0.5, "points": {}, "method": "section"}})",
      points);
  bench::Requester service(bench.domain(), "north", "bench-north");
  bench::Requester bare(bench.domain(), "bare", bench::bare_client);
  const std::size_t bytes = service.ask(1, job, wire::CallKind::Job);
  std::vector<double> times[3];
  for (std::uint64_t i = 0; i < 15; ++i) {
    times[0].push_back(bench::tcp_seconds(bytes));
    times[1].push_back(
        seconds([&] { bare.ask(i + 1, "bulk " + std::to_string(bytes), wire::CallKind::Job); }));
    times[2].push_back(seconds([&] { service.ask(1, job, wire::CallKind::Job); }));
  }
  const char* const names[] = {"TCP", "bare chunks, same topics", "the service"};
  std::cout << fmt::format("\nanswer of {:.1f} MB:\n", static_cast<double>(bytes) / 1e6);
  const double floor = quantiles(times[0]).p50;
  for (int i = 0; i < 3; ++i) {
    const double p50 = quantiles(times[i]).p50;
    std::cout << fmt::format("{:44} p50 {:8.1f} ms   {:.2f} x TCP\n", names[i], p50 * 1e3,
                             p50 / floor);
  }
}

}  // namespace

int main(int argc, char** argv) {
  jobs::keep_freed_memory();  // as the programs do
  if (argc == 3 && std::string(argv[1]) == "--bare") {
    bench::answer_bare(static_cast<unsigned>(std::stoul(argv[2])));
    return 0;
  }
  const int count = argc > 1 ? std::atoi(argv[1]) : 2000;
  if (count < 100) {
    std::cerr << "usage: bench_service [REQUESTS]     at least 100\n";
    return 2;
  }
  const Bench bench;
  const bool is_good = compare_small(bench, count);
  compare_large(bench, 60'000);
  return is_good ? 0 : 1;
}
