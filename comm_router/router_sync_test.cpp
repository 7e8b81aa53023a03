// Property: in any order of arrival of samples, Done, Step and Drop, RouterSync hands out the batches that the test
// expects from the order in which they were sent.
#include "comm_router/router_sync.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

namespace skein::router {
namespace {

constexpr std::size_t kUavs = 4;

/// Topic "/x" of every node, "/y" of the UAVs; targets do not matter here.
std::vector<RadioRoute> some_routes() {
  std::vector<RadioRoute> routes;
  const std::string type = "t/msg/T", wire = "t::msg::dds_::T_";
  for (const Node node : FirstNodes(kUavs + 1)) routes.push_back({node, "/x", type, "rt/x", wire, {}});
  for (const UavIndex uav : FirstUavs(kUavs)) routes.push_back({node_of_uav(uav), "/y", type, "rt/y", wire, {}});
  return routes;
}

std::vector<std::size_t> routes_from(const std::vector<RadioRoute>& routes, Node node) {
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r < routes.size(); ++r) {
    if (routes[r].source == node) found.push_back(r);
  }
  return found;
}

Payload payload(const std::string& text) {
  return std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end());
}

/// A message in a form that can be compared and printed.
std::string describe(const SentMessage& message) {
  return std::to_string(message.route) + "#" + std::to_string(message.sequence) + ":" +
         std::string(message.payload->begin(), message.payload->end());
}

std::vector<std::string> describe(const StepBatch& batch) {
  std::vector<std::string> lines;
  for (const SentMessage& message : batch.messages) lines.push_back(describe(message));
  return lines;
}

std::vector<std::string> awaited(const RouterSync& sync) {
  std::vector<std::string> lines;
  for (const AwaitedMember& one : sync.awaited()) lines.push_back(one.member.name + ": " + one.what);
  return lines;
}

/// Events that keep their order among themselves (one writer on one topic).
using Lane = std::vector<std::function<void(RouterSync&)>>;

/// A fleet that sends at random, loses members and gets them back. It lists the messages that the router must hand out.
class Fleet {
 public:
  Fleet(const std::vector<RadioRoute>& routes, std::mt19937& random) : routes_(routes), random_(random) {
    for (const Node node : FirstNodes(kUavs + 1))
      join(node, node == kStationNode ? "gcs" : "uav" + std::to_string(node));
    join(kStationNode, "station");  // a second program at the ground station
  }

  struct Round {
    std::vector<Lane> lanes;  ///< to be interleaved
    std::vector<std::string> expected;
  };

  Round play(std::uint64_t k) {
    Round round;
    std::vector<RadioMember> members;
    for (const Member& member : members_) members.push_back({member.name, member.source, member.node});
    round.lanes.push_back({[=, epoch = epoch_](RouterSync& sync) { sync.on_step(k, epoch, members, {}); }});
    std::vector<std::size_t> lost;
    for (std::size_t m = 0; m < members_.size(); ++m) {
      if (random_() % 40 == 0) lost.push_back(m);
      speak(members_[m], k, !lost.empty() && lost.back() == m, round);
    }
    stranger(round);
    change_membership(lost);
    return round;
  }

 private:
  struct Member {
    std::string name;
    Node node;
    SourceId source;
    std::map<std::size_t, std::uint64_t> sent;  ///< by route
  };

  void join(Node node, const std::string& name) { members_.push_back({name, node, next_source_++, {}}); }

