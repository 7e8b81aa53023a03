// The cache keeps plans, returns them to the last bit, and ignores damaged files.
#include "sim_server/plan/plan_cache.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <functional>

#include "sim_server/testing/plan_site.hpp"

namespace skein::sim {
namespace {

class PlanCache : public ::testing::Test {
 protected:
  PlanCache() : site_(1, 20.0) {
    std::string name = std::filesystem::path(testing::TempDir()) / "skein_plan_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
    folder_ = name;
    site_.config.rounds = 1;
    site_.config.most_views = 200;
    site_.config.most_seeds = 40;
  }
  ~PlanCache() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  PlanReply ask(bool search) const {
    return ask_plan(site_.scenario, site_.scene, {site_.config, search, folder_ / "below"});
  }
  std::string key() const { return plan_key(site_.scenario, site_.scene, site_.config); }

  std::filesystem::path folder_;
  test::PlanSite site_;
};

TEST_F(PlanCache, TheCacheHasAPlanOnlyAfterASearch) {
  EXPECT_FALSE(ask(false).plan);
  const PlanReply first = ask(true), second = ask(false);
  ASSERT_TRUE(first.plan && second.plan);
  EXPECT_TRUE(first.warnings.empty() && second.warnings.empty());
  EXPECT_EQ(to_json(*first.plan), to_json(*second.plan));
  EXPECT_GT(second.plan->flown.score, 0.0);
  EXPECT_EQ(second.plan->uavs[0].moves.front().from_W, first.plan->uavs[0].moves.front().from_W);
}

TEST_F(PlanCache, ADamagedFileIsReplaced) {
  const PlanReply first = ask(true);
  std::ofstream(folder_ / "below" / ("plan-" + key() + ".json")) << "{\"key\": \"\"}";
  EXPECT_FALSE(ask(false).plan);
  const PlanReply again = ask(true);
  EXPECT_EQ(again.warnings.size(), 1u);
  EXPECT_EQ(to_json(again.plan.value()), to_json(first.plan.value()));
  EXPECT_TRUE(ask(false).warnings.empty());
}

TEST_F(PlanCache, TheKeyChangesWithEachInputOfAPlan) {
  const std::vector<std::function<void()>> changes = {
      [&] { site_.scenario.duration_s += 1.0; },
      [&] { site_.scenario.station_position.x() += 1.0; },
      [&] { site_.scenario.fleet[0].start.x() += 1.0; },
      [&] { site_.scenario.fleet[0].start_yaw += 1.0; },
      [&] { site_.scenario.fleet[0].vehicle.max_speed_mps += 1.0; },
      [&] { site_.scenario.fleet[0].vehicle.gimbal.rate_limit_deg_s += 1.0; },
      [&] { site_.scenario.fleet.push_back(site_.scenario.fleet[0]); },
      [&] { site_.scenario.links.emplace_back().range_m = 50.0; },
      [&] { site_.scenario.rules.guard_position_commands = false; },
      [&] { site_.scene.points.pop_back(); },
      [&] { site_.config.margin_m += 0.1; },
      [&] { ++site_.config.rounds; },
      [&] { ++site_.config.seed; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::string last = key();
    changes[i]();
    EXPECT_NE(key(), last) << i;
  }
  site_.config.threads = 7;
  const std::string now = key();
  site_.config.threads = 1;
  EXPECT_EQ(key(), now);
}

}  // namespace
}  // namespace skein::sim
