// The rule by which a UAV interrupts its work to deliver captures, with random values.
#include "uav_agent/flight/delivery_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

struct Situation {
  Stake stake;
  double hazard_per_h, wait_s, detour_s;
  bool pays() const { return delivery_pays(stake, hazard_per_h, wait_s, detour_s); }
};

Situation any_situation(RandomStream& random) {
  return {{random.uniform(0.1, 500.0), random.uniform(0.01, 5.0)},
          random.uniform(0.01, 60.0),
          random.uniform(0.1, 600.0),
          random.uniform(10.0, 120.0)};
}

void for_any_situation(const char* name, const auto& check) {
  RandomStream random(1, name, 0);
  for (int i = 0; i < 1000; ++i) check(any_situation(random));
}

TEST(DeliveryRule, MoreValueHazardOrWaitNeverSpeaksAgainstADelivery) {
  RandomStream random(1, "monotone", 0);
  int pays = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Situation before = any_situation(random);
    Situation more = before, less = before;
    more.stake.value *= random.uniform(1.0, 2.0);
    more.hazard_per_h *= random.uniform(1.0, 2.0);
    more.wait_s *= random.uniform(1.0, 2.0);
    EXPECT_GE(more.pays(), before.pays());
    less.stake.gain_per_s *= random.uniform(1.0, 2.0);
    less.detour_s *= random.uniform(1.0, 2.0);
    EXPECT_LE(less.pays(), before.pays());
    if (before.pays()) ++pays;
  }
  EXPECT_GT(pays, 2'000);
  EXPECT_LT(pays, 18'000);
}

TEST(DeliveryRule, WithoutAHazardNoDeliveryPays) {
  for_any_situation("no_hazard", [](Situation situation) {
    situation.hazard_per_h = 0.0;
    EXPECT_FALSE(situation.pays());
    situation.stake.gain_per_s = 0.0;
    EXPECT_FALSE(situation.pays()) << "nothing is lost by waiting";
  });
}

TEST(DeliveryRule, WithAHugeHazardEachDeliveryOfSomethingPays) {
  for_any_situation("huge_hazard", [](Situation situation) {
    situation.hazard_per_h = 1e9;
    EXPECT_TRUE(situation.pays());
    situation.stake.value = 0.0;
    EXPECT_FALSE(situation.pays());
  });
}

TEST(DeliveryRule, AUavWithoutWorkDeliversWhateverItHas) {
  for_any_situation("idle", [](Situation situation) {
    situation.stake.gain_per_s = 0.0;
    EXPECT_TRUE(situation.pays());
  });
}

// The comment of the header derives this interval.
TEST(DeliveryRule, SteadyWorkIsDeliveredAtTheIntervalOfTheFormula) {
  RandomStream random(1, "steady", 0);
  for (int i = 0; i < 200; ++i) {
    Situation situation = any_situation(random);
    const double formula_s = std::sqrt(3600.0 * situation.detour_s / situation.hazard_per_h);
    for (const double share : {0.99, 1.01}) {
      situation.wait_s = share * formula_s;
      situation.stake.value = situation.stake.gain_per_s * situation.wait_s;
      EXPECT_EQ(situation.pays(), share > 1.0);
    }
  }
}

}  // namespace
}  // namespace skein::agent
