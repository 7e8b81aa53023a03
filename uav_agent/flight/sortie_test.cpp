#include "uav_agent/flight/sortie.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "uav_agent/testing/look_around.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

using Turn = Sortie::Turn;

/// A UAV that is always where it was told to be, half a second later.
class OneSortie : public testing::Test {
 protected:
  OneSortie() {
    agent_.fleet = {{.name = "a", .body_radius_m = 0.4}};
    agent_.station_position = {20.0, 0.0, 0.3};
  }

  Turn step() { return step(sortie_); }
  Turn step(Sortie& sortie) {
    tick_ += ticks(0.5);
    Peers peers(agent_);
    peers.update(tick_, seen_);
    TrackingState tracking;
    tracking.setpoint.p_WB = p_WB_;
    tracking.done = true;
    tracking.airborne = p_WB_.z() > 0.5;
    RigidBodyState state;
    state.p_WB = p_WB_;
    const PlannerInput in{.k = static_cast<std::uint64_t>(tick_ / 20),
                          .tick = tick_,
                          .state = state,
                          .gimbal = {},
                          .tracking = tracking,
                          .map = map_,
                          .boxes = boxes_,
                          .peers = peers,
                          .mission_remaining_s = remaining_s_,
                          .station_linked = linked_,
                          .undelivered_captures = undelivered_,
                          .detected = {},
                          .radio = {}};
    PlannerOutput out;
    const Turn turn = sortie.step(in, {}, out);
    if (turn == Turn::work && retreats_ && ++worked_ % 25 == 0) sortie.pilot().retreat(in, out);
    if (const Path* path = std::get_if<Path>(&out.motion)) p_WB_ = path->waypoints.back().p_WB;
    turned_ += out.yaw.has_value();
    if (waits_) sortie_.waits_for(0, in, out);
    waited_ += out.waits_for.has_value();
    return turn;
  }
  /// Steps until something else than nothing is to be done.
  Turn next(int patience = 200) {
    for (int i = 0; i < patience; ++i) {
      if (const Turn turn = step(); turn != Turn::nothing) return turn;
    }
    return Turn::nothing;
  }

  AgentConfig agent_;
  std::vector<OrientedBox> boxes_;
  OccupancyMap map_;
  Sortie sortie_{{.deliver_every_s = 30.0}, agent_};
  Tick tick_ = 0;
  Vector3d p_WB_ = {0.0, 0.0, 0.1};
  std::optional<double> remaining_s_;
  std::vector<Neighbour> seen_;
  bool linked_ = false;
  std::size_t undelivered_ = 0;
  bool waits_ = false, retreats_ = false;
  int turned_ = 0, waited_ = 0, worked_ = 0;  ///< exchanges
};

TEST_F(OneSortie, NobodyBeginsBeforeTheBoxesAreKnown) {
  EXPECT_EQ(next(), Turn::nothing);
  EXPECT_GT(p_WB_.z(), 1.5) << "but it climbs";
  EXPECT_FALSE(sortie_.working());
  sortie_.know_site(20.0, 0.0);
  EXPECT_EQ(next(), Turn::begin);
  EXPECT_TRUE(sortie_.working());
  EXPECT_EQ(step(), Turn::work);
}

TEST_F(OneSortie, WhoBeginsInTheAirWasRestartedAndGoesToWorkWhereItIs) {
  p_WB_ = {3.0, 4.0, 17.0};
  sortie_.know_site(20.0, 0.0);
  EXPECT_EQ(next(), Turn::begin);
  EXPECT_EQ(p_WB_, Vector3d(3.0, 4.0, 17.0));
}

TEST_F(OneSortie, WhoBeginsRightAboveItsStartClimbsOnAsHighAsFromTheGround) {
  boxes_ = {make_box({12.0, 0.0, 10.0}, {6.0, 6.0, 20.0})};
  sortie_.know_site(20.0, 12.0);
  EXPECT_EQ(next(), Turn::begin);
  const double top_m = p_WB_.z();
  EXPECT_GT(top_m, 12.0);
  for (const double height_m : {3.0, 7.0, 11.0, top_m, top_m + 5.0}) {
    Sortie restarted({.deliver_every_s = 30.0}, agent_);
    p_WB_.z() = height_m;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(step(restarted), Turn::nothing) << "it does not know where it may fly";
    EXPECT_EQ(p_WB_.z(), height_m);
    const double rose_to_m = height_m + 0.8;  // while nobody told it anything
    p_WB_.z() = rose_to_m;
    restarted.know_site(20.0, 12.0);
    int steps = 0;
    while (step(restarted) != Turn::begin && steps < 200) ++steps;
    EXPECT_LT(steps, 200);
    EXPECT_EQ(p_WB_.z(), std::max(rose_to_m, top_m)) << "from " << height_m << " m";
  }
}

