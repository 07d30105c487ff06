#include <csignal>
#include <cstring>
#include <map>
#include <set>
#include <thread>

#include "idl/domain.hpp"
#include "idl/topics.hpp"
#include "service/wire.hpp"
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using client::Patience;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr char put_tube[] = R"({"job": "library", "operation": "put", "definition":
  {"kind": "workpiece", "name": "tube-40", "shape": "thick_walled_cylinder", "inner_radius": 20,
   "outer_radius": 30, "length": 100,
   "holes": [{"name": "H1", "shape": "circle", "radius": 5}]}})";
constexpr char list[] = R"({"job": "library", "operation": "list"})";

TEST_F(Loopback, WithoutAServiceTheClientSaysSoInTime) {
  Client client(options());
  const auto begin = Clock::now();
  const jobs::Answer answer =
      client.ask(list, "json", {.timeout = 20s, .progress = {}, .stop = {}});
  EXPECT_EQ(code(answer), "no_service");
  EXPECT_LT(Clock::now() - begin, 5s);
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

/// A client of the plain topics, for what Client does not do.
struct Raw {
  explicit Raw(unsigned domain_id, const std::string& instance, dds::Topic topic)
      : domain(dds::Domain::open(domain_id)), participant(domain->participant()) {
    const dds::Qos in(dds_create_qos()), out(dds_create_qos());
    dds::set_partition(in, dds::client_partition("raw"));
    dds::set_partition(out, dds::instance_partition(instance));
    subscriber = {dds_create_subscriber(participant.get(), in.get(), nullptr), "subscriber"};
    publisher = {dds_create_publisher(participant.get(), out.get(), nullptr), "publisher"};
    reader = {
        dds_create_reader(subscriber.get(), dds::create_topic(participant, dds::Topic::Reply).get(),
                          dds::qos(dds::Topic::Reply).get(), nullptr),
        "reader"};
    writer = {dds_create_writer(publisher.get(), dds::create_topic(participant, topic).get(),
                                dds::qos(topic).get(), nullptr),
              "writer"};
  }
  bool is_matched() const {
    return !dds::matched_readers(writer).empty() && !dds::matched_writers(reader).empty();
  }
  wire::RequestId id(std::uint64_t number) const {
    wire::RequestId id;
    dds_guid_t guid;
    dds::check(dds_get_guid(writer.get(), &guid), "guid");
    std::copy_n(guid.v, 16, id.writer.begin());
    id.number = number;
    return id;
  }
  void send(const wire::RequestId& id, const char* job, wire::CallKind kind = wire::CallKind::Job) {
    const std::string instance, client = "raw", format = "json";
    const auto sample = wire::borrow({id, instance, client, format, 10}, {kind, job});
    dds::check(dds_write(writer.get(), &sample), "write");
  }
  /// Replies by request number and their error code, until `count` came or a second has gone.
  std::multimap<std::uint64_t, std::string> take(std::size_t count) {
    std::multimap<std::uint64_t, std::string> replies;
    for (const auto end = Clock::now() + 1s; replies.size() < count && Clock::now() < end;) {
      const dds::Taken<ridgeline_wire_Reply> taken(reader);
      taken.for_each([&](const ridgeline_wire_Reply& reply, const dds_sample_info_t&) {
        replies.emplace(wire::request_id(reply.header.relatedRequestId).number, reply.error.code);
      });
      std::this_thread::sleep_for(1ms);
    }
    return replies;
  }

  std::shared_ptr<const dds::Domain> domain;
  dds::Entity participant, subscriber, publisher, reader, writer;
};

TEST_F(Loopback, ChangesAreTakenOnTheirOwnTopicOnly) {
  const auto service = start("north");
  Raw compute(domain_, "north", dds::Topic::Request);
  ASSERT_TRUE(eventually([&] { return compute.is_matched(); }));
  compute.send(compute.id(1), put_tube);
  compute.send(compute.id(2), list);
  EXPECT_EQ(compute.take(2),
            (std::multimap<std::uint64_t, std::string>{{1, "unsupported"}, {2, ""}}));
  Raw change(domain_, "north", dds::Topic::Change);
  ASSERT_TRUE(eventually([&] { return change.is_matched(); }));
  change.send(change.id(1), put_tube);
  EXPECT_EQ(change.take(1), (std::multimap<std::uint64_t, std::string>{{1, ""}}));
}

TEST_F(Loopback, ARequestThatComesTwiceIsDoneOnceAndAnsweredTwice) {
  const auto service = start("north");
  Raw raw(domain_, "north", dds::Topic::Change);
  ASSERT_TRUE(eventually([&] { return raw.is_matched(); }));
  raw.send(raw.id(1), put_tube);
  EXPECT_EQ(raw.take(1).size(), 1u);
  raw.send(raw.id(2), R"({"job": "library", "operation": "remove", "kind": "workpiece",
                          "name": "tube-40"})");
  EXPECT_EQ(raw.take(1).size(), 1u);
  raw.send(raw.id(1), put_tube);
  EXPECT_EQ(raw.take(1).count(1), 1u);
  raw.send(raw.id(3), R"({"job": "library", "operation": "get", "kind": "workpiece",
                          "name": "tube-40"})");
  EXPECT_EQ(raw.take(1), (std::multimap<std::uint64_t, std::string>{{3, "unknown_definition"}}));
  Client client(options());
  EXPECT_TRUE(eventually([&] { return client.status(1s).at(0).duplicates == 1; }));
}

TEST_F(Loopback, NonsenseOnTheWireDoesNotHurt) {
  const auto service = start("north");
  Raw raw(domain_, "north", dds::Topic::Request);
  ASSERT_TRUE(eventually([&] { return raw.is_matched(); }));
  const std::string empty, raw_name = "raw", bad_name = "*", format = "\xff";
  for (const double timeout : {-1.0, 0.0, std::nan(""), 1e300}) {
    static std::uint64_t number = 10;
    const wire::RequestId id = raw.id(++number);
    auto sample = wire::borrow({id, empty, raw_name, format, timeout}, {wire::CallKind::Job, list});
    dds::check(dds_write(raw.writer.get(), &sample), "write");
    const wire::RequestId other = raw.id(++number);
    sample = wire::borrow({other, empty, bad_name, format, 1}, {wire::CallKind::Job, list});
    dds::check(dds_write(raw.writer.get(), &sample), "write");
  }
  for (const auto& [number, error] : raw.take(4)) EXPECT_EQ(error, "bad_input") << number;
  ridgeline_wire_ChamferJob chamfer{};
  char text[] = "", bad[] = "\xff\xfe";
  chamfer.workpiece = chamfer.hole = chamfer.tool = bad;
  chamfer.tool_axis = chamfer.dialect = chamfer.work_offset = text;
  chamfer.width = std::nan("");
  const wire::RequestId id = raw.id(1);
  const auto sample = wire::borrow({id, empty, raw_name, empty, 5}, chamfer);
  dds::check(dds_write(raw.writer.get(), &sample), "write");
  EXPECT_EQ(raw.take(1), (std::multimap<std::uint64_t, std::string>{{1, "bad_input"}}));
  raw.send(raw.id(2), list);
  EXPECT_EQ(raw.take(1), (std::multimap<std::uint64_t, std::string>{{2, ""}}));
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