  /// Adds the messages and the Done of one member in step k. A lost member sends messages, perhaps a false Done, and is
  /// dropped.
  void speak(Member& member, std::uint64_t k, bool lost, Round& round) {
    std::vector<SentCount> counts;
    for (const std::size_t r : routes_from(routes_, member.node)) {
      Lane lane;
      const std::uint64_t messages = random_() % 4;
      for (std::uint64_t n = 0; n < messages; ++n) {
        const Payload text = payload(member.name + "/" + std::to_string(random_()));
        if (!lost) round.expected.push_back(describe({r, member.sent[r], text}));
        ++member.sent[r];
        lane.push_back([=, source = member.source](RouterSync& sync) { sync.on_radio(source, r, text); });
      }
      round.lanes.push_back(lane);
      // A topic on which nothing was ever sent may be left out.
      if (member.sent[r] > 0 || random_() % 2 == 0) counts.push_back({routes_[r].topic, member.sent[r]});
    }
    counts.push_back({"rt/uav/command/gimbal", random_()});
    const SourceId source = member.source;
    if (!lost) {
      round.lanes.push_back({[=](RouterSync& sync) { sync.on_done(source, k, counts); }});
    } else {
      // A false Done: it announces more messages than the member has sent.
      for (SentCount& count : counts) ++count.count;
      if (random_() % 2 == 0) round.lanes.push_back({[=](RouterSync& sync) { sync.on_done(source, k, counts); }});
      round.lanes.push_back({[=](RouterSync& sync) { sync.on_drop(k, source); }});
    }
  }

  /// Adds a message of a participant that is not a member: the router must never hand it out.
  void stranger(Round& round) {
    const std::size_t r = random_() % routes_.size();
    round.lanes.push_back({[=](RouterSync& sync) { sync.on_radio(99999, r, payload("stranger")); }});
  }

  void change_membership(const std::vector<std::size_t>& lost) {
    for (std::size_t i = lost.size(); i-- > 0;) {
      away_.push_back({members_[lost[i]].name, members_[lost[i]].node});
      members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(lost[i]));
      ++epoch_;
    }
    if (!away_.empty() && random_() % 8 == 0) {  // restarted: a new participant that counts from zero
      join(away_.back().second, away_.back().first);
      away_.pop_back();
      ++epoch_;
    }
  }

  const std::vector<RadioRoute>& routes_;
  std::mt19937& random_;
  std::vector<Member> members_;
  std::vector<std::pair<std::string, Node>> away_;
  SourceId next_source_ = 1;
  std::uint32_t epoch_ = 0;
};

TEST(RouterSync, AnyOrderOfArrivalGivesTheSameBatches) {
  const std::vector<RadioRoute> routes = some_routes();
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    Fleet fleet(routes, random);
    RouterSync sync(routes);
    for (std::uint64_t k = 0; k < 80; ++k) {
      Fleet::Round round = fleet.play(k);
      std::optional<StepBatch> batch;
      while (true) {
        std::erase_if(round.lanes, [](const Lane& lane) { return lane.empty(); });
        if (round.lanes.empty()) break;
        Lane& lane = round.lanes[random() % round.lanes.size()];
        lane.front()(sync);
        lane.erase(lane.begin());
        if (auto ready = sync.take()) {
          ASSERT_FALSE(batch) << "two batches of one step";
          batch = std::move(ready);
        }
      }
      ASSERT_TRUE(batch) << "seed " << seed << " step " << k << ": " << ::testing::PrintToString(awaited(sync));
      ASSERT_EQ(batch->k, k);
      ASSERT_EQ(describe(*batch), round.expected) << "seed " << seed << " step " << k;
    }
  }
}

TEST(RouterSync, SamplesMayArriveBeforeTheirStep) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  sync.on_radio(7, 1, payload("a"));
  sync.on_done(7, 0, {{"rt/x", 1}});
  EXPECT_FALSE(sync.take());  // no step yet
  sync.on_step(0, 0, {{"uav1", 7, Node{1}}}, {});
  ASSERT_EQ(describe(*sync.take()), std::vector<std::string>{"1#0:a"});

  sync.on_done(7, 1, {{"rt/x", 3}});
  sync.on_radio(7, 1, payload("b"));
  sync.on_step(1, 0, {{"uav1", 7, Node{1}}}, {});
  EXPECT_FALSE(sync.take());
  EXPECT_EQ(awaited(sync), std::vector<std::string>{"uav1: rt/x 2 of 3"});
  sync.on_radio(7, 1, payload("c"));
  sync.on_radio(7, 1, payload("d"));  // beyond the count: belongs to the next step
  ASSERT_EQ(describe(*sync.take()), (std::vector<std::string>{"1#1:b", "1#2:c"}));

  sync.on_step(2, 0, {{"uav1", 7, Node{1}}}, {});
  EXPECT_EQ(awaited(sync), std::vector<std::string>{"uav1: done"});
  sync.on_done(7, 2, {{"rt/x", 4}});
  ASSERT_EQ(describe(*sync.take()), std::vector<std::string>{"1#3:d"});
}