TEST_F(OneSortie, LeavesToDeliverAndBeginsAgain) {
  sortie_.know_site(20.0, 0.0);
  ASSERT_EQ(next(), Turn::begin);
  remaining_s_ = 1000.0;
  undelivered_ = 5;
  Turn turn = Turn::work;
  int steps = 0;
  for (; turn == Turn::work && steps < 100; ++steps) {
    p_WB_.x() += 2.0;  // it gets on
    turn = step();
  }
  EXPECT_EQ(turn, Turn::leave);
  EXPECT_NEAR(0.5 * steps, 30.0, 2.0) << "deliver_every_s";
  EXPECT_FALSE(sortie_.working());
  EXPECT_EQ(next(10), Turn::nothing) << "nothing is delivered yet";
  linked_ = true;
  undelivered_ = 0;
  EXPECT_EQ(next(), Turn::begin);
}

TEST_F(OneSortie, BelowARoofItBeginsWithoutClimbing) {
  std::vector<Eigen::Vector3f> roof;
  for (double x = -5.0; x <= 5.0; x += 0.5) {
    for (double y = -5.0; y <= 5.0; y += 0.5) roof.push_back(Vector3d(x, y, 7.0).cast<float>());
  }
  map_.insert(roof, std::nullopt);
  sortie_.know_site(20.0, 0.0);
  EXPECT_EQ(next(), Turn::begin);
  EXPECT_GT(turned_, 3) << "it has looked up";
  EXPECT_GT(p_WB_.z(), 1.0);
  EXPECT_LT(p_WB_.z(), 6.0);
}

TEST_F(OneSortie, AfterAShortLookWhatIsASideMayBeTheRestOfARoof) {
  const auto climbs_after_s = [&](double gap_m) {
    std::vector<Eigen::Vector3f> roof;
    for (double a = 0.0; a < 6.3; a += 0.3) {
      roof.push_back(Vector3d(gap_m * std::cos(a), gap_m * std::sin(a), 4.5).cast<float>());
    }
    map_ = OccupancyMap();
    map_.insert(roof, std::nullopt);
    Sortie sortie({}, agent_);
    sortie.know_site(20.0, 0.0);
    p_WB_ = {0.0, 0.0, 0.1};
    int steps = 0;
    for (; p_WB_.z() < 4.0 && steps < 200; ++steps) step(sortie);
    return 0.5 * steps;
  };
  agent_.fleet.resize(2, agent_.fleet[0]);  // a second one, so that it rises higher than that
  EXPECT_LT(climbs_after_s(6.0), 10.0) << "far off";
  EXPECT_GT(climbs_after_s(2.5), 14.0);
  EXPECT_LT(climbs_after_s(2.5), 30.0) << "a long look has shown that it has a hole";
}

TEST_F(OneSortie, APhotographerWaitsForWhatExplorersSawAndNotForEver) {
  agent_.fleet.push_back(agent_.fleet[0]);
  agent_.fleet[1].p_WB_start = {4.0, 0.0, 0.1};
  agent_.fleet[0].role = Role::photographer;
  agent_.fleet[1].role = Role::explorer;
  const auto lifts_off_after_s = [&](int explored_at) {
    Sortie sortie({}, agent_);
    sortie.know_site(20.0, 0.0);
    p_WB_ = {0.0, 0.0, 0.1};
    int steps = 0;
    for (; p_WB_.z() < 3.0 && steps < 200; ++steps) {
      if (steps == explored_at) look_around(map_, {4, 0, 1.8}, 60);
      step(sortie);
    }
    return 0.5 * steps;
  };
  const double alone_s = lifts_off_after_s(-1), led_s = lifts_off_after_s(9);
  EXPECT_GT(waited_, 10) << "and says for whom";
  EXPECT_GT(alone_s, 5.0);
  EXPECT_LT(alone_s, 40.0);
  EXPECT_GE(led_s, 4.5) << "not before";
  EXPECT_LT(led_s, alone_s - 0.9) << "at once then";
}

