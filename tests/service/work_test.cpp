#include "service/work.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <latch>
#include <set>

#include "idl/domain.hpp"
#include "service/log.hpp"

namespace ridgeline::service {
namespace {

using namespace std::chrono_literals;

/// A Work between two participants of one process, whose jobs are functions of the test: the text
/// "wait" blocks until it is cancelled or let go.
class WorkTest : public testing::Test {
protected:
  explicit WorkTest(const Work::Limits& limits = {.workers = 2,
                                                  .queue = 8,
                                                  .queue_bytes = 1000,
                                                  .answer_bytes = 1 << 20,
                                                  .answers = 100})
      : domain_(dds::Domain::open(42)),
        participant_(domain_->participant()),
        client_(domain_->participant()),
        replies_(participant_, "north"),
        work_(
            limits, [this](auto& request, Channel, auto& p) { return run(request, p); }, replies_,
            counters_) {
    for (const char* name : {"a", "b"}) {
      const dds::Qos qos(dds_create_qos());
      dds::set_partition(qos, dds::client_partition(name));
      subscribers_.emplace_back(dds_create_subscriber(client_.get(), qos.get(), nullptr),
                                "subscriber");
      readers_.emplace_back(dds_create_reader(subscribers_.back().get(),
                                              dds::create_topic(client_, dds::Topic::Reply).get(),
                                              dds::qos(dds::Topic::Reply).get(), nullptr),
                            "reader");
    }
  }
  ~WorkTest() override { is_let_go_ = true; }

  static std::shared_ptr<const dds::Domain> unique_domain() {
    setenv("DDS_TAG", ("ridgeline-work-" + std::to_string(getpid())).c_str(), 1);
    log::set_level("off");
    dds_set_log_sink([](void*, const dds_log_data_t*) {}, nullptr);
    return dds::Domain::open(42);
  }

  Work::Ran run(const wire::Request& request, const Progress& progress) {
    {
      const std::scoped_lock lock(mutex_);
      ran_.push_back(request.client + std::to_string(request.id.number));
    }
    try {
      while (request.text == "wait" && !is_let_go_) {
        progress.at(0.5, "waiting");
        std::this_thread::sleep_for(1ms);
      }
    } catch (const Error& error) {
      return {jobs::refusal(error), "test"};
    }
    return {{{{"status", "ok"}}, {}, request.text}, "test"};
  }

  wire::Request request(std::uint64_t number, const std::string& text, char client = 'a',
                        double timeout = 10) {
    wire::Request request;
    dds_guid_t guid;
    dds::check(dds_get_guid(client_.get(), &guid), "guid");
    std::copy_n(guid.v, 16, request.id.writer.begin());
    request.id.writer[15] = static_cast<std::uint8_t>(client);
    request.id.number = number;
    request.client = client;
    request.format = "json";
    request.timeout = timeout;
    request.text = text;
    return request;
  }
  void take(const wire::Request& request) { work_.take(request, Channel::Compute, 0ns); }

  /// The codes of the next `count` replies to a client, by number, within five seconds.
  std::multimap<std::uint64_t, std::string> replies(std::size_t count, char client = 'a') {
    std::multimap<std::uint64_t, std::string> result;
    for (const auto end = Clock::now() + 5s; result.size() < count && Clock::now() < end;) {
      const dds::Taken<ridgeline_wire_Reply> taken(readers_[client == 'a' ? 0 : 1]);
      taken.for_each([&](const ridgeline_wire_Reply& reply, const dds_sample_info_t&) {
        const std::string code = reply.error.code;
        result.emplace(wire::request_id(reply.header.relatedRequestId).number,
                       code.empty() ? "ok" : code);
      });
      std::this_thread::sleep_for(1ms);
    }
    return result;
  }
  std::size_t runs() {
    const std::scoped_lock lock(mutex_);
    return ran_.size();
  }
  template <class F>
  bool eventually(F&& condition) {
    for (const auto end = Clock::now() + 5s; !condition(); std::this_thread::sleep_for(1ms))
      if (Clock::now() > end) return false;
    return true;
  }
  using Codes = std::multimap<std::uint64_t, std::string>;

