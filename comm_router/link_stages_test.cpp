// Links that lose, delay, duplicate and cut messages: their statistics, the steps in which they act, and that every
// random draw depends on its key alone.
#include "comm_router/link_stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>

namespace skein::router {
namespace {

constexpr Node kA = Node{1}, kB = Node{2};
constexpr std::uint64_t kSeed = 7;

Scenario fleet_of(const std::vector<std::string>& names) {
  Scenario scenario;
  for (const std::string& name : names) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

Scenario two_uavs() { return fleet_of({"a", "b"}); }

const RadioRoute kRoute{kA, "/x", "std_msgs/msg/String", "rt/x", "std_msgs::msg::dds_::String_", {{kB, "rt/x/b"}}};

SentMessage message(std::uint64_t sequence, std::size_t bytes = 100) {
  return {0, sequence, std::make_shared<const std::vector<std::uint8_t>>(bytes)};
}

FaultPlan plan_of(const FaultAction& action, double at_s = 0.0, std::optional<double> until_s = {}) {
  FaultPlan plan;
  plan.faults.push_back({at_s, until_s, action});
  return plan;
}

LinkStages stages_of(const FaultPlan& plan, std::uint64_t seed = kSeed) { return {two_uavs(), plan, seed}; }

double lost_share(LinkStages& stages, std::uint64_t messages) {
  std::uint64_t lost = 0;
  for (std::uint64_t i = 0; i < messages; ++i) lost += stages.fate(i, kRoute, kB, message(i)).loss == LinkLoss::fault;
  return static_cast<double>(lost) / static_cast<double>(messages);
}

bool same(const LinkFate& a, const LinkFate& b) {
  return a.loss == b.loss && a.delay_steps == b.delay_steps && a.copies == b.copies;
}

TEST(LinkStages, WithoutEffectsLinksAreIdeal) {
  LinkStages stages = stages_of({});
  EXPECT_TRUE(same(stages.fate(3, kRoute, kB, message(0)), {}));
}

TEST(LinkStages, MessagesAreLostWithTheProbabilityOfTheEffect) {
  for (const double loss : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    LinkEffect effect;
    effect.loss = loss;
    LinkStages stages = stages_of(plan_of(effect));
    EXPECT_NEAR(lost_share(stages, 20000), loss, 4.0 * std::sqrt(loss * (1.0 - loss) / 20000.0) + 1e-12);
  }
}

TEST(LinkStages, AnEffectActsOnItsLinkAndInItsTimeOnly) {
  LinkEffect effect;
  effect.from = {"a"};
  effect.to = {"b"};
  effect.loss = 1.0;
  LinkStages stages = stages_of(plan_of(effect, 1.0, 2.0));  // steps 20 to 39
  RadioRoute back = kRoute;
  back.source = kB;
  for (std::uint64_t k = 0; k < 60; ++k) {
    EXPECT_EQ(stages.fate(k, kRoute, kB, message(k)).loss == LinkLoss::fault, k >= 20 && k < 40) << k;
    EXPECT_EQ(stages.fate(k, back, kA, message(k)).loss, LinkLoss::none) << k;
  }
}

TEST(LinkStages, AnEffectActsOnAllLinksThatItNamesAndOnNoOther) {
  const Scenario scenario = fleet_of({"a", "b", "c"});
  const std::vector<std::vector<std::string>> groups = {{"all"}, {"a"}, {"gcs"}, {"b", "c"}, {"gcs", "a", "c"}};
  for (const auto& from : groups) {
    for (const auto& to : groups) {
      LinkEffect effect;
      effect.from = from;
      effect.to = to;
      effect.loss = 1.0;
      LinkStages stages(scenario, plan_of(effect), kSeed);
      for (const Node source : FirstNodes(4)) {
        for (const Node target : FirstNodes(4)) {
          if (source == target) continue;
          RadioRoute route = kRoute;
          route.source = source;
          const bool named = names_node(from, scenario.node_name(source)) && names_node(to, scenario.node_name(target));
          EXPECT_EQ(stages.fate(0, route, target, message(0)).loss != LinkLoss::none, named)
              << from[0] << " to " << to[0] << ": " << scenario.node_name(source) << scenario.node_name(target);
        }
      }
    }
  }
}

TEST(LinkStages, LatencyIsRoundedUpToExchangesAndJitterStaysInItsRange) {
  LinkEffect effect;
  effect.latency_s = 0.12;
  LinkStages fixed = stages_of(plan_of(effect));
  EXPECT_EQ(fixed.fate(0, kRoute, kB, message(0)).delay_steps, 3u);
  effect.latency_s = 0.1;
  LinkStages exact = stages_of(plan_of(effect));
  EXPECT_EQ(exact.fate(0, kRoute, kB, message(0)).delay_steps, 2u);
  effect.jitter_s = 0.2;
  LinkStages shaky = stages_of(plan_of(effect));
  std::vector<int> seen(7);
  for (std::uint64_t i = 0; i < 4000; ++i) ++seen.at(shaky.fate(i, kRoute, kB, message(i)).delay_steps);
  EXPECT_EQ(seen[0] + seen[1], 0);
  for (const int steps : {3, 4, 5, 6}) EXPECT_NEAR(seen[static_cast<std::size_t>(steps)], 1000, 150) << steps;
}

TEST(LinkStages, MessagesAreDuplicatedAndReordered) {
  LinkEffect effect;
  effect.duplication = 0.25;
  effect.reordering = Reordering{0.5, 0.5};
  LinkStages stages = stages_of(plan_of(effect));
  int doubled = 0, late = 0;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const LinkFate fate = stages.fate(i, kRoute, kB, message(i));
    doubled += fate.copies == 2;
    late += fate.delay_steps == 10;
    EXPECT_TRUE(fate.delay_steps == 0 || fate.delay_steps == 10);
  }
  EXPECT_NEAR(doubled, 2000, 160);
  EXPECT_NEAR(late, 4000, 180);
}

TEST(LinkStages, BurstsHaveTheirMeanLengthAndFrequency) {
  LinkEffect effect;
  effect.burst_loss = BurstLoss{4.0, 1.0, 1.0};
  LinkStages stages = stages_of(plan_of(effect));
  std::uint64_t bursts = 0, lost_steps = 0;
  bool before = false;
  constexpr std::uint64_t kSteps = 200000;
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    const bool lost = stages.fate(k, kRoute, kB, message(k)).loss != LinkLoss::none;
    bursts += lost && !before;
    lost_steps += lost;
    before = lost;
  }
  EXPECT_NEAR(static_cast<double>(lost_steps) / kSteps, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(lost_steps) / static_cast<double>(bursts), 20.0, 2.0);  // steps of 0.05 s
}

TEST(LinkStages, ALimitedBandwidthDelaysMessagesAndLosesThemWhenItsQueueIsFull) {
  LinkEffect effect;
  effect.bandwidth_bit_s = 8000.0;  // 1,000 bytes a second: 50 a step
  effect.queue_bytes = 250;
  LinkStages stages = stages_of(plan_of(effect));
  std::vector<LinkFate> fates;
  for (std::uint64_t i = 0; i < 5; ++i) fates.push_back(stages.fate(0, kRoute, kB, message(i)));
  EXPECT_EQ(fates[0].delay_steps, 2u);
  EXPECT_EQ(fates[1].delay_steps, 4u);
  EXPECT_EQ(fates[2].loss, LinkLoss::overflow);  // 200 bytes wait or are under way, so 100 more do not fit
  EXPECT_EQ(fates[4].loss, LinkLoss::overflow);
  EXPECT_EQ(stages.fate(2, kRoute, kB, message(5)).delay_steps, 4u);     // 100 bytes have been sent meanwhile
  EXPECT_EQ(stages.fate(1000, kRoute, kB, message(6)).delay_steps, 2u);  // the queue is empty again
  EXPECT_EQ(stages.fate(2000, kRoute, kB, message(7, 4000)).loss, LinkLoss::none)
      << "a message that finds an empty queue always fits";
}

TEST(LinkStages, DrawsDependOnKeysAlone) {
  LinkEffect effect;
  effect.loss = 0.3;
  effect.jitter_s = 0.3;
  effect.duplication = 0.3;
  effect.burst_loss = BurstLoss{1.0, 1.0, 0.5};
  const FaultPlan plan = plan_of(effect, 5.0);
  LinkStages all = stages_of(plan);
  std::vector<LinkFate> fates;
  for (std::uint64_t i = 0; i < 2000; ++i) fates.push_back(all.fate(i, kRoute, kB, message(i)));

  LinkStages restarted = stages_of(plan);  // sees the second half only
  for (std::uint64_t i = 1000; i < 2000; ++i) EXPECT_TRUE(same(restarted.fate(i, kRoute, kB, message(i)), fates[i]));

  LinkStages other_traffic = stages_of(plan);
  RadioRoute other = kRoute;
  other.ros_topic = "/y";
  int differing = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    differing += !same(other_traffic.fate(i, other, kB, message(i)), fates[i]);
    EXPECT_TRUE(same(other_traffic.fate(i, kRoute, kB, message(i)), fates[i]));
  }
  EXPECT_GT(differing, 500) << "another topic draws its own numbers";

