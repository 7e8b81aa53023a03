#include "bus/inbox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <thread>

#include "bus/typed.hpp"
#include "tests/free_domain.hpp"

namespace skein::bus {
namespace {

using namespace std::chrono_literals;

/// Longer than anything takes; a test that waits so long has failed.
constexpr auto kPatience = 60s;

class InboxTest : public testing::Test {
 protected:
  std::unique_ptr<Participant> join() { return bus_->join(domains_.base()); }
  static TopicSpec topic(const std::string& name) { return {name, "Type_", {}}; }
  static std::vector<std::uint8_t> payload(std::uint8_t number) { return {0, 1, 0, 0, number, 0, 0, 0}; }
  static std::vector<std::uint8_t> count_message(std::uint64_t count) {
    msg::TopicCount message;
    message.count(count);
    return encode(message);
  }

  test::FreeDomains domains_{1};
  std::unique_ptr<Bus> bus_ = make_bus({.vendor = "inproc"});
  std::unique_ptr<Participant> here_ = join(), there_ = join();
};

TEST_F(InboxTest, HandlersRunInDispatchInOrderOfArrival) {
  Inbox inbox(0);
  std::vector<int> got;
  const auto note = [&got](Sample&& sample) { got.push_back(sample.payload[4]); };
  auto reader_a = inbox.subscribe(*here_, topic("a"), note), reader_b = inbox.subscribe(*here_, topic("b"), note);
  auto a = there_->create_writer(topic("a")), b = there_->create_writer(topic("b"));
  a->write(payload(1));
  b->write(payload(2));
  inbox.post([&got] { got.push_back(3); });
  a->write(payload(4));
  EXPECT_TRUE(got.empty());
  EXPECT_TRUE(inbox.dispatch(0ms));
  EXPECT_EQ(got, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_FALSE(inbox.dispatch(0ms));
  EXPECT_EQ(reader_a->matched(), std::vector<ParticipantId>{there_->id()});
}

TEST_F(InboxTest, ABusThatHasVanishedSendsNothingMoreAndIsMatchedByNone) {
  const auto other = make_bus({.vendor = "inproc"});
  const auto dead = other->join(domains_.base());
  int here = 0, there = 0;
  const auto reader = here_->create_reader(topic("a"), [&here](const auto&) { ++here; });
  const auto dead_reader = dead->create_reader(topic("a"), [&there](const auto&) { ++there; });
  const auto writer = there_->create_writer(topic("a")), dead_writer = dead->create_writer(topic("a"));
  dead_writer->write(payload(1));
  EXPECT_TRUE(dead_writer->has_readers());
  other->vanish();
  dead_writer->write(payload(2));
  writer->write(payload(3));
  EXPECT_EQ(here, 2) << "what the dead bus writes still arrives";
  EXPECT_EQ(there, 0);
  EXPECT_FALSE(dead_writer->has_readers());
  EXPECT_TRUE(dead_writer->matched().empty());
  EXPECT_TRUE(dead_reader->matched().empty());
  EXPECT_EQ(writer->matched(), std::vector<ParticipantId>{here_->id()});
}

TEST_F(InboxTest, WakeEndsTheWait) {
  Inbox inbox(0);
  std::thread other([&inbox] { inbox.wake(); });
  EXPECT_FALSE(inbox.dispatch(kPatience));
  other.join();
}

TEST_F(InboxTest, AWakeBeforeDispatchTakesEffectAndLosesNoPostedWork) {
  Inbox inbox(0);
  int ran = 0;
  inbox.post([&ran] { ++ran; });
  inbox.wake();
  EXPECT_FALSE(inbox.dispatch(kPatience));
  EXPECT_EQ(ran, 1);
  inbox.post([&ran] { ++ran; });
  EXPECT_TRUE(inbox.dispatch(kPatience));
}

TEST_F(InboxTest, WorkFromAnotherThreadRunsInTheWaitingThread) {
  for (const unsigned chaos : {0u, 1u}) {
    Inbox inbox(chaos);
    std::thread::id ran_in;
    std::thread other([&] { inbox.post([&ran_in] { ran_in = std::this_thread::get_id(); }); });
    EXPECT_TRUE(inbox.dispatch(kPatience));
    other.join();
    EXPECT_EQ(ran_in, std::this_thread::get_id());
  }
}

TEST_F(InboxTest, SilentSamplesWaitForSamplesThatRing) {
  Inbox inbox(0);
  std::vector<int> got;
  const auto note = [&got](Sample&& sample) { got.push_back(sample.payload[4]); };
  auto silent_reader = inbox.subscribe(*here_, topic("silent"), note, Bell::silent);
  auto ringing_reader = inbox.subscribe(*here_, topic("ringing"), note);
  auto silent = there_->create_writer(topic("silent")), ringing = there_->create_writer(topic("ringing"));
  silent->write(payload(1));
  EXPECT_TRUE(inbox.ready());
  EXPECT_FALSE(inbox.ready(1));
  ringing->write(payload(2));
  EXPECT_TRUE(inbox.ready(1));
  EXPECT_FALSE(inbox.ready(2));
  EXPECT_TRUE(inbox.dispatch(kPatience, 1));
  EXPECT_EQ(got, (std::vector<int>{1, 2}));
  EXPECT_FALSE(inbox.ready()) << "samples that were handed out still count";
  inbox.post([] {});
  EXPECT_TRUE(inbox.dispatch(kPatience, 2)) << "posted work must not wait for samples";
  silent->write(payload(3));
  EXPECT_TRUE(inbox.dispatch(0ms, 1)) << "after the timeout, dispatch() hands out the samples that are there";
  EXPECT_EQ(got.back(), 3);
}

TEST_F(InboxTest, NoRingIsLostWhileSeveralThreadsWrite) {
  constexpr int kThreads = 4, kRounds = 2'000;
  for (const unsigned chaos : {0u, 1u}) {
    Inbox inbox(chaos);
    int rung = 0, heard = 0;
    auto ringing = inbox.subscribe(*here_, topic("ringing"), [&](Sample&&) { ++rung; });
    auto silent = inbox.subscribe(
        *here_, topic("silent"), [&](Sample&&) { ++heard; }, Bell::silent);
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([this] {
        auto participant = join();
        auto silent_writer = participant->create_writer(topic("silent"));
        auto ringing_writer = participant->create_writer(topic("ringing"));
        for (int i = 0; i < kRounds / (kThreads * 2); ++i) {
          silent_writer->write(payload(0));
          ringing_writer->write(payload(0));
        }
      });
    const int all = kRounds / (kThreads * 2) * kThreads;
    // Waits for no more samples than are sure to come, so a lost ring would use up all of kPatience.
    while (rung < all && inbox.dispatch(kPatience, static_cast<std::size_t>(std::min(3, all - rung)))) {
    }
    while (heard < all && inbox.dispatch(kPatience)) {
    }
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(rung, all);
    EXPECT_EQ(heard, all);
  }
}

TEST_F(InboxTest, AJobPostedByAHandlerRunsInTheNextDispatch) {
  Inbox inbox(0);
  int ran = 0;
  inbox.post([&] { inbox.post([&ran] { ++ran; }); });
  EXPECT_TRUE(inbox.dispatch(0ms));
  EXPECT_EQ(ran, 0);
  EXPECT_TRUE(inbox.dispatch(0ms));
  EXPECT_EQ(ran, 1);
}

TEST_F(InboxTest, AnExceptionOfAHandlerLosesNothing) {
  Inbox inbox(0);
  std::vector<int> got;
  inbox.post([&got] { got.push_back(1); });
  inbox.post([] { throw std::runtime_error("handler"); });
  inbox.post([&got] { got.push_back(3); });
  EXPECT_THROW(inbox.dispatch(0ms), std::runtime_error);
  EXPECT_TRUE(inbox.dispatch(0ms));
  EXPECT_EQ(got, (std::vector<int>{1, 3}));
}

TEST_F(InboxTest, AReaderThatIsGoneReceivesNothing) {
  Inbox inbox(0);
  int got = 0;
  auto reader = inbox.subscribe(*here_, topic("a"), [&got](Sample&&) { ++got; });
  auto writer = there_->create_writer(topic("a"));
  writer->write(payload(1));
  reader.reset();
  writer->write(payload(2));
  inbox.dispatch(0ms);
  EXPECT_EQ(got, 0);
}

TEST_F(InboxTest, SamplesOfManyThreadsAllArriveInOrder) {
  constexpr int kThreads = 4, kSamples = 20'000;
  Inbox inbox(0);
  std::map<ParticipantId, std::uint64_t> next;
  int got = 0, out_of_order = 0;
  auto reader = subscribe<msg::TopicCount>(inbox, *here_, topic_of<msg::TopicCount>("counts"),
                                           [&](const msg::TopicCount& m, ParticipantId source) {
                                             out_of_order += m.count() != next[source]++;
                                             ++got;
                                           });
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([this] {
      auto participant = join();
      const auto writer = participant->create_writer(topic_of<msg::TopicCount>("counts"));
      for (int i = 0; i < kSamples; ++i) writer->write(count_message(i));
    });
  while (got < kThreads * kSamples && inbox.dispatch(kPatience)) {
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(got, kThreads * kSamples);
  EXPECT_EQ(out_of_order, 0);
  EXPECT_EQ(next.size(), static_cast<std::size_t>(kThreads));
}

TEST_F(InboxTest, ChaosReordersSamplesButNotWithinAStream) {
  constexpr int kWriters = 4, kTopics = 3, kSamples = 200;
  for (const unsigned seed : {1u, 2u, 3u}) {
    Inbox inbox(seed);
    std::vector<std::uint64_t> order;
    std::map<std::pair<int, ParticipantId>, std::uint64_t> last;
    bool ordered = true;
    std::vector<std::unique_ptr<Reader>> readers;
    for (int t = 0; t < kTopics; ++t)
      readers.push_back(subscribe<msg::TopicCount>(inbox, *here_,
                                                   topic_of<msg::TopicCount>("topic" + std::to_string(t)),
                                                   [&, t](const msg::TopicCount& m, ParticipantId source) {
                                                     auto& previous = last[{t, source}];
                                                     ordered = ordered && m.count() >= previous;
                                                     previous = m.count() + 1;
                                                     order.push_back(m.count());
                                                   }));
    std::vector<std::unique_ptr<Participant>> participants;
    std::vector<std::unique_ptr<Writer>> writers;
    for (int w = 0; w < kWriters; ++w) {
      participants.push_back(join());
      for (int t = 0; t < kTopics; ++t) {
        writers.push_back(participants.back()->create_writer(topic_of<msg::TopicCount>("topic" + std::to_string(t))));
      }
    }
    std::uint64_t number = 0;
    for (int i = 0; i < kSamples; ++i)
      for (auto& writer : writers) writer->write(count_message(number++));
    while (order.size() < number && inbox.dispatch(kPatience)) {
    }
    EXPECT_EQ(order.size(), number);
    EXPECT_TRUE(ordered);
    EXPECT_FALSE(std::is_sorted(order.begin(), order.end())) << "chaos did nothing";
  }
}

TEST_F(InboxTest, MalformedSamplesAreCountedAndDropped) {
  Inbox inbox(0);
  int got = 0;
  auto reader = subscribe<msg::Odometry>(inbox, *here_, topic_of<msg::Odometry>("odometry"),
                                         [&got](const msg::Odometry&, ParticipantId) { ++got; });
  auto garbage = there_->create_writer(topic_of<msg::Odometry>("odometry"));
  const auto good = there_->create_writer(topic_of<msg::Odometry>("odometry"));
  garbage->write(payload(1));
  good->write(encode(msg::Odometry()));
  garbage->write({});
  inbox.dispatch(0ms);
  EXPECT_EQ(got, 1);
  EXPECT_EQ(inbox.malformed(), 2u);
}

}  // namespace
}  // namespace skein::bus
