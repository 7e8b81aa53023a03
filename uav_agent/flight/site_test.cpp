#include "uav_agent/flight/site.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {
namespace {

TEST(Site, TheTopOfTurnedBoxesIsTheirHighestCorner) {
  OrientedBox low, tilted;
  low.size = {10.0, 10.0, 4.0};
  tilted.center = {0.0, 0.0, 20.0};
  tilted.size = {6.0, 2.0, 8.0};
  tilted.R_WO = Eigen::AngleAxisd(0.5, Vector3d::UnitY()).toRotationMatrix();
  EXPECT_DOUBLE_EQ(top_of({}), 0.0);
  EXPECT_DOUBLE_EQ(top_of({low}), 2.0);
  EXPECT_NEAR(top_of({low, tilted}), 20.0 + 3.0 * std::sin(0.5) + 4.0 * std::cos(0.5), 1e-9);
}

TEST(Site, ASiteBoxIsWideBothWaysAndHigh) {
  OrientedBox box;
  box.size = {50.0, 60.0, 30.0};
  EXPECT_TRUE(is_site_box(box));
  for (int axis = 0; axis < 3; ++axis) {
    OrientedBox narrow = box;
    narrow.size[axis] = 15.0;
    EXPECT_FALSE(is_site_box(narrow)) << axis;
  }
}

TEST(Site, TheWayOutLeavesAllBoxesThatTheUavEntersOnItsClimb) {
  int more = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed, "way_out", 0);
    std::vector<OrientedBox> boxes(1 + random.bits() % 6);
    for (OrientedBox& box : boxes) {
      box.center = Vector3d(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), random.uniform(0.0, 40.0));
      box.size = Vector3d(random.uniform(2.0, 14.0), random.uniform(2.0, 14.0), random.uniform(2.0, 14.0));
      const Vector3d axis_W(random.normal(), random.normal(), random.normal());
      if (random.bits() % 2 == 0) {
        box.R_WO = Eigen::AngleAxisd(random.uniform(0.0, 1.5), axis_W.normalized()).toRotationMatrix();
      }
    }
    const auto in_any = [&](double z, double margin_m) {
      return std::ranges::any_of(boxes, [&](const OrientedBox& box) { return box.contains({0.0, 0.0, z}, margin_m); });
    };
    const double margin_m = random.uniform(0.0, 2.0), from_m = random.uniform(0.0, 10.0);
    const std::optional<double> out_m = way_out_m(boxes, {0.0, 0.0, from_m}, margin_m);
    ASSERT_EQ(out_m.has_value(), in_any(from_m, 0.0)) << "seed " << seed;
    none += out_m ? 0 : 1;
    if (!out_m) continue;
    EXPECT_FALSE(in_any(*out_m, margin_m)) << "seed " << seed;
    for (double z = from_m; z < *out_m - 0.01; z += 0.05)
      EXPECT_TRUE(in_any(z, margin_m)) << "seed " << seed << ", " << z;
    const auto starts_in = [&](const OrientedBox& box) { return box.contains({0.0, 0.0, from_m}); };
    more += std::ranges::none_of(boxes, [&](const OrientedBox& box) {
      return starts_in(box) && box.contains({0.0, 0.0, *out_m - 0.01}, margin_m);
    });
  }
  EXPECT_GT(none, 10);
  EXPECT_GT(more, 10) << "the way out often leads through further boxes";
}

TEST(Due, ATaskIsDueOncePerPeriodAndTheOffsetShiftsIt) {
  const AgentConfig agent;
  std::set<std::uint64_t> first, second;
  for (std::uint64_t k = 0; k < 100; ++k) {
    if (agent.due(k, 0.5, 0)) first.insert(k % 10);
    if (agent.due(k, 0.5, 3)) second.insert(k % 10);
    EXPECT_TRUE(agent.due(k, 0.0, 0)) << "with a period of 0, in each exchange";
  }
  EXPECT_EQ(first, std::set<std::uint64_t>({0}));
  EXPECT_EQ(second, std::set<std::uint64_t>({7}));
}

TEST(Due, APeriodOfAnyNumberOfExchangesIsKept) {
  AgentConfig agent;
  for (const double exchange_s : {0.0025, 0.05, 0.1, 0.3}) {
    agent.exchange_period_s = exchange_s;
    for (std::uint64_t period = 1; period <= 200; ++period) {
      const double every_s = seconds(static_cast<Tick>(period) * ticks(exchange_s));
      for (std::uint64_t k = 1; k < period; ++k) EXPECT_FALSE(agent.due(k, every_s, 0)) << exchange_s << ' ' << period;
      EXPECT_TRUE(agent.due(period, every_s, 0)) << exchange_s << ' ' << period;
    }
  }
}

}  // namespace
}  // namespace skein::agent
