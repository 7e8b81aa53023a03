// The outcomes that a UAV of XXH gets for its goals. The test takes the part of the flight core.
#include "uav_agent/planners/xxh/errand.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/planners/xxh/post.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

using Kind = Outcome::Kind;

AgentConfig second_of_three() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}, {.name = "b", .p_WB_start = {3.0, 0.0, 0.2}}, {.name = "c"}};
  agent.self = UavIndex(1);
  return agent;
}

/// One UAV with its errand; the core does what the test says.
struct Asked : FlownUav {
  Asked() : FlownUav(second_of_three(), {0.0, 0.0, 10.0}) { flight.working = true; }

  /// One exchange.   @param decide  what the planner does in it.
  void exchange(const auto& decide) {
    PlannerInput in = input();
    in.flight = std::exchange(flight, {.working = true});
    in.space = &space;
    PlannerOutput out;
    errand.listen(in);
    decide(in, out);
    errand.conclude(out);
    told = std::move(out.goals);
    ++k;
  }
  void exchange() {
    exchange([](const PlannerInput&, PlannerOutput&) {});
  }
  void set_out(std::size_t choices) {
    exchange([&](const PlannerInput&, PlannerOutput& out) { errand.set_out(places(choices), out); });
    asked = told.value_or(std::vector<Goal>());
  }
  static std::vector<Goal> places(std::size_t count) {
    std::vector<Goal> goals(count);
    for (std::size_t i = 0; i < count; ++i) goals[i].way = {{{10.0 * static_cast<double>(i), 0.0, 10.0}, 1.0}};
    return goals;
  }
  /// The core will report this outcome in the next exchange.
  void becomes(std::size_t choice, Kind kind) { flight.outcomes.push_back({.id = asked[choice].id, .kind = kind}); }

  FreeSpace space{FreeSpace::Config(), boxes, hits};
  XxhErrand errand;
  FlightState flight;
  std::optional<std::vector<Goal>> told;  ///< in the last exchange
  std::vector<Goal> asked;
};

TEST(XxhErrand, EndsWithTheFirstReachedChoiceAndFliesToNoOther) {
  Asked uav;
  uav.set_out(3);
  uav.becomes(0, Kind::no_way);
  uav.becomes(1, Kind::reached);
  uav.exchange();
  EXPECT_FALSE(uav.errand.under_way());
  EXPECT_EQ(uav.errand.missed(), std::vector<std::size_t>{0});
  ASSERT_TRUE(uav.errand.ended());
  EXPECT_EQ(uav.errand.ended()->choice, 1U);
  EXPECT_TRUE(uav.errand.ended()->reached);
  ASSERT_TRUE(uav.told) << "else the core would fly on to the third";
  EXPECT_TRUE(uav.told->empty());
  uav.exchange();
  EXPECT_FALSE(uav.told);
  EXPECT_FALSE(uav.errand.ended()) << "the end is reported once";
}

TEST(XxhErrand, IsUnderWayUntilAllChoicesHaveFailed) {
  Asked uav;
  uav.set_out(3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(uav.errand.under_way());
    uav.becomes(i, Kind::no_way);
    uav.exchange();
    EXPECT_EQ(uav.errand.came_to_nothing(), i == 2);
  }
  EXPECT_FALSE(uav.errand.under_way());
}

TEST(XxhErrand, ChoicesAreDroppedWhenTheFlightCoreDoesSomethingElse) {
  Asked uav;
  uav.set_out(2);
  uav.flight.working = false;
  uav.exchange();
  EXPECT_FALSE(uav.errand.under_way());
  ASSERT_TRUE(uav.told) << "the core must not fly to its former goals afterwards";
  EXPECT_TRUE(uav.told->empty());
}

// In any order in which the core reports outcomes of old and new goals, only those of the last list count.
TEST(XxhErrand, OutcomesOfEarlierGoalsDoNotCount) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    RandomStream random(seed, "errand", 0);
    Asked uav;
    std::vector<Goal> old;
    for (int lists = 0; lists < 4; ++lists) {
      old.insert(old.end(), uav.asked.begin(), uav.asked.end());
      uav.set_out(1 + random.bits() % 4);
    }
    std::size_t missed = 0;
    bool ended = false;
    for (int i = 0; i < 6 && !ended && missed < uav.asked.size(); ++i) {
      const Kind kind = random.bits() % 3 > 0 ? Kind::no_way : Kind::blocked;
      if (random.bits() % 2 == 0) {
        uav.flight.outcomes.push_back({.id = old[random.bits() % old.size()].id, .kind = kind});
      } else {
        uav.becomes(missed, kind);
        (kind == Kind::no_way) ? ++missed : ended = true, void();
      }
      uav.exchange();
      EXPECT_EQ(uav.errand.under_way(), !ended && missed < uav.asked.size()) << seed;
      EXPECT_EQ(uav.errand.ended().has_value(), ended) << seed;
    }
  }
}

