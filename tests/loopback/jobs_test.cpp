#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "jobs/answer.hpp"
#include "service/library.hpp"
#include "service/library_job.hpp"
#include "tests/loopback/network.hpp"
#include "tests/support/typed_chamfer.hpp"

namespace ridgeline {
namespace {

using client::Client;
using client::Patience;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr char definitions[] = R"({"job": "library", "operation": "import", "definitions": [
  {"kind": "workpiece", "name": "tube-40", "shape": "thick_walled_cylinder", "inner_radius": 20,
   "outer_radius": 30, "length": 100,
   "holes": [{"name": "H1", "shape": "circle", "radius": 5}]},
  {"kind": "tool", "number": 12, "name": "lollipop 6", "shape": "lollipop", "radius": 3,
   "neck_radius": 1.5, "neck_length": 40}]})";

Json by_name() {
  return {{"job", "chamfer"}, {"workpiece", "tube-40"}, {"hole", "H1"}, {"edge", "inner"},
          {"tool", 12},       {"width", 0.5},           {"points", 72}};
}

Json inlined() {
  const Json all = Json::parse(definitions).at("definitions");
  Json job = by_name();
  job["workpiece"] = all[0];
  job["tool"] = all[1];
  for (const char* key : {"workpiece", "tool"}) job[key].erase("kind");
  return job;
}

/// Some seconds of work with 2,000,000 points; a fraction of a second with 100,000.
std::string long_job(int points = 2'000'000) {
  Json job = inlined();
  job["points"] = points;
  return job.dump();
}

void erase_times(Json& value) {
  if (value.is_object())
    for (const char* key : {"solve_seconds", "verify_seconds"}) value.erase(key);
  if (value.is_structured())
    for (Json& each : value) erase_times(each);
}

/// The result without what differs each time.
Json lasting(const jobs::Answer& answer) {
  Json document = jobs::assemble(answer);
  erase_times(document);
  return document;
}

/// A service with the definitions, and a client of it.
class LoopbackJobs : public Loopback {
protected:
  void SetUp() override {
    service_ = start("north");
    client_ = std::make_unique<Client>(options());
    ASSERT_EQ(code(client_->ask(definitions, "json")), "ok");
  }
  bool is_running(unsigned jobs) {
    return eventually([&] { return client_->status(1s).at(0).running >= jobs; });
  }

  std::unique_ptr<Process> service_;
  std::unique_ptr<Client> client_;
};

TEST_F(LoopbackJobs, AnswerAsTheSameCodeInProcess) {
  service::Library library(":memory:");
  service::answer_library(Json::parse(definitions), library);
  const auto expect_same = [&](const Json& job, const char* format) {
    SCOPED_TRACE(job.at("job").get<std::string>() + " " + format);
    const jobs::Answer there = client_->ask(job.dump(), format);
    const jobs::Answer here = jobs::answer(job.dump(), format, library);
    EXPECT_EQ(code(there), code(here)) << there.document;
    EXPECT_TRUE(lasting(there) == lasting(here));
    EXPECT_TRUE(there.text == here.text);
    return there;
  };
  for (const char* format : {"json", "nc", "csv", "cl", "svg", "macro"}) {
    const jobs::Answer there = expect_same(by_name(), format);
    ASSERT_EQ(code(there), "ok") << there.document;
    EXPECT_EQ(there.text.empty(), format == std::string("json"));
  }
  expect_same(by_name(), "html");  // the page, or its refusal where no viewer was built
  EXPECT_EQ(client_->ask(by_name().dump(), "json").document.at("tool").at("revision"), 1);

  const std::string program = jobs::answer(by_name().dump(), "nc", library).text;
  const Json verify = {{"job", "verify"}, {"program", program}, {"against", by_name()}};
  EXPECT_EQ(code(expect_same(verify, "json")), "ok");
  const Json names = {{"W", {{"1", "tube-40"}}}, {"H", {{"1", "H1"}}}};
  const Json expand = {{"job", "expand"},
                       {"program", "%\nG90 G54\nG65 P9100 W1 H1 T12 V0.5 E1\nM30\n%\n"},
                       {"binding", {{"macros", {{{"number", 9100}, {"names", names}}}}}}};
  EXPECT_EQ(code(expect_same(expand, "nc")), "ok");
}

TEST_F(LoopbackJobs, ByNameAndInlineGiveTheSamePath) {
  const Json named = lasting(client_->ask(by_name().dump(), "json"));
  const Json inline_ = lasting(client_->ask(inlined().dump(), "json"));
  EXPECT_EQ(named.at("centres"), inline_.at("centres"));
  EXPECT_EQ(named.at("moves"), inline_.at("moves"));
}

TEST_F(LoopbackJobs, TypedAndJsonGiveTheSamePath) {
  ridgeline_wire_ChamferJob chamfer = typed_chamfer();
  chamfer.given = ridgeline_wire_GIVEN_POINTS;
  chamfer.points = 72;
  const jobs::Answer answer = client_->ask(chamfer, "json");
  EXPECT_TRUE(lasting(answer) == lasting(client_->ask(by_name().dump(), "json")));
  ridgeline_wire_ChamferJob wrong = chamfer;
  char other[] = "13";
  wrong.tool = other;
  EXPECT_EQ(code(client_->ask(wrong, "json")), "unknown_tool");
  wrong = chamfer;
  wrong.width = 50;
  EXPECT_EQ(code(client_->ask(wrong, "json")), "width_too_large");
}

