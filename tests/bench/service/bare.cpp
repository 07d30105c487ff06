#include "tests/bench/service/bare.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <stdexcept>
#include <thread>

#include "service/chunks.hpp"

namespace ridgeline::bench {
namespace {

using namespace std::chrono_literals;

dds::Entity endpoint_parent(const dds::Entity& participant, const std::string& partition,
                            bool is_publisher) {
  const dds::Qos qos(dds_create_qos());
  dds::set_partition(qos, partition);
  return {is_publisher ? dds_create_publisher(participant.get(), qos.get(), nullptr)
                       : dds_create_subscriber(participant.get(), qos.get(), nullptr),
          "parent"};
}

dds::Entity reader(const dds::Entity& participant, const dds::Entity& parent, dds::Topic topic) {
  return {dds_create_reader(parent.get(), dds::create_topic(participant, topic).get(),
                            dds::qos(topic).get(), nullptr),
          "reader"};
}

struct Writer {
  dds::Entity publisher, writer;
};

void announce(const dds::Entity& writer) {
  wire::InstanceStatus status;
  status.name = "bare";
  status.started = 1;
  wire::with_sample(status, [&](const ridgeline_wire_Instance& sample) {
    dds::check(dds_write(writer.get(), &sample), "announce");
  });
}

void reply(const dds::Entity& writer, const ridgeline_wire_Request& request) {
  static std::uint64_t number = 0;
  const std::string text =
      request.call._d == ridgeline_wire_OPERATION_ECHO ? request.call._u.echo : request.call._u.job;
  jobs::Answer answer;
  answer.document = {{"job", "echo"}, {"status", "ok"}};
  if (text.starts_with("bulk ")) {
    const std::size_t count = std::stoul(text.substr(5)) / sizeof(double);
    answer.arrays.push_back({"/bulk", {count}, std::vector<double>(count, 1.25)});
  } else {
    answer.text = text;
  }
  const wire::Chunks chunks(std::move(answer), ++number);
  for (std::uint32_t i = 0; i < chunks.count();) {
    dds_return_t result = 0;
    chunks.with_sample(
        i, wire::request_id(request.header.requestId), "bare",
        [&](const ridgeline_wire_Reply& sample) { result = dds_write(writer.get(), &sample); });
    if (result == 0)
      ++i;
    else
      std::this_thread::sleep_for(200us);  // the writer does not block
  }
}

}  // namespace

void answer_bare(unsigned domain_id) {
  const auto domain = dds::Domain::open(domain_id);
  const dds::Entity participant = domain->participant();
  const dds::Qos qos = dds::qos(dds::Topic::Instance);
  dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, dds::duration(dds::lease));
  const dds::Entity announcer(
      dds_create_writer(participant.get(),
                        dds::create_topic(participant, dds::Topic::Instance).get(), qos.get(),
                        nullptr),
      "announcer");
  announce(announcer);
  const dds::Entity subscriber = endpoint_parent(participant, "i_bare", false);
  const dds::Entity requests = reader(participant, subscriber, dds::Topic::Request);
  const dds::Entity condition(dds_create_readcondition(requests.get(), DDS_ANY_STATE), "condition");
  const dds::Entity waitset(dds_create_waitset(participant.get()), "waitset");
  dds::check(dds_waitset_attach(waitset.get(), condition.get(), 0), "attach");
  const dds::Entity topic = dds::create_topic(participant, dds::Topic::Reply);
  std::map<std::string, Writer> writers;
  const auto writer_of = [&](const std::string& client) -> const dds::Entity& {
    Writer& made = writers[client];
    if (!made.writer) {
      made.publisher = endpoint_parent(participant, "c_" + client, true);
      made.writer = {dds_create_writer(made.publisher.get(), topic.get(),
                                       dds::qos(dds::Topic::Reply).get(), nullptr),
                     "writer"};
    }
    return made.writer;
  };
  writer_of(bare_client);  // before the first request, as the client waits to be matched
  for (;;) {
    dds::check(dds_waitset_wait(waitset.get(), nullptr, 0, DDS_INFINITY), "wait");
    const dds::Taken<ridgeline_wire_Request> taken(requests);
    taken.for_each([&](const ridgeline_wire_Request& request, const dds_sample_info_t& info) {
      if (info.valid_data) reply(writer_of(request.client), request);
    });
  }
}