  LinkStages other_seed = stages_of(plan, kSeed + 1);
  int changed = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) changed += !same(other_seed.fate(i, kRoute, kB, message(i)), fates[i]);
  EXPECT_GT(changed, 500);
}

TEST(LinkStages, BlackoutsAndPartitionsCutLinks) {
  const auto lost = [](const FaultPlan& plan, std::uint64_t k) {
    LinkStages stages = stages_of(plan);
    return stages.fate(k, kRoute, kB, message(0)).loss == LinkLoss::fault;
  };
  EXPECT_TRUE(lost(plan_of(Blackout{"a"}), 0));
  EXPECT_TRUE(lost(plan_of(Blackout{"b"}), 0));
  EXPECT_FALSE(lost(plan_of(StationOutage{}), 0));
  EXPECT_TRUE(lost(plan_of(Partition{{{"a", "gcs"}, {"b"}}}), 0));
  EXPECT_FALSE(lost(plan_of(Partition{{{"a", "b"}, {"gcs"}}}), 0));
  EXPECT_TRUE(lost(plan_of(Partition{{{"a"}}}), 0)) << "a node in no group is cut off from all";
  EXPECT_FALSE(lost(plan_of(Blackout{"a"}, 1.0, 2.0), 19));
  EXPECT_TRUE(lost(plan_of(Blackout{"a"}, 1.0, 2.0), 20));
  EXPECT_FALSE(lost(plan_of(Blackout{"a"}, 1.0, 2.0), 40));
}