TEST(XxhErrand, KnowsThePlacesThatComeNext) {
  Asked uav;
  uav.set_out(2);
  uav.flight.goal = uav.asked[1].id;
  uav.exchange([&](const PlannerInput& in, PlannerOutput&) {
    EXPECT_EQ(uav.errand.flies_to(in), 1U);
    const std::vector<Vector3d> ahead = uav.errand.ahead(in);
    ASSERT_EQ(ahead.size(), 2U);
    EXPECT_EQ(ahead.front(), in.tracking.setpoint.p_WB);
    EXPECT_EQ(ahead.back(), uav.asked[1].way.front().p_WB);
  });
}

struct AtPost : Asked {
  AtPost() : post(agent) {}
  void stay(const std::vector<Vector3d>& places_W) {
    exchange([&](const PlannerInput& in, PlannerOutput& out) { post.stay(places_W, 4.0, errand, in, out); });
    if (told && !told->empty()) asked = *told;
  }
  /// @returns whether the UAV sets a goal within `s` seconds.
  bool asks_within(double s, const std::vector<Vector3d>& places_W) {
    for (int i = 0; i < static_cast<int>(s / agent.exchange_period_s); ++i) {
      stay(places_W);
      if (told && !told->empty()) return true;
    }
    return false;
  }
  XxhPost post;
};

const std::vector<Vector3d> kPosts = {{20.0, 0.0, 1.0}, {20.0, 0.0, 9.0}, {20.0, 0.0, 14.0}};

TEST(XxhPost, TheUavStaysAtTheFirstFreePostThatItReaches) {
  AtPost uav;
  uav.stay(kPosts);
  ASSERT_EQ(uav.asked.size(), 2U) << "the first place is lower than UAVs may fly";
  EXPECT_EQ(uav.asked[0].way.front().p_WB, kPosts[1]);
  uav.becomes(0, Kind::no_way);
  uav.becomes(1, Kind::reached);
  ASSERT_TRUE(uav.asks_within(3.0, kPosts)) << "the core would take a UAV without a goal elsewhere";
  ASSERT_EQ(uav.asked.size(), 1U);
  EXPECT_EQ(uav.asked[0].way.front().p_WB, kPosts[2]);
}

TEST(XxhPost, WithoutAFreePostTheUavWaitsWhereItIsAndTriesAgain) {
  AtPost uav;
  uav.stay({{20.0, 0.0, 1.0}});
  ASSERT_EQ(uav.asked.size(), 1U);
  EXPECT_EQ(uav.asked[0].way.front().p_WB, uav.input().tracking.setpoint.p_WB);
  uav.becomes(0, Kind::reached);
  ASSERT_TRUE(uav.asks_within(3.0, kPosts));
  EXPECT_EQ(uav.asked[0].way.front().p_WB, kPosts[1]);
}

TEST(XxhPost, WithoutAPathTheUavSetsNoGoalForAWhileSoThatTheCoreCanRecover) {
  AtPost uav;
  uav.stay(kPosts);
  uav.becomes(0, Kind::no_way);
  uav.becomes(1, Kind::no_way);
  EXPECT_FALSE(uav.asks_within(4.5, kPosts)) << "the core helps a UAV that has set no goal for 4 s";
  EXPECT_TRUE(uav.asks_within(2.0, kPosts));
}

TEST(XxhPost, MembersWaitApart) {
  AtPost uav;
  for (std::size_t rank = 0; rank < 4; ++rank) {
    const auto posts = uav.post.beside({30.0, 0.0, 5.0}, {40.0, 0.0, 5.0}, rank, 20.0);
    ASSERT_FALSE(posts.empty());
    for (const Vector3d& post : posts) {
      EXPECT_NEAR(post.x(), 30.0 - 4.0 * static_cast<double>(rank + 1), 1e-9)
          << "members wait on the side away from the region";
      EXPECT_GE(post.z(), 4.0);
    }
  }
}

}  // namespace
}  // namespace skein::agent