Requester::Requester(unsigned domain, const std::string& instance, std::string client)
    : client_(std::move(client)),
      domain_(dds::Domain::open(domain)),
      participant_(domain_->participant()),
      subscriber_(endpoint_parent(participant_, "c_" + client_, false)),
      publisher_(endpoint_parent(participant_, "i_" + instance, true)),
      reader_(reader(participant_, subscriber_, dds::Topic::Reply)),
      writer_(dds_create_writer(publisher_.get(),
                                dds::create_topic(participant_, dds::Topic::Request).get(),
                                dds::qos(dds::Topic::Request).get(), nullptr),
              "writer"),
      condition_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE), "condition"),
      waitset_(dds_create_waitset(participant_.get()), "waitset") {
  dds::check(dds_waitset_attach(waitset_.get(), condition_.get(), 0), "attach");
  while (dds::matched_readers(writer_).empty() || dds::matched_writers(reader_).empty())
    std::this_thread::sleep_for(1ms);
}

std::size_t Requester::ask(std::uint64_t number, const std::string& text, wire::CallKind kind) {
  wire::RequestId id;
  dds_guid_t guid;
  dds::check(dds_get_guid(writer_.get(), &guid), "guid");
  std::copy_n(guid.v, 16, id.writer.begin());
  id.number = number;
  const std::string instance, format = "json";
  const auto sample = wire::borrow({id, instance, client_, format, 100}, {kind, text.c_str()});
  dds::check(dds_write(writer_.get(), &sample), "write");
  wire::Assembler assembler;
  std::size_t bytes = 0;
  for (bool is_whole = false; !is_whole;) {
    if (dds_waitset_wait(waitset_.get(), nullptr, 0, DDS_SECS(60)) == 0)
      throw std::runtime_error("no answer within 60 s");
    const dds::Taken<ridgeline_wire_Reply> taken(reader_);
    taken.for_each([&](const ridgeline_wire_Reply& reply, const dds_sample_info_t&) {
      if (wire::request_id(reply.header.relatedRequestId).number != number) return;
      bytes = reply.document_bytes + reply.text_bytes + reply.numbers * sizeof(double);
      is_whole = assembler.add(reply) || is_whole;
    });
  }
  return bytes;
}

double tcp_seconds(std::size_t bytes) {
  const auto must = [](int result) {
    if (result < 0) throw std::runtime_error("socket");
    return result;
  };
  const int listener = must(socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  must(bind(listener, reinterpret_cast<sockaddr*>(&address), length));
  must(listen(listener, 1));
  must(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length));
  std::jthread sink([&] {
    const int from = must(accept(listener, nullptr, nullptr));
    std::vector<char> into(wire::chunk_bytes);
    for (std::size_t got = 0; got < bytes;)
      got += static_cast<std::size_t>(must(static_cast<int>(read(from, into.data(), into.size()))));
    must(static_cast<int>(write(from, "k", 1)));
    close(from);
  });
  const int to = must(socket(AF_INET, SOCK_STREAM, 0));
  must(connect(to, reinterpret_cast<sockaddr*>(&address), length));
  const std::vector<char> chunk(wire::chunk_bytes, 'x');
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t sent = 0; sent < bytes;)
    sent += static_cast<std::size_t>(
        must(static_cast<int>(write(to, chunk.data(), std::min(chunk.size(), bytes - sent)))));
  char acknowledged = 0;
  must(static_cast<int>(read(to, &acknowledged, 1)));
  const auto end = std::chrono::steady_clock::now();
  close(to);
  close(listener);
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace ridgeline::bench