TEST(LinkStages, AnEffectActsOnTheTopicsThatItNamesAndOnNoOther) {
  for (const std::vector<std::string>& named :
       std::vector<std::vector<std::string>>{{"all"}, {"/x"}, {"/x/y"}, {"/y", "/x"}, {"/xy"}}) {
    LinkEffect effect;
    effect.loss = 1.0;
    effect.topics = named;
    LinkStages stages = stages_of(plan_of(effect));
    for (const std::string topic : {"/x", "/x/y", "/x/y/z", "/xy", "/y"}) {
      RadioRoute route = kRoute;
      route.ros_topic = topic;
      const bool meant = std::ranges::any_of(
          named, [&](const std::string& name) { return name == "all" || (topic + "/").starts_with(name + "/"); });
      EXPECT_EQ(stages.fate(0, route, kB, message(0)).loss == LinkLoss::fault, meant) << topic << " of " << named[0];
    }
  }
}

TEST(LinkStages, OtherTopicsDoNotWaitInTheQueueOfAnEffectOnOneTopic) {
  LinkEffect effect;
  effect.bandwidth_bit_s = 8000.0;
  effect.topics = {"/x"};
  LinkStages stages = stages_of(plan_of(effect));
  RadioRoute other = kRoute;
  other.ros_topic = "/y";
  for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(stages.fate(0, other, kB, message(i)).delay_steps, 0u);
  EXPECT_EQ(stages.fate(0, kRoute, kB, message(0)).delay_steps, 2u) << "the queue of /x was empty before";
}

int differing_bits(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += std::popcount(static_cast<unsigned>(a[i] ^ b[i]));
  return bits;
}

TEST(LinkStages, CorruptionFlipsBitsOfTheContentWithItsProbability) {
  LinkEffect effect;
  effect.corruption = 0.25;
  LinkStages stages = stages_of(plan_of(effect)), again = stages_of(plan_of(effect));
  int corrupted = 0, single = 0;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const SentMessage sent = message(i, 1 + i % 60);
    const LinkFate fate = stages.fate(i, kRoute, kB, sent);
    const Payload repeated = again.fate(i, kRoute, kB, sent).payload;
    ASSERT_EQ(fate.payload == nullptr, repeated == nullptr);
    if (!fate.payload) continue;
    EXPECT_EQ(*fate.payload, *repeated);
    ASSERT_GT(sent.payload->size(), 4U) << "there is no content to flip";
    ASSERT_EQ(fate.payload->size(), sent.payload->size());
    EXPECT_TRUE(std::equal(sent.payload->begin(), sent.payload->begin() + 4, fate.payload->begin()));
    const int bits = differing_bits(*sent.payload, *fate.payload);
    EXPECT_TRUE(bits == 1 || bits == 3) << bits;
    ++corrupted;
    single += bits == 1;
  }
  EXPECT_NEAR(corrupted, 8000 * 0.25 * 56 / 60, 160);
  EXPECT_GT(single, corrupted / 3);
  EXPECT_LT(single, corrupted);
}

TEST(LinkStages, CorruptionLeavesTheOtherDrawsAsTheyAre) {
  LinkEffect effect;
  effect.loss = 0.3;
  effect.jitter_s = 0.3;
  effect.duplication = 0.3;
  LinkStages without = stages_of(plan_of(effect));
  effect.corruption = 0.5;
  LinkStages with = stages_of(plan_of(effect));
  for (std::uint64_t i = 0; i < 2000; ++i) {
    EXPECT_TRUE(same(with.fate(i, kRoute, kB, message(i)), without.fate(i, kRoute, kB, message(i))));
  }
}