  std::shared_ptr<const dds::Domain> made_ = unique_domain();
  std::shared_ptr<const dds::Domain> domain_;
  dds::Entity participant_, client_;
  std::vector<dds::Entity> subscribers_, readers_;
  std::mutex mutex_;
  std::vector<std::string> ran_;
  std::atomic<bool> is_let_go_ = false;
  Counters counters_;
  Replies replies_;
  Work work_;
};

TEST_F(WorkTest, ARunningRequestIsCancelledWithinATenthOfASecond) {
  take(request(1, "wait"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 1; }));
  const auto begin = Clock::now();
  work_.cancel(request(1, "").id);
  ASSERT_TRUE(eventually([&] { return work_.running() == 0; }));
  EXPECT_LT(Clock::now() - begin, 100ms);
  EXPECT_EQ(replies(1), (Codes{{1, "cancelled"}}));
}

TEST_F(WorkTest, AWaitingRequestIsCancelledWithoutRunning) {
  take(request(1, "wait"));
  take(request(2, "wait"));
  take(request(3, "quick"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 2 && work_.queued() == 1; }));
  work_.cancel(request(3, "").id);
  EXPECT_EQ(replies(1), (Codes{{3, "cancelled"}}));
  is_let_go_ = true;
  EXPECT_EQ(replies(2), (Codes{{1, "ok"}, {2, "ok"}}));
  EXPECT_EQ(runs(), 2u);
}

TEST_F(WorkTest, ACancelThatComesFirstCounts) {
  work_.cancel(request(1, "").id);
  take(request(1, "quick"));
  EXPECT_EQ(replies(1), (Codes{{1, "cancelled"}}));
  EXPECT_EQ(runs(), 0u);
}

TEST_F(WorkTest, DuplicatesRunOnce) {
  take(request(1, "wait"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 1; }));
  take(request(1, "wait"));  // while it runs: its one answer is enough
  is_let_go_ = true;
  EXPECT_EQ(replies(1), (Codes{{1, "ok"}}));
  take(request(1, "wait"));  // after it: the answer again
  EXPECT_EQ(replies(1), (Codes{{1, "ok"}}));
  EXPECT_EQ(runs(), 1u);
}

TEST_F(WorkTest, AFullQueueIsSaidAndTheRestIsDone) {
  for (std::uint64_t i = 1; i <= 2; ++i) take(request(i, "wait"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 2; }));
  for (std::uint64_t i = 3; i <= 12; ++i) take(request(i, "quick"));
  EXPECT_EQ(replies(2), (Codes{{11, "busy"}, {12, "busy"}}));
  take(request(13, std::string(2000, 'x'), 'b'));  // more bytes than may wait
  EXPECT_EQ(replies(1, 'b'), (Codes{{13, "busy"}}));
  is_let_go_ = true;
  EXPECT_EQ(replies(10).size(), 10u);
  take(request(11, "quick"));  // asked again after the refusal
  EXPECT_EQ(replies(1), (Codes{{11, "ok"}}));
}

TEST_F(WorkTest, ClientsTakeTurns) {
  for (std::uint64_t i = 1; i <= 2; ++i) take(request(i, "wait"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 2; }));
  for (std::uint64_t i = 3; i <= 6; ++i) take(request(i, "quick"));
  take(request(7, "quick", 'b'));
  is_let_go_ = true;
  EXPECT_EQ(replies(6).size(), 6u);
  EXPECT_EQ(replies(1, 'b').size(), 1u);
  const std::scoped_lock lock(mutex_);
  const auto b = std::ranges::find(ran_, "b7");
  EXPECT_LE(b - ran_.begin(), 4) << "the other client's four requests were all done first";
}

