#include "uav_agent/separation.hpp"

#include <gtest/gtest.h>

namespace skein::agent {
namespace {

constexpr double kDtS = 0.25;

AgentConfig fleet(std::size_t self, const std::vector<Vector3d>& starts) {
  AgentConfig config;
  config.self = self;
  for (const Vector3d& start : starts) {
    FleetMember member;
    member.p_WB_start = start;
    config.fleet.push_back(member);
  }
  return config;
}

Peers one_peer(const AgentConfig& config, std::size_t uav, const Vector3d& p, const Vector3d& v) {
  Peers peers(config);
  peers.update(0, {{.node = node_of_uav(uav), .p_W = p, .v_W = v}});
  return peers;
}

std::vector<Vector3d> eastwards(double speed) {
  return positions_ahead({0.0, 0.0, 10.0}, {{{50.0, 0.0, 10.0}, speed}}, kDtS, 13);
}

TEST(Separation, PositionsAheadKeepTheSpeedOfEachLegAndStopAtTheEnd) {
  const auto ahead = positions_ahead({0, 0, 0}, {{{2, 0, 0}, 4.0}, {{2, 1, 0}, 1.0}}, 0.25, 9);
  ASSERT_EQ(ahead.size(), 9U);
  EXPECT_NEAR((ahead[1] - Vector3d(1, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((ahead[3] - Vector3d(2, 0.25, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((ahead[8] - Vector3d(2, 1, 0)).norm(), 0.0, 1e-9);
}

TEST(Separation, TheLowerNumberHasTheRightOfWay) {
  const std::vector<Vector3d> starts = {{0, 0, 0}, {20, 0, 0}};
  const Vector3d p(12.0, -12.0, 10.0), v(0.0, 4.0, 0.0);  // crosses at the same time
  const AgentConfig low = fleet(0, starts), high = fleet(1, starts);
  EXPECT_EQ(Separation({}, low).judge(0, eastwards(4.0), kDtS, one_peer(low, 1, p, v)), Traffic::wait)
      << "so tight that even the right of way does not help";
  const Vector3d passes_by(12.0, -7.5, 10.0);
  EXPECT_EQ(Separation({}, low).judge(0, eastwards(4.0), kDtS, one_peer(low, 1, passes_by, v)), Traffic::clear);
  EXPECT_EQ(Separation({}, high).judge(0, eastwards(4.0), kDtS, one_peer(high, 0, passes_by, v)), Traffic::wait);
}

TEST(Separation, GoesAroundWhoeverStandsInTheWayForAWhile) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {20, 0, 0}});
  const Peers peers = one_peer(config, 1, {8.0, 0.5, 10.0}, Vector3d::Zero());
  Separation separation({}, config);
  EXPECT_EQ(separation.judge(0, eastwards(4.0), kDtS, peers), Traffic::wait);
  Tick tick = 0;
  Traffic last = Traffic::wait;
  while (tick < ticks(5.0) && last == Traffic::wait) last = separation.judge(tick += 20, eastwards(4.0), kDtS, peers);
  EXPECT_EQ(last, Traffic::go_around);
  EXPECT_EQ(separation.keep_out({0.0, 0.0, 10.0}, peers).size(), 1U);
  EXPECT_TRUE(separation.keep_out({90.0, 0.0, 10.0}, peers).empty()) << "far away";
}

TEST(Separation, MovingApartIsNeverAConflict) {
  const AgentConfig config = fleet(1, {{0, 0, 0}, {20, 0, 0}});
  const Peers peers = one_peer(config, 0, {-1.5, 0.0, 10.0}, Vector3d::Zero());
  EXPECT_EQ(Separation({}, config).judge(0, eastwards(2.0), kDtS, peers), Traffic::clear);
}

TEST(Separation, NeighboursLiftOffOneAfterTheOther) {
  const AgentConfig config = fleet(1, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Separation separation({}, config);
  EXPECT_FALSE(separation.may_lift_off(0, Peers(config))) << "number 0 still stands there";
  EXPECT_FALSE(separation.may_lift_off(400, one_peer(config, 0, {0, 0, 2.0}, {0, 0, 2.0})));
  EXPECT_TRUE(separation.may_lift_off(800, one_peer(config, 0, {0, 0, 3.5}, {0, 0, 2.0})));
  const AgentConfig far = fleet(1, {{0, 0, 0}, {30, 0, 0}});
  EXPECT_TRUE(Separation({}, far).may_lift_off(0, Peers(far)));
  Separation patient({}, config);
  EXPECT_FALSE(patient.may_lift_off(0, Peers(config)));
  EXPECT_TRUE(patient.may_lift_off(ticks(6.0), Peers(config))) << "number 0 seems to be broken";
}

}  // namespace
}  // namespace skein::agent
