#include "sim_server/viz/trails.hpp"

#include <gtest/gtest.h>

namespace skein::sim::viz {
namespace {

/// For all times of exchanges, a trail is the flight of the last minute, with points at most a period and an exchange
/// apart.
TEST(Trails, TrailsContainTheLastMinuteOfTheFlight) {
  for (const Tick exchange : {20, 40, 140, 400}) {
    Trails trails(2);
    std::vector<UavView> views(2);
    for (Tick tick = 0; tick < 3 * Trails::kSpan; tick += exchange) {
      for (std::size_t i = 0; i < views.size(); ++i) views[i].state.p_WB = {seconds(tick), static_cast<double>(i), 0.0};
      const std::size_t before = trails.of(UavIndex(0)).size();
      const bool fresh = trails.add(tick, views);
      const auto& places = trails.of(UavIndex(1));
      ASSERT_FALSE(places.empty());
      EXPECT_EQ(fresh, places.back() == views[1].state.p_WB);
      if (!fresh) {
        EXPECT_EQ(places.size(), before);
      }
      EXPECT_GE(places.front().x(), seconds(tick - Trails::kSpan - Trails::kPeriod - exchange));
      if (tick > Trails::kSpan) {
        EXPECT_LE(places.front().x(), seconds(tick - Trails::kSpan + Trails::kPeriod + exchange));
      }
      for (std::size_t n = 1; n < places.size(); ++n) {
        const double step = places[n].x() - places[n - 1].x();
        ASSERT_GE(step, seconds(Trails::kPeriod));
        ASSERT_LE(step, seconds(Trails::kPeriod + exchange));
        ASSERT_EQ(places[n].y(), 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace skein::sim::viz