TEST(RouterSync, ARestartedRouterCountsOnFromTheBase) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  sync.set_base(7, "rt/x", 40);
  sync.on_step(12, 3, {{"uav1", 7, Node{1}}}, Links(1, 1));
  sync.on_radio(7, 1, payload("a"));
  sync.on_done(7, 12, {{"rt/x", 41}});
  const std::optional<StepBatch> batch = sync.take();
  ASSERT_TRUE(batch);
  EXPECT_EQ(describe(*batch), std::vector<std::string>{"1#40:a"});
  EXPECT_EQ(batch->epoch, 3U);
  EXPECT_EQ(batch->links, Links(1, 1));
}

TEST(RouterSync, ADroppedMemberNeverComesBackUnderItsOldIdentity) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  sync.on_drop(0, 7);
  sync.on_step(0, 0, {{"uav1", 7, Node{1}}, {"uav2", 8, Node{2}}}, {});
  sync.on_radio(7, 1, payload("late"));
  sync.on_done(7, 0, {{"rt/x", 1}});
  EXPECT_FALSE(sync.take());
  sync.on_done(8, 0, {});
  EXPECT_TRUE(sync.take()->messages.empty());
  sync.on_step(1, 1, {{"uav1", 9, Node{1}}}, {});
  sync.on_radio(7, 1, payload("later"));
  sync.on_radio(9, 1, payload("fresh"));
  sync.on_done(9, 1, {{"rt/x", 1}});
  EXPECT_EQ(describe(*sync.take()), std::vector<std::string>{"1#0:fresh"});
}

TEST(RouterSync, TheRouterNamesTheMembersThatItAwaitsButNoneThatIsGone) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  EXPECT_EQ(sync.missing_answers(), 0U);
  sync.on_drop(0, 9);
  sync.on_step(0, 0, {{"uav1", 7, Node{1}}, {"uav2", 8, Node{2}}, {"uav3", 9, Node{3}}}, {});
  EXPECT_FALSE(sync.take()) << "from this step on, participant 9 is not a member";
  EXPECT_EQ(awaited(sync), (std::vector<std::string>{"uav1: done", "uav2: done"}));
  EXPECT_EQ(sync.missing_answers(), 2U);
  sync.on_done(7, 0, {{"rt/x", 1}, {"rt/y", 2}});
  sync.on_radio(7, 1, payload("a"));
  EXPECT_EQ(awaited(sync), (std::vector<std::string>{"uav1: rt/y 0 of 2", "uav2: done"}));
  EXPECT_EQ(sync.missing_answers(), 1U) << "uav1 has answered, but a sample is missing";
  sync.on_done(8, 0, {});
  EXPECT_EQ(awaited(sync), std::vector<std::string>{"uav1: rt/y 0 of 2"});
  EXPECT_EQ(sync.missing_answers(), 0U);
}

TEST(RouterSync, AStrangerCannotFillTheMemoryAndIsIgnoredAsAMemberLater) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  for (int i = 0; i < 10000; ++i) sync.on_radio(66, 1, payload("spam"));
  sync.on_step(0, 0, {{"uav1", 66, Node{1}}, {"uav2", 8, Node{2}}}, {});
  sync.on_done(8, 0, {});
  const std::optional<StepBatch> batch = sync.take();
  ASSERT_TRUE(batch);
  EXPECT_TRUE(batch->messages.empty());
}