TEST_F(LoopbackJobs, EveryRejectedJobKeepsItsCodeOverDds) {
  service::Library library(":memory:");
  service::answer_library(Json::parse(definitions), library);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RIDGELINE_TESTS "/rejected")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json") continue;
    std::stringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    const std::string here = code(jobs::answer(text.str(), "json", library));
    EXPECT_NE(here, "ok");
    EXPECT_EQ(code(client_->ask(text.str(), "json")), here) << name;
    ++count;
  }
  EXPECT_GT(count, 50);
  EXPECT_EQ(code(client_->ask(by_name().dump(), "json")), "ok");
  EXPECT_EQ(client_->status(1s).at(0).pid, service_->pid());
}

TEST_F(LoopbackJobs, ManyPointsComeWholeAndDoNotHoldUpSmallJobs) {
  std::atomic<bool> is_done = false;
  jobs::Answer large;
  std::jthread asks([&] {
    large = client_->ask(long_job(300'000), "json");
    is_done = true;
  });
  ASSERT_TRUE(is_running(1));
  Client other(options());
  int small = 0;
  while (!is_done) {
    const auto begin = Clock::now();
    ASSERT_EQ(code(other.echo("small")), "ok");
    EXPECT_LT(Clock::now() - begin, slowness * 2s);
    ++small;
    std::this_thread::sleep_for(5ms);
  }
  asks.join();
  ASSERT_EQ(code(large), "ok") << large.document;
  EXPECT_GT(small, 20);
  const auto centres = std::ranges::find(large.arrays, "/centres", &jobs::Array::pointer);
  ASSERT_NE(centres, large.arrays.end());
  EXPECT_GE(centres->values.size(), 900'000u);
}

TEST_F(LoopbackJobs, ProgressIsToldTwiceASecondAndCancelStopsTheWork) {
  std::stop_source stop;
  std::vector<double> fractions;
  std::vector<Clock::time_point> times;
  const auto begin = Clock::now();
  const jobs::Answer answer = client_->ask(long_job(), "json",
                                           {.timeout = 60s,
                                            .progress =
                                                [&](const client::ProgressReport& report) {
                                                  fractions.push_back(report.fraction);
                                                  times.push_back(Clock::now());
                                                  if (Clock::now() - begin > 1200ms)
                                                    stop.request_stop();
                                                },
                                            .stop = stop.get_token()});
  EXPECT_EQ(code(answer), "cancelled");
  ASSERT_GE(times.size(), 3u);
  for (const double fraction : fractions) EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
  const auto cancelled = Clock::now();
  EXPECT_TRUE(eventually([&] { return client_->status(1s).at(0).running == 0; }));
  EXPECT_LT(Clock::now() - cancelled, slowness * 2s);
  EXPECT_EQ(code(client_->ask(by_name().dump(), "json")), "ok");
}

TEST_F(LoopbackJobs, ATimeoutIsNamedAndEndsTheWork) {
  const auto begin = Clock::now();
  const jobs::Answer answer =
      client_->ask(long_job(), "json", {.timeout = 500ms, .progress = {}, .stop = {}});
  EXPECT_EQ(code(answer), "timeout");
  EXPECT_LT(Clock::now() - begin, slowness * 1s);
  EXPECT_TRUE(eventually([&] { return client_->status(1s).at(0).running == 0; }));
  ASSERT_TRUE(eventually([&] { return events("north", "request").size() >= 2; }));
  const std::string logged = events("north", "request").back().at("id");
  EXPECT_NE(answer.document.dump().find(logged), std::string::npos) << answer.document << logged;
}

TEST_F(LoopbackJobs, TerminatedItFinishesWhatItIsComputing) {
  jobs::Answer answer;
  std::jthread asks([&] { answer = client_->ask(long_job(100'000), "json"); });
  ASSERT_TRUE(is_running(1));
  service_->signal(SIGTERM);
  asks.join();
  EXPECT_EQ(code(answer), "ok") << answer.document;
  EXPECT_EQ(service_->wait(20s), 0);
  EXPECT_EQ(events("north", "request").back().at("delivery"), "sent");
}

// A client that stops in the middle of a large answer, and one that watches.
TEST_F(LoopbackJobs, WhileItsLastAnswerIsTakenSlowlyItIsNotLost) {
  const std::string file = (folder_ / "large.json").string();
  std::ofstream(file) << long_job(100'000);
  const Process slow({RIDGELINE, "--domain", std::to_string(domain_), "--quiet", "chamfer", file,
                      "-o", (folder_ / "large.out").string()},
                     folder_ / "slow.log");
  ASSERT_TRUE(is_running(1));
  slow.signal(SIGSTOP);
  service_->signal(SIGTERM);
  ASSERT_TRUE(eventually([&] {
    const auto all = client_->status(1s);
    return !all.empty() && all.at(0).running == 0;
  }));
  // Longer than the lease; a client that is not there is given up after 3 s.
  for (const auto end = Clock::now() + 1500ms; Clock::now() < end;) {
    ASSERT_EQ(client_->status(100ms).size(), 1u);
    std::this_thread::sleep_for(20ms);
  }
  slow.signal(SIGCONT);
  EXPECT_EQ(service_->wait(20s), 0);
}

TEST_F(LoopbackJobs, TerminatedTwiceItCancels) {
  jobs::Answer answer;
  std::jthread asks([&] { answer = client_->ask(long_job(), "json"); });
  ASSERT_TRUE(is_running(1));
  service_->signal(SIGTERM);
  std::this_thread::sleep_for(50ms);
  service_->signal(SIGTERM);
  EXPECT_EQ(service_->wait(5s), 0);
  asks.join();
  EXPECT_EQ(code(answer), "cancelled");
}

TEST_F(LoopbackJobs, AnInstanceKilledInMidRequestIsReplacedByAnother) {
  const auto south = start("south");
  ASSERT_TRUE(eventually([&] { return client_->status(1s).size() == 2; }));
  jobs::Answer answer;
  std::jthread asks([&] { answer = client_->ask(long_job(100'000), "json"); });
  std::string computes;
  ASSERT_TRUE(eventually([&] {
    for (const auto& each : client_->status(1s))
      if (each.running > 0) computes = each.name;
    return !computes.empty();
  }));
  (computes == "north" ? *service_ : *south).signal(SIGKILL);
  asks.join();
  EXPECT_EQ(code(answer), "ok") << answer.document;
}

/// Holds a file the lines "x y z" of these points?
void expect_centres(const std::string& file, const Json& expected) {
  std::ifstream stream(file);
  std::size_t count = 0;
  for (double x = 0, y = 0, z = 0; stream >> x >> y >> z; ++count) {
    ASSERT_LT(count, expected.size());
    EXPECT_EQ(Json({x, y, z}), expected[count]);
  }
  EXPECT_EQ(count, expected.size());
  EXPECT_GT(count, 0u);
}

TEST_F(LoopbackJobs, AControllerInPlainCAsksWithoutJson) {
  const std::string out = (folder_ / "centres").string();
  const std::string uri = "file://" RIDGELINE_SOURCE "/service/config/loopback.xml";
  setenv("CYCLONEDDS_URI", uri.c_str(), 1);
  const std::string domain = std::to_string(domain_);
  const auto run = [&](const std::string& tool) {
    return Process({"/bin/sh", "-c", "exec \"$@\" >" + out, "sh", CONTROLLER, "-d", domain, "-t",
                    "20", "tube-40", "H1", "inner", "entry", tool, "0.5"},
                   folder_ / "controller.log")
        .wait(30s);
  };
  EXPECT_EQ(run("12"), 0);
  Json job = by_name();
  job.erase("points");
  const Json expected = lasting(client_->ask(job.dump(), "json")).at("centres");
  expect_centres(out, expected);
  EXPECT_EQ(run("13"), 1);
  std::stringstream log;
  log << std::ifstream(folder_ / "controller.log").rdbuf();
  EXPECT_NE(log.str().find("unknown_tool"), std::string::npos) << log.str();
  service_->signal(SIGTERM);
  EXPECT_EQ(service_->wait(10s), 0);
  EXPECT_EQ(Process({CONTROLLER, "-d", domain, "-t", "0.5", "a", "b", "inner", "entry", "1", "1"},
                    folder_ / "controller.log")
                .wait(5s),
            3);
  unsetenv("CYCLONEDDS_URI");
}

TEST_F(Loopback, AClientOnAnotherDdsAsksWithTheSameIdl) {
  setenv("DDS_TAG", "", 1);  // only Cyclone DDS knows tags
  const auto service = start("north");
  Client client(options());
  ASSERT_EQ(code(client.ask(definitions, "json")), "ok");
  const std::string out = (folder_ / "centres").string();
  const std::string domain = std::to_string(domain_);
  const auto run = [&](const std::string& tool, const std::string& points) {
    return Process({"/bin/sh", "-c", "exec \"$@\" >" + out, "sh", FAST_CLIENT, domain,
                    std::to_string(slowness * 20), "tube-40", "H1", tool, "0.5", points},
                   folder_ / "fast.log")
        .wait(30s);
  };
  EXPECT_EQ(run("12", "72"), 0);
  expect_centres(out, lasting(client.ask(by_name().dump(), "json")).at("centres"));
  EXPECT_EQ(run("12", "60000"), 0);  // some forty chunks
  Json many = by_name();
  many["points"] = 60'000;
  expect_centres(out, lasting(client.ask(many.dump(), "json")).at("centres"));
  EXPECT_EQ(run("13", "72"), 1);
  std::stringstream log;
  log << std::ifstream(folder_ / "fast.log").rdbuf();
  EXPECT_NE(log.str().find("unknown_tool"), std::string::npos) << log.str();
}

}  // namespace
}  // namespace ridgeline