TEST_F(OneSortie, APhotographerThatBeganBelowInAShaftRisesWhenAnExplorerIsUpThere) {
  agent_.fleet.push_back(agent_.fleet[0]);
  agent_.fleet[1].p_WB_start = {8.0, 0.0, 0.1};
  agent_.fleet[0].role = Role::photographer;
  agent_.fleet[1].role = Role::explorer;
  std::vector<Eigen::Vector3f> shaft;
  for (double z = 0.4; z <= 4.0; z += 0.2) {
    for (double a = 0.0; a < 6.3; a += 0.2) shaft.push_back(Vector3d(std::cos(a), std::sin(a), z).cast<float>());
  }
  map_.insert(shaft, std::nullopt);
  sortie_.know_site(33.0, 20.0);
  ASSERT_EQ(next(), Turn::begin);
  for (int i = 0; i < 200; ++i) step();
  ASSERT_LT(p_WB_.z(), 3.0) << "nobody has looked";
  EXPECT_GT(waited_, 100) << "and it says for whom";
  seen_ = {{.node = node_of_uav(UavIndex{1}), .p_W = {30.0, 0.0, 20.0}}};
  for (int i = 0; i < 80; ++i) step();
  EXPECT_GT(p_WB_.z(), 4.5);
}

TEST_F(OneSortie, WhoStandsStillIsTurnedThenTakenElsewhereAndBeginsAgain) {
  sortie_.know_site(20.0, 0.0);
  ASSERT_EQ(next(), Turn::begin);
  const Vector3d stood = p_WB_;
  Turn turn = Turn::work;
  int steps = 0;
  for (; turn == Turn::work && steps < 100; ++steps) turn = step();
  EXPECT_EQ(turn, Turn::leave);
  EXPECT_LT(0.5 * steps, 20.0);
  EXPECT_GT(turned_, 3) << "its LiDAR sees more";
  EXPECT_GT((p_WB_ - stood).norm(), 5.0);
  EXPECT_EQ(next(), Turn::begin);
}

TEST_F(OneSortie, WhoFindsNoWayIsTakenAsNearAsItGets) {
  sortie_.know_site(20.0, 0.0);
  boxes_.resize(1);
  boxes_[0].center = {-30.0, -10.0, 15.0};
  boxes_[0].size = {10.0, 10.0, 20.0};
  ASSERT_EQ(next(), Turn::begin);
  const Vector3d goal = boxes_[0].center;
  PlannerOutput out;
  sortie_.pilot().no_way(goal, {{}, boxes_, map_}, out);
  EXPECT_FALSE(out.no_way.empty());
  const double before = (p_WB_ - goal).norm();
  Turn turn = Turn::work;
  for (int i = 0; i < 100 && turn == Turn::work; ++i) turn = step();
  ASSERT_EQ(turn, Turn::leave);
  EXPECT_LT((p_WB_ - goal).norm(), std::min(15.0, before)) << "beside the box that nobody may enter";
}

TEST_F(OneSortie, WhoGoesBackAndForthBelowTheHeightThatNeedsNoProofClimbsOut) {
  const double blind_m = 20.0;
  boxes_ = {make_box({60.0, 0.0, 20.0}, {6.0, 6.0, 40.0})};
  p_WB_ = {3.0, 4.0, 6.0};
  sortie_.know_site(40.0, blind_m);
  ASSERT_EQ(next(), Turn::begin);
  for (int i = 0; i < 12; ++i) {
    ASSERT_EQ(step(), Turn::work);
    p_WB_.x() += 1.0;
  }
  retreats_ = true;  // as a planner does that finds nothing to do here
  int left = 0;
  for (int i = 0; i < 400 && p_WB_.z() < blind_m; ++i) left += step() == Turn::leave;
  EXPECT_GE(left, 2) << "first it is taken elsewhere";
  EXPECT_GE(p_WB_.z(), blind_m);
  EXPECT_EQ(next(), Turn::begin);
}

TEST_F(OneSortie, WhoHasNoLidarIsNotTurned) {
  agent_.fleet[0].role = Role::photographer;
  sortie_.know_site(20.0, 0.0);
  ASSERT_EQ(next(), Turn::begin);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(turned_, 0);
}

TEST_F(OneSortie, WhoWaitsForAnotherIsLeftAloneAndSaysSo) {
  sortie_.know_site(20.0, 0.0);
  ASSERT_EQ(next(), Turn::begin);
  waits_ = true;
  for (int i = 0; i < 200; ++i) ASSERT_EQ(step(), Turn::work) << i;
  EXPECT_EQ(waited_, 200);
  waits_ = false;
  Turn turn = Turn::work;
  for (int i = 0; i < 100 && turn == Turn::work; ++i) turn = step();
  EXPECT_EQ(turn, Turn::leave) << "no longer";
}

TEST_F(OneSortie, IsHomeBeforeTheEndAndStaysThere) {
  sortie_.know_site(20.0, 0.0);
  ASSERT_EQ(next(), Turn::begin);
  remaining_s_ = 10.0;
  EXPECT_EQ(step(), Turn::leave);
  linked_ = true;
  EXPECT_EQ(next(), Turn::nothing);
}

}  // namespace
}  // namespace skein::agent
