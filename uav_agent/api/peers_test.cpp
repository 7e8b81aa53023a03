#include "uav_agent/api/peers.hpp"

#include <gtest/gtest.h>

namespace skein::agent {
namespace {

AgentConfig fleet_in_a_row(std::size_t count, std::size_t self) {
  AgentConfig config;
  config.self = UavIndex(self);
  for (std::size_t i = 0; i < count; ++i) {
    FleetMember member;
    member.p_WB_start = Vector3d(5.0 * static_cast<double>(i), 0.0, 0.0);
    config.fleet.push_back(member);
  }
  return config;
}

TEST(Peers, OtherUavsAreAssumedAtTheirStartsUntilSeen) {
  const Peers peers(fleet_in_a_row(3, 1));
  ASSERT_EQ(peers.all().size(), 2U);
  EXPECT_EQ(peers.all()[0].uav, 0U);
  EXPECT_EQ(peers.all()[1].uav, 2U);
  EXPECT_EQ(peers.all()[1].p_W, Vector3d(10.0, 0.0, 0.0));
  EXPECT_FALSE(peers.all()[1].seen);
  EXPECT_FALSE(peers.station_visible());
}

TEST(Peers, AreFoundByIndex) {
  for (std::size_t self = 0; self < 5; ++self) {
    const Peers peers(fleet_in_a_row(5, self));
    for (std::size_t uav = 0; uav < 7; ++uav) {
      const Peer* const found = peers.find(uav);
      EXPECT_EQ(found != nullptr, uav < 5 && uav != self) << uav << " for " << self;
      if (found != nullptr) {
        EXPECT_EQ(std::size_t{found->uav}, uav);
      }
    }
  }
}

TEST(Peers, TakeVelocityFromSuccessivePositionsAndForgetItAfterAGap) {
  Peers peers(fleet_in_a_row(2, 0));
  Vector3d p(0.0, 0.0, 5.0);
  for (Tick tick = 0; tick <= 400; tick += 20) {
    peers.update(tick, {{.node = Node{2}, .p_W = p}});
    p += Vector3d(0.1, 0.0, -0.05);
  }
  EXPECT_NEAR((peers.all()[0].v_W - Vector3d(2.0, 0.0, -1.0)).norm(), 0.0, 0.01);
  EXPECT_FALSE(peers.all()[0].v_told);
  peers.update(1000, {{.node = Node{2}, .p_W = p}});
  EXPECT_EQ(peers.all()[0].v_W, Vector3d::Zero());
  peers.update(1020, {{.node = Node{2}, .p_W = p, .v_W = Vector3d(0.0, 3.0, 0.0)}});
  EXPECT_EQ(peers.all()[0].v_W, Vector3d(0.0, 3.0, 0.0)) << "the velocity that the peer sends counts";
  EXPECT_TRUE(peers.all()[0].v_told);
  EXPECT_NEAR((peers.all()[0].a_W - Vector3d(0.0, 60.0, 0.0)).norm(), 0.0, 1e-9) << "3 m/s more in 0.05 s";
  peers.update(1040, {{.node = Node{2}, .p_W = p, .v_W = Vector3d(0.0, 3.0, 0.0)}});
  EXPECT_EQ(peers.all()[0].a_W, Vector3d::Zero());
  peers.update(2000, {{.node = Node{2}, .p_W = p, .v_W = Vector3d::Zero()}});
  EXPECT_EQ(peers.all()[0].a_W, Vector3d::Zero()) << "the velocity before is too old";
}

TEST(Peers, HaveOnlyTheLinkOfThePresentExchange) {
  Peers peers(fleet_in_a_row(3, 0));
  const std::vector<Neighbour> both = {{.node = kStationNode}, {.node = Node{2}}};
  const LinkQuality good{-50.0, 1.6e6}, poor{-81.0, 1.6e5};
  peers.update(0, both, {{Node{2}, poor}, {kStationNode, good}, {Node{3}, good}});
  EXPECT_EQ(peers.all()[0].link, poor);
  EXPECT_EQ(peers.station_link(), good);
  EXPECT_FALSE(peers.all()[1].link) << "that UAV is not in line of sight";
  peers.update(20, both);
  EXPECT_TRUE(peers.all()[0].visible && peers.station_visible());
  EXPECT_FALSE(peers.all()[0].link || peers.station_link()) << "ideal links have no quality";
  peers.update(40, both, {{Node{2}, good}, {kStationNode, poor}});
  peers.update(60, {}, {});
  EXPECT_FALSE(peers.all()[0].link || peers.station_link());
}

TEST(Peers, RememberWhereAUavWasLastSeen) {
  Peers peers(fleet_in_a_row(2, 0));
  peers.update(
      20,
      {{.node = kStationNode, .p_W = Vector3d::Zero()}, {.node = Node{2}, .p_W = {1.0, 2.0, 3.0}}, {.node = Node{9}}});
  EXPECT_TRUE(peers.station_visible());
  EXPECT_TRUE(peers.all()[0].visible);
  peers.update(40, {});
  EXPECT_FALSE(peers.station_visible());
  EXPECT_FALSE(peers.all()[0].visible);
  EXPECT_EQ(peers.all()[0].p_W, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(peers.all()[0].seen, Tick{20});
}

}  // namespace
}  // namespace skein::agent