TEST(RouterSync, ARouteThatIsBoundToAMemberIsNotOpenToItsNeighbour) {
  std::vector<RadioRoute> routes = some_routes();
  routes[0].member = "station";  // "/x" of the ground station, where two programs are
  RouterSync sync(routes);
  for (std::uint64_t k = 0; k < 3; ++k) {
    sync.on_radio(66, 0, payload("forged"));  // in the first step, before 66 is a member
    sync.on_radio(7, 0, payload("true"));
    sync.on_step(k, 0, {{"gcs", 66, Node{0}}, {"station", 7, Node{0}}}, {});
    sync.on_done(66, k, {{"rt/x", 9 * (k + 1)}});  // the router does not wait for these messages
    sync.on_done(7, k, {{"rt/x", k + 1}});
    const std::optional<StepBatch> batch = sync.take();
    ASSERT_TRUE(batch) << k;
    EXPECT_EQ(describe(*batch), std::vector<std::string>{"0#" + std::to_string(k) + ":true"});
  }
}

/// Number of messages that the router keeps on one topic, and in all from a participant that is not a member yet.
constexpr std::size_t kMost = 4096;

/// Begins step 0, in which uav1 sends this number of messages on rt/y and announces all of them.
void send_in_one_step(RouterSync& sync, std::size_t messages) {
  sync.on_step(0, 0, {{"uav1", 7, Node{1}}}, {});
  const std::size_t y = routes_from(some_routes(), Node{1}).back();
  for (std::size_t i = 0; i < messages; ++i) sync.on_radio(7, y, payload("x"));
  sync.on_done(7, 0, {{"rt/y", messages}});
}

TEST(RouterSync, AMemberMaySendAsManyMessagesInAStepAsTheRouterKeeps) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  send_in_one_step(sync, kMost);
  const std::optional<StepBatch> batch = sync.take();
  ASSERT_TRUE(batch);
  EXPECT_EQ(batch->messages.size(), kMost);
  EXPECT_TRUE(sync.take_excesses().empty());
}

TEST(RouterSync, TheRouterNamesTheSenderOfTooManyMessagesAndTheRemedy) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  send_in_one_step(sync, kMost + 10);
  EXPECT_FALSE(sync.take()) << "the missing messages never come";
  const std::string advice = "a program may send 256 on a topic in one step (docs/lockstep.md)";
  EXPECT_EQ(awaited(sync), std::vector<std::string>{"uav1: rt/y 4096 of 4106, since the router keeps 4096: " + advice});
  const std::vector<Excess> excesses = sync.take_excesses();
  ASSERT_EQ(excesses.size(), 1U) << "one report for all ten messages";
  EXPECT_EQ(excesses[0].source, 7U);
  EXPECT_EQ(excesses[0].what,
            "sent more than 4096 messages on rt/y in one step, or without announcing them, and the router discards "
            "the further ones; " +
                advice);
  EXPECT_TRUE(sync.take_excesses().empty()) << "take_excesses() has returned them before";
}

TEST(RouterSync, TheRouterReportsWhyItIgnoresAParticipant) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync early(routes), hasty(routes);
  for (std::size_t i = 0; i <= kMost; ++i) early.on_radio(66, i % 2, payload("x"));
  for (std::uint64_t k = 0; k < 65; ++k) hasty.on_done(66, k, {});
  const std::vector<std::pair<RouterSync*, std::string>> all = {
      {&early, "sent more than 4096 messages before its first step: send only in steps"},
      {&hasty, "answered more than 64 steps that it was not asked to answer: answer each step once"}};
  for (const auto& [sync, reason] : all) {
    EXPECT_TRUE(sync->lost(66)) << reason;
    const std::vector<Excess> excesses = sync->take_excesses();
    ASSERT_EQ(excesses.size(), 1U) << reason;
    EXPECT_EQ(excesses[0].what, reason + "; the router discards all that it sends");
  }
}

TEST(RouterSync, AMemberThatNeverSendsDoneCannotFillTheMemory) {
  const std::vector<RadioRoute> routes = some_routes();
  RouterSync sync(routes);
  const Payload sample = payload("spam");
  sync.on_step(0, 0, {{"uav1", 7, Node{1}}}, {});
  for (int i = 0; i < 100000; ++i) sync.on_radio(7, 1, sample);
  EXPECT_LT(sample.use_count(), 10000) << "RouterSync keeps that many samples";
}

}  // namespace
}  // namespace skein::router
