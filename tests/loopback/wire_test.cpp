// The topics as any DDS client sees them: what `Client` never does.
#include <cmath>
#include <map>
#include <thread>

#include "idl/domain.hpp"
#include "idl/topics.hpp"
#include "service/wire.hpp"
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Clock = std::chrono::steady_clock;

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
  /// Replies by request number and their error code, until `count` came or ten seconds have gone.
  std::multimap<std::uint64_t, std::string> take(std::size_t count) {
    std::multimap<std::uint64_t, std::string> replies;
    for (const auto end = Clock::now() + slowness * 10s;
         replies.size() < count && Clock::now() < end;) {
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
  const auto refused = raw.take(4);
  EXPECT_EQ(refused.size(), 4u);
  for (const auto& [number, error] : refused) EXPECT_EQ(error, "bad_input") << number;
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

}  // namespace
}  // namespace ridgeline