TEST_F(WorkTest, TheClientsTimeEndsTheWork) {
  take(request(1, "wait", 'a', 0.2));
  ASSERT_TRUE(eventually([&] { return work_.running() == 1; }));
  EXPECT_TRUE(eventually([&] {
    work_.tick();
    return work_.running() == 0;
  }));
  work_.take(request(2, "quick", 'a', 5), Channel::Compute, 6s);  // under way for too long
  const Codes codes = replies(2);
  EXPECT_EQ(codes.find(2)->second, "timeout");
  EXPECT_EQ(runs(), 1u);
}

TEST_F(WorkTest, WorkOfAClientThatIsGoneEnds) {
  take(request(1, "wait"));
  ASSERT_TRUE(eventually([&] {
    replies_.refresh();
    work_.tick();
    return work_.running() == 1;
  }));
  readers_.clear();
  EXPECT_TRUE(eventually([&] {
    replies_.refresh();
    work_.tick();
    return work_.running() == 0;
  }));
}

TEST_F(WorkTest, ClosedItRefusesWhatHasNotBegun) {
  for (std::uint64_t i = 1; i <= 2; ++i) take(request(i, "wait"));
  ASSERT_TRUE(eventually([&] { return work_.running() == 2; }));
  take(request(3, "quick"));
  work_.close();
  take(request(4, "quick"));
  EXPECT_EQ(replies(2), (Codes{{3, "busy"}, {4, "busy"}}));
  EXPECT_FALSE(work_.is_idle());
  is_let_go_ = true;
  EXPECT_EQ(replies(2), (Codes{{1, "ok"}, {2, "ok"}}));
  EXPECT_TRUE(work_.is_idle());
}

TEST_F(WorkTest, AReplyWaitsForTheReaderOfItsClient) {
  readers_.clear();
  take(request(1, "quick"));
  ASSERT_TRUE(eventually([&] { return runs() == 1; }));
  std::this_thread::sleep_for(200ms);
  readers_.emplace_back(
      dds_create_reader(subscribers_[0].get(), dds::create_topic(client_, dds::Topic::Reply).get(),
                        dds::qos(dds::Topic::Reply).get(), nullptr),
      "reader");
  EXPECT_EQ(replies(1), (Codes{{1, "ok"}}));
}

TEST_F(WorkTest, ASmallAnswerPassesALargeOneThatItsClientDoesNotTake) {
  // A reader that holds four samples and takes none: the large answer cannot get through.
  const dds::Qos qos = dds::qos(dds::Topic::Reply);
  dds_qset_resource_limits(qos.get(), 4, DDS_LENGTH_UNLIMITED, 4);
  readers_[0] = dds::Entity(
      dds_create_reader(subscribers_[0].get(), dds::create_topic(client_, dds::Topic::Reply).get(),
                        qos.get(), nullptr),
      "reader");
  wire::Request large = request(1, "");
  large.text = std::string(990, 'x');
  take(large);
  std::atomic<int> delivered = 0;
  jobs::Answer answer;
  answer.document = {{"status", "ok"}};
  answer.arrays.push_back({"/x", {1'000'000}, std::vector<double>(1'000'000, 1.5)});
  replies_.post({.id = request(2, "").id,
                 .client = "a",
                 .chunks = std::make_shared<wire::Chunks>(std::move(answer), 1),
                 .give_up = Clock::now() + 10s,
                 .done = [&](Delivery) { ++delivered; }});
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(delivered, 0);
  const auto begin = Clock::now();
  take(request(3, "quick", 'b'));
  EXPECT_EQ(replies(1, 'b'), (Codes{{3, "ok"}}));
  EXPECT_LT(Clock::now() - begin, 2s);
  EXPECT_EQ(replies(42).size(), 42u);  // 41 chunks of 192 KiB and the answer before
  EXPECT_TRUE(eventually([&] { return delivered == 1; }));
}

}  // namespace
}  // namespace ridgeline::service
