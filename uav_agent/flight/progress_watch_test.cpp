// Who moves or photographs gets on; who does neither does not.
#include "uav_agent/flight/progress_watch.hpp"

#include <gtest/gtest.h>

#include "core/random_stream.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {
namespace {

class Watch : public testing::Test {
 protected:
  void see(const Vector3d& p_WB, const std::vector<DetectedPoint>& detected = {}, bool retreats = false) {
    tick_ += ticks(0.5);
    const Peers peers(agent_);
    RigidBodyState state;
    state.p_WB = p_WB;
    const PlannerInput in{.tick = tick_,
                          .state = state,
                          .gimbal = {},
                          .tracking = {},
                          .map = map_,
                          .boxes = boxes_,
                          .peers = peers,
                          .mission_remaining_s = std::nullopt,
                          .detected = detected,
                          .radio = {}};
    watch_.update(in, retreats);
  }
  double still_s() const { return watch_.still_s(tick_); }

  AgentConfig agent_;
  std::vector<OrientedBox> boxes_;
  OccupancyMap map_;
  ProgressWatch watch_;
  Tick tick_ = 0;
};

TEST_F(Watch, GrowsWhileItStaysAboutAPlace) {
  RandomStream random(3, "watch", 0);
  see({10, 0, 5});
  for (int i = 0; i < 100; ++i) see({10 + random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 5});
  EXPECT_NEAR(still_s(), 50.0, 1e-9);
}

TEST_F(Watch, BeginsAnewWithEachThreeMetres) {
  for (int i = 0; i < 100; ++i) {
    see({10 + 0.7 * i, 0, 5});
    EXPECT_LE(still_s(), 2.5);
  }
}

TEST_F(Watch, BeginsAnewWithWhatIsNewOrBetterInAPicture) {
  see({10, 0, 5});
  for (int i = 0; i < 20; ++i) see({10, 0, 5}, {{.score = 0.5, .order = 3}});
  EXPECT_NEAR(still_s(), 9.5, 1e-9) << "new once";
  see({10, 0, 5}, {{.score = 0.6, .order = 3}});
  EXPECT_EQ(still_s(), 0.0) << "better";
  see({10, 0, 5}, {{.score = 0.4, .order = 3}});
  EXPECT_NEAR(still_s(), 0.5, 1e-9) << "worse";
  see({10, 0, 5}, {{.score = 0.1, .order = 4}});
  EXPECT_EQ(still_s(), 0.0) << "another point";
}

TEST_F(Watch, BackAndForthIsNoGettingOn) {
  see({10, 0, 5});
  for (int i = 0; i < 60; ++i) {
    see({10.0 + 8.0 * (i / 6 % 2), 0, 5}, {}, true);
    EXPECT_LE(watch_.here_s(tick_), 3.0) << "but it is elsewhere";
  }
  EXPECT_NEAR(still_s(), 30.0, 1e-9);
  for (int i = 0; i < 3; ++i) see({18, 1.0 * i, 5});
  EXPECT_GT(still_s(), 30.0) << "not yet";
  see({18, 4, 5});
  EXPECT_EQ(still_s(), 0.0);
}

TEST_F(Watch, WhoPhotographsOnItsWayIsNotWhereItWas) {
  for (std::uint32_t i = 0; i < 60; ++i) {
    see({0.9 * i, 0, 5}, {{.score = 0.5, .order = i}});
    EXPECT_LE(watch_.here_s(tick_), 2.0);
  }
}

}  // namespace
}  // namespace skein::agent
