// Several instances on one network: who is there, who takes over, what they share.
#include <csignal>
#include <set>
#include <thread>

#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Clock = std::chrono::steady_clock;

TEST_F(Loopback, StatusShowsEveryInstance) {
  const auto north = start("north", {"--workers", "3"});
  const auto south = start("south");
  Client client(options());
  ASSERT_TRUE(eventually([&] { return client.status(2s).size() == 2; }));
  client.echo("x");
  ASSERT_TRUE(eventually([&] {
    const auto status = client.status(2s);
    return status[0].requests + status[1].requests == 1;
  }));
  const auto status = client.status(2s);
  EXPECT_EQ(status[0].name, "north");
  EXPECT_EQ(status[0].workers, 3u);
  EXPECT_EQ(status[0].version, status[1].version);
  EXPECT_EQ(status[1].pid, south->pid());
  EXPECT_GT(status[1].memory, 1'000'000u);
  EXPECT_EQ(status[0].answers.front().first, "ok");
  client::Options one = options();
  one.instance = "south";
  ASSERT_EQ(Client(one).status(10s).size(), 1u);
  EXPECT_EQ(Client(one).status(10s)[0].pid, south->pid());
  south->signal(SIGKILL);
  EXPECT_TRUE(eventually([&] { return client.status(1s).size() == 1; }, 3s));
  EXPECT_TRUE(Client(one).status(500ms).empty());
}

TEST_F(Loopback, ASecondInstanceOfTheSameNameGoesAway) {
  const auto first = start("north");
  Client client(options());
  EXPECT_EQ(code(client.echo("x")), "ok");
  Process second(daemon_command("north"), folder_ / "second.log");
  EXPECT_EQ(second.wait(10s), 1);
  EXPECT_EQ(code(client.echo("x")), "ok");
}

TEST_F(Loopback, WorkIsAskedAgainElsewhereWhenAnInstanceDies) {
  auto north = start("north");
  auto south = start("south");
  Client client(options());
  ASSERT_TRUE(eventually([&] { return client.status(2s).size() == 2; }));
  std::atomic<bool> is_over = false;
  std::atomic<int> wrong = 0, answered = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; !is_over; ++i) {
        const std::string text = std::to_string(t) + "/" + std::to_string(i);
        const jobs::Answer answer = client.echo(text);
        wrong += answer.text == text ? 0 : 1;
        ++answered;
      }
    });
  for (auto* service : {&north, &south, &north}) {
    std::this_thread::sleep_for(300ms);
    (*service)->signal(SIGKILL);
    (*service)->wait(10s);
    const int before = answered;
    EXPECT_TRUE(eventually([&] { return answered > before + 20; }));
    *service = start(service == &north ? "north" : "south");
  }
  is_over = true;
  threads.clear();
  EXPECT_EQ(wrong, 0);
}

TEST_F(Loopback, ARequestOutlivesTheRestartOfTheOnlyInstance) {
  auto service = start("north");
  Client client(options());
  ASSERT_EQ(code(client.echo("x")), "ok");
  service->signal(SIGSTOP);  // takes the request and cannot answer
  std::string text;
  std::jthread asks([&] { text = client.echo("again").text; });
  std::this_thread::sleep_for(500ms);
  service->signal(SIGKILL);
  service->wait(10s);
  service = start("north");
  asks.join();
  EXPECT_EQ(text, "again");
}

TEST_F(Loopback, ALostInstanceIsNamedWithinTheAbsence) {
  auto service = start("north");
  client::Options impatient = options();
  impatient.absence = 500ms;
  Client client(impatient);
  ASSERT_EQ(code(client.echo("x")), "ok");
  service->signal(SIGKILL);
  const auto begin = Clock::now();
  const jobs::Answer answer = client.echo("x");
  EXPECT_EQ(code(answer), "no_service") << answer.document;
  EXPECT_LT(Clock::now() - begin, 4s);
}

TEST_F(Loopback, TheLibraryIsSharedByAllInstances) {
  auto north = start("north");
  auto south = start("south");
  client::Options to_north = options(), to_south = options(), to_west = options();
  to_north.instance = "north";
  to_south.instance = "south";
  to_west.instance = "west";
  ASSERT_EQ(code(Client(to_north).ask(put_tube, "json")), "ok");
  constexpr char get[] =
      R"({"job": "library", "operation": "get", "kind": "workpiece", "name": "tube-40"})";
  Client south_client(to_south);
  EXPECT_TRUE(eventually([&] { return code(south_client.ask(get, "json")) == "ok"; }, 3s));
  north->signal(SIGKILL);  // the one where it was put
  const auto west = start("west");
  Client west_client(to_west);
  EXPECT_TRUE(eventually([&] { return code(west_client.ask(get, "json")) == "ok"; }, 3s));
  EXPECT_EQ(code(west_client.ask(R"({"job": "library", "operation": "remove", "kind": "workpiece",
                                     "name": "tube-40"})",
                                 "json")),
            "ok");
  EXPECT_TRUE(
      eventually([&] { return code(south_client.ask(get, "json")) == "unknown_definition"; }, 3s));
  north = start("north");  // has been away
  Client north_client(to_north);
  EXPECT_TRUE(
      eventually([&] { return code(north_client.ask(get, "json")) == "unknown_definition"; }, 5s));
  EXPECT_TRUE(eventually([&] {
    std::set<std::uint64_t> digests;
    const auto status = south_client.status(1s);
    for (const auto& each : Client(options()).status(1s)) digests.insert(each.library_digest);
    return digests.size() == 1;
  }));
}

}  // namespace
}  // namespace ridgeline