TEST(LinkStages, AWaitingFaultActsAsIfItsTimeHadBeenInTheFile) {
  LinkEffect effect;
  effect.loss = 0.3;
  effect.burst_loss = BurstLoss{0.5, 0.5, 1.0};
  for (const double at_s : {0.05, 1.0, 2.5}) {
    const Tick tick = ticks(at_s);
    FaultPlan waiting = plan_of(effect);
    waiting.faults[0].when = FaultCondition{"held > 0"};
    waiting.faults[0].waits = true;
    waiting.faults[0].for_s = 1.0;
    LinkStages stages = stages_of(waiting), known = stages_of(plan_of(effect, at_s, at_s + 1.0));
    const auto begin = static_cast<std::uint64_t>(tick / 20);
    for (std::uint64_t k = 0; k < 100; ++k) {
      if (k >= begin) stages.set_off(0, tick);  // told again and again
      EXPECT_TRUE(same(stages.fate(k, kRoute, kB, message(k)), known.fate(k, kRoute, kB, message(k)))) << k;
    }
    LinkStages restarted = stages_of(waiting);  // learns of the fault after its beginning
    restarted.set_off(0, tick);
    LinkStages known_again = stages_of(plan_of(effect, at_s, at_s + 1.0));
    for (std::uint64_t k = begin + 7; k < 100; ++k) {
      EXPECT_TRUE(same(restarted.fate(k, kRoute, kB, message(k)), known_again.fate(k, kRoute, kB, message(k)))) << k;
    }
  }
}

TEST(LinkStages, DelaysOfSeveralEffectsAddUp) {
  Scenario scenario = two_uavs();
  LinkEffect latency;
  latency.latency_s = 0.1;
  scenario.links = {latency, latency};
  LinkStages stages(scenario, plan_of(latency), kSeed);
  EXPECT_EQ(stages.fate(0, kRoute, kB, message(0)).delay_steps, 6u);
}

// A fault that a viewer adds during a run acts as if it had been in the fault file from the start, also for a router
// that starts in the middle of the run.
TEST(LinkStages, FaultsByHandActLikeThoseOfAFile) {
  constexpr std::uint64_t kSteps = 400;
  std::mt19937_64 random(3);
  const auto below = [&](std::uint64_t n) { return random() % n; };
  for (int round = 0; round < 30; ++round) {
    LinkEffect own;
    own.loss = 0.2;
    own.burst_loss = BurstLoss{1.0, 0.5};
    const FaultPlan planned = plan_of(own, 1.0);
    std::vector<Fault> whole;  // the faults with their ends, as known after the run
    for (int i = 0; i < 5; ++i) {
      Fault fault{.at_s = 0.05 * static_cast<double>(1 + below(kSteps)), .until_s = {}, .action = Blackout{"a"}};
      if (below(3) > 0) fault.until_s = fault.at_s + 0.05 * static_cast<double>(1 + below(100));
      LinkEffect effect;
      effect.from = {below(2) == 0 ? "a" : "all"};
      effect.loss = 0.5;
      effect.latency_s = below(2) == 0 ? 0.0 : 0.2;
      effect.burst_loss = BurstLoss{0.5, 0.5};
      if (i % 2 == 0) fault.action = effect;
      whole.push_back(fault);
    }
    std::ranges::stable_sort(whole, {}, &Fault::at_s);
    /// The faults as a step reports them: those that have begun, with the ends that are known by then.
    const auto told = [&](std::uint64_t k) {
      const Tick tick = static_cast<Tick>(k) * two_uavs().exchange_ticks();
      std::vector<Fault> known;
      for (Fault fault : whole) {
        if (fault.begin() > tick) continue;
        if (fault.end() && *fault.end() > tick) fault.until_s.reset();
        known.push_back(fault);
      }
      return known;
    };
    FaultPlan file = planned;
    file.faults.insert(file.faults.end(), whole.begin(), whole.end());
    LinkStages of_file = stages_of(file), by_hand = stages_of(planned);
    std::optional<LinkStages> restarted;
    const std::uint64_t restart = below(kSteps);
    for (std::uint64_t k = 0; k < kSteps; ++k) {
      if (k == restart) restarted.emplace(two_uavs(), planned, kSeed);
      by_hand.set_by_hand(told(k));
      if (restarted) restarted->set_by_hand(told(k));
      for (std::uint64_t i = 0; i < 3; ++i) {
        const LinkFate expected = of_file.fate(k, kRoute, kB, message(3 * k + i));
        EXPECT_TRUE(same(by_hand.fate(k, kRoute, kB, message(3 * k + i)), expected)) << round << " step " << k;
        if (!restarted) continue;
        EXPECT_TRUE(same(restarted->fate(k, kRoute, kB, message(3 * k + i)), expected)) << round << " step " << k;
      }
    }
  }
}

}  // namespace
}  // namespace skein::router
