#include <csignal>
#include <cstring>
#include <thread>

#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Clock = std::chrono::steady_clock;

TEST_F(Loopback, WithoutAServiceTheClientSaysSoInTime) {
  Client client(options());
  const auto begin = Clock::now();
  const jobs::Answer answer =
      client.ask(list, "json", {.timeout = 20s, .progress = {}, .stop = {}});
  EXPECT_EQ(code(answer), "no_service");
  EXPECT_LT(Clock::now() - begin, slowness * 5s);
  EXPECT_EQ(code(client.ask(list, "json", {.timeout = 100ms, .progress = {}, .stop = {}})),
            "no_service");
  EXPECT_TRUE(client.status(100ms).empty());
}

TEST_F(Loopback, AClientThatIsThereFirstIsAnswered) {
  client::Options patient = options();
  patient.discovery = 20s;
  Client client(patient);
  std::string text;
  std::jthread asks([&] { text = client.echo("hello").text; });
  std::this_thread::sleep_for(300ms);
  const auto service = start("late");
  asks.join();
  EXPECT_EQ(text, "hello");
}

TEST_F(Loopback, EchoesAndStopsCleanly) {
  const auto service = start("north");
  Client client(options());
  const jobs::Answer answer = client.echo("hello");
  EXPECT_EQ(code(answer), "ok");
  EXPECT_EQ(answer.text, "hello");
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(10s), 0);
  EXPECT_EQ(events("north", "stopped").size(), 1u);
}

TEST_F(Loopback, TheLibraryOverDdsIsTheLibraryInTheFile) {
  {
    const auto service = start("north");
    Client client(options());
    const jobs::Answer put = client.ask(put_tube, "json");
    EXPECT_EQ(put.document.at("revision"), 1) << put.document;
    service->signal(SIGKILL);
    EXPECT_EQ(service->wait(10s), 128 + SIGKILL);
  }
  const auto service = start("north");
  Client client(options());
  const jobs::Answer got = client.ask(
      R"({"job": "library", "operation": "get", "kind": "workpiece", "name": "tube-40"})", "json");
  EXPECT_EQ(got.document.at("definition").at("inner_radius"), 20) << got.document;
}

TEST_F(Loopback, RefusesWhatIsWrongAndGoesOn) {
  const auto service = start("north");
  Client client(options());
  std::string deep(100'000, '[');
  const std::vector<std::string> wrong = {
      "",
      "not JSON",
      "{",
      "[]",
      "null",
      "{}",
      R"({"job": 7})",
      R"({"job": "sing"})",
      R"({"job": "library"})",
      R"({"job": "library", "operation": "put"})",
      R"({"job": "service", "operation": "explode"})",
      "\xff\xfe",
      deep,
      R"({"job": "library", "operation": "put", "definition": )" + deep,
      "{\"job\": \"library\", \"operation\": \"list\", \"x\": \"" + std::string(33'000'000, 'x') +
          "\"}"};
  for (const std::string& job : wrong) {
    const jobs::Answer answer = client.ask(job, "json");
    EXPECT_EQ(code(answer), "bad_input") << job.substr(0, 100) << answer.document;
    EXPECT_FALSE(answer.document["error"]["message"].get<std::string>().empty());
  }
  EXPECT_EQ(code(client.ask(std::string("{}\0{}", 5), "json")), "bad_input");
  EXPECT_EQ(code(client.ask(std::string(65'000'000, ' '), "json")), "bad_input");
  EXPECT_EQ(code(client.ask(list, "poem")), "unsupported");
  EXPECT_EQ(code(client.ask(list, "json")), "ok");
}

TEST_F(Loopback, AnswersOfManyMegabytesComeWhole) {
  const auto service = start("north");
  Client client(options());
  std::string text(8'000'000, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>('a' + i * i % 23);
  EXPECT_TRUE(client.echo(text).text == text);
}

TEST_F(Loopback, ManyClientsAtOnceEachGetTheirOwn) {
  const auto service = start("north");
  constexpr int clients = 8, each = 100;
  std::atomic<int> answered = 0;
  {
    std::vector<std::jthread> threads;
    for (int c = 0; c < clients; ++c)
      threads.emplace_back([&, c] {
        Client client(options());
        for (int i = 0; i < each; ++i) {
          const std::string text = std::to_string(c) + "/" + std::to_string(i);
          const jobs::Answer answer = client.echo(text);
          EXPECT_EQ(answer.text, text) << answer.document;
          answered += answer.text == text ? 1 : 0;
        }
      });
  }
  EXPECT_EQ(answered, clients * each);
}

TEST_F(Loopback, OneClientFromManyThreads) {
  const auto service = start("north");
  Client client(options());
  std::atomic<int> answered = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 100; ++i) {
          const std::string text = std::to_string(t) + "/" + std::to_string(i);
          answered += client.echo(text).text == text ? 1 : 0;
        }
      });
  }
  EXPECT_EQ(answered, 800);
}

TEST_F(Loopback, AFreshClientIsAnsweredByAFreshService) {
  for (int round = 0; round < 5; ++round) {
    const auto service = start("fresh-" + std::to_string(round));
    Client client(options());
    const jobs::Answer answer = client.echo("first");
    EXPECT_EQ(answer.text, "first") << answer.document;
  }
}

TEST_F(Loopback, LogLevelChangesAtRunTime) {
  const auto service = start("north");
  Client client(options());
  client.echo("logged");
  EXPECT_EQ(
      code(client.ask(R"({"job": "service", "operation": "log_level", "level": "error"})", "json")),
      "ok");
  client.echo("silent");
  const jobs::Answer status = client.ask(R"({"job": "service", "operation": "status"})", "json");
  EXPECT_EQ(status.document.at("instance").at("log_level"), "error");
  EXPECT_EQ(
      code(client.ask(R"({"job": "service", "operation": "log_level", "level": "loud"})", "json")),
      "bad_input");
  EXPECT_EQ(events("north", "request").size(), 1u);
  EXPECT_EQ(events("north", "request")[0].at("operation"), "echo");
}

TEST_F(Loopback, CheckSaysWhatIsWrong) {
  Process good(daemon_command("north", {"--check"}), folder_ / "check.log");
  EXPECT_EQ(good.wait(10s), 0);
  std::vector<std::string> command = daemon_command("north", {"--check"});
  command[6] = "/dev/null/library.db";
  EXPECT_EQ(Process(command, folder_ / "check.log").wait(10s), 1);
  setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>", 1);
  EXPECT_EQ(Process(daemon_command("north", {"--check"}), folder_ / "check.log").wait(10s), 1);
  unsetenv("CYCLONEDDS_URI");
  EXPECT_EQ(Process({RIDGELINED, "--domain", "231"}, folder_ / "check.log").wait(10s), 2);
  EXPECT_EQ(Process({RIDGELINED, "--instance", "a b"}, folder_ / "check.log").wait(10s), 2);
}

}  // namespace
}  // namespace ridgeline
