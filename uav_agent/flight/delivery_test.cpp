#include "uav_agent/flight/delivery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "uav_agent/planning/survey.hpp"

namespace skein::agent {
namespace {

OrientedBox tower(double yaw = 0.0) {
  OrientedBox box;
  box.center = {10.0, 0.0, 20.0};
  box.size = {16.0, 30.0, 40.0};
  box.R_WO = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  return box;
}

AgentConfig fleet_of(std::size_t count, std::size_t self) {
  AgentConfig config;
  config.self = UavIndex(self);
  config.fleet.resize(count);
  config.station_position = {-1.0, 0.0, 0.3};
  return config;
}

TEST(DeliveryPlaces, SeeTheStationAndAreApart) {
  const std::vector<OrientedBox> boxes = {tower()};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  std::vector<Vector3d> best;
  for (std::size_t self = 0; self < 5; ++self) {
    const auto places = delivery_places(fleet_of(5, self), space, 12.0);
    ASSERT_FALSE(places.empty());
    for (const Vector3d& place : places) {
      EXPECT_TRUE(space.free(place));
      EXPECT_TRUE(space.sees(place, {-1.0, 0.0, 0.3}, 0.5));
      EXPECT_GE(place.z(), 12.0);
    }
    for (const Vector3d& other : best) EXPECT_GT((places.front() - other).norm(), 2.9);
    best.push_back(places.front());
  }
}

TEST(DeliveryPlaces, LieAboveAStationOnARoof) {
  const std::vector<OrientedBox> boxes = {tower()};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  AgentConfig agent = fleet_of(3, 1);
  for (const double station_m : {0.3, 8.0, 41.0, 60.0}) {
    agent.station_position = {10.0, 0.0, station_m};
    if (station_m < 40.0) agent.station_position = {-4.0, 0.0, station_m};  // beside the tower, not in it
    const auto places = delivery_places(agent, space, 12.0);
    ASSERT_FALSE(places.empty()) << station_m;
    for (const Vector3d& place : places) EXPECT_GT(place.z(), station_m + 1.0);
  }
}

TEST(DeliveryPlaces, AvoidWhatTheMapShows) {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> roof;  // over the station
  for (float x = -9.0F; x <= 7.0F; x += 0.4F) {
    for (float y = -8.0F; y <= 8.0F; y += 0.4F) roof.emplace_back(x, y, 6.0F);
  }
  map.insert(roof, std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  for (const Vector3d& place : delivery_places(fleet_of(1, 0), space, 12.0)) {
    EXPECT_GT((place - Vector3d(-1.0, 0.0, 0.3)).head<2>().norm(), 8.0);
  }
}

TEST(TimeHome, GrowsWithDistanceAndLeavesTimeToSpare) {
  EXPECT_GT(time_home_s({0, 0, 0}, {45, 0, 0}, 4.5), 10.0);
  EXPECT_GT(time_home_s({0, 0, 0}, {90, 0, 0}, 4.5), time_home_s({0, 0, 0}, {45, 0, 0}, 4.5));
}

/// A UAV far from the station that has a link as long as it is told so.
class FarOut : public testing::Test {
 protected:
  FarOut() { boxes_ = {tower()}; }

  PlannerInput input(const Vector3d& p_WB, bool linked, double remaining_s, std::size_t undelivered = 3) {
    state_.p_WB = p_WB;
    TrackingState tracking;
    tracking.setpoint.p_WB = p_WB;
    tick_ += ticks(0.05);
    return {.tick = tick_,
            .state = state_,
            .gimbal = {},
            .tracking = tracking,
            .map = map_,
            .boxes = boxes_,
            .peers = peers_,
            .mission_remaining_s = remaining_s,
            .station_linked = linked,
            .undelivered_captures = undelivered,
            .detected = {},
            .radio = {}};
  }
  /// Flies on for some seconds.
  void fly(const Vector3d& from_W, const Vector3d& v_W, double time_s, bool linked) {
    for (double t = 0.0; t < time_s; t += 0.05) delivery_.update(input(from_W + t * v_W, linked, 500.0), 40.0);
  }

  AgentConfig agent_ = fleet_of(1, 0);
  Pilot pilot_{{}, agent_};
  Delivery delivery_{{.margin_s = 10.0, .speed_mps = 4.0}, agent_, pilot_};
  OccupancyMap map_;
  std::vector<OrientedBox> boxes_;
  Peers peers_{agent_};
  RigidBodyState state_;
  Tick tick_ = 0;
};

TEST_F(FarOut, LeavesInTimeForThePlaceWhereItLastHadALink) {
  fly({100.0, 0.0, 20.0}, {0.0, 0.0, 0.0}, 1.0, false);
  EXPECT_TRUE(delivery_.due(input({100.0, 0.0, 20.0}, false, 40.0))) << "home is 40 s away";
  fly({90.0, 0.0, 20.0}, {0.0, 4.0, 0.0}, 5.0, true);
  fly({90.0, 20.0, 20.0}, {4.0, 0.0, 0.0}, 2.0, false);
  EXPECT_FALSE(delivery_.due(input({98.0, 20.0, 20.0}, false, 40.0))) << "that place is 3 s away";
  EXPECT_TRUE(delivery_.due(input({98.0, 20.0, 20.0}, false, 15.0)));
}

TEST_F(FarOut, WorksOnToTheEndWhereEverythingIsDeliveredAtOnce) {
  const Vector3d p(100.0, 0.0, 20.0);
  const auto update = [&](bool linked, double left_s, std::size_t undelivered) {
    const PlannerInput in = input(p, linked, left_s, undelivered);
    delivery_.update(in, 40.0);
    return delivery_.due(in);
  };
  // Each capture is under way for some exchanges.
  for (double left_s = 60.0; left_s > 0.0; left_s -= 0.05) {
    const auto undelivered = static_cast<std::size_t>(left_s / 0.05) % 10 < 4 ? 2U : 0U;
    ASSERT_FALSE(update(true, left_s, undelivered)) << left_s;
  }
  // A moment without a link is none, unless something waits for it.
  for (double left_s = 8.0; left_s > 7.3; left_s -= 0.05) ASSERT_FALSE(update(false, left_s, 0)) << left_s;
  EXPECT_TRUE(update(false, 7.2, 1));
  for (double left_s = 7.2; left_s > 6.5; left_s -= 0.05) update(false, left_s, 0);
  EXPECT_TRUE(update(false, 6.5, 0)) << "nothing more can be delivered from here";
  // On a poor link captures wait, and still arrive.
  for (double left_s = 60.0; left_s > 0.0; left_s -= 0.05) {
    const auto waiting = static_cast<std::size_t>(40.0 - left_s / 2.0) + static_cast<std::size_t>(left_s * 2.0) % 2;
    ASSERT_FALSE(update(true, left_s, waiting)) << left_s;
  }
  // A link over which nothing gets through is none.
  update(true, 9.0, 0);
  for (double t = 0.0; t < 4.8; t += 0.05) ASSERT_FALSE(update(true, 9.0, 1)) << t;
  for (double t = 0.0; t < 0.4; t += 0.05) update(true, 9.0, 1);
  EXPECT_TRUE(update(true, 9.0, 1));
}

TEST_F(FarOut, LeavesSoonerIfItHasNeverHadALink) {
  for (const double away_m : {40.0, 75.0, 110.0}) {
    const Vector3d here_W(-1.0 - away_m, 0.0, 20.0);
    const auto least_left_s = [&](bool had_link) {
      Delivery delivery({.margin_s = 10.0, .speed_mps = 4.0}, agent_, pilot_);
      for (int i = 0; i < 100; ++i) delivery.update(input({-1.0, 0.0, 20.0}, had_link, 500.0), 40.0);
      double left_s = 500.0;
      while (!delivery.due(input(here_W, false, left_s))) left_s -= 1.0;
      return left_s;
    };
    const double known_s = least_left_s(true);
    EXPECT_GT(least_left_s(false), 1.4 * known_s) << "it does not know yet from where the station is seen";
    EXPECT_GT(known_s, away_m / 4.0);
  }
}

TEST_F(FarOut, GoesToThatPlaceAndNotToWhereTheLinkBroke) {
  fly({90.0, 0.0, 20.0}, {0.0, 4.0, 0.0}, 5.0, true);
  fly({90.0, 20.0, 20.0}, {4.0, 0.0, 0.0}, 2.0, false);
  PlannerOutput out;
  delivery_.begin(input({98.0, 20.0, 20.0}, false, 15.0), {}, 12.0, out);
  const Path* path = std::get_if<Path>(&out.motion);
  ASSERT_NE(path, nullptr);
  const Vector3d goal = path->waypoints.back().p_WB;
  EXPECT_NEAR(goal.x(), 90.0, 1e-9);
  EXPECT_LE(goal.y(), 16.0) << "a second before the link ended";
  EXPECT_GE(goal.y(), 8.0);
}

TEST_F(FarOut, AGlimpseOfTheStationIsNoPlaceToDeliver) {
  fly({90.0, 0.0, 20.0}, {0.0, 4.0, 0.0}, 0.5, true);
  EXPECT_TRUE(delivery_.due(input({90.0, 2.0, 20.0}, false, 30.0)));
}

TEST_F(FarOut, GoesHomeWhereThatIsNearerThanThePlaceOfTheLastLink) {
  fly({90.0, 0.0, 20.0}, {0.0, 4.0, 0.0}, 5.0, true);
  const Vector3d near_home(-25.0, 10.0, 20.0);
  fly(near_home, Vector3d::Zero(), 1.0, false);
  PlannerOutput out;
  delivery_.begin(input(near_home, false, 15.0), {}, 12.0, out);
  const Path* path = std::get_if<Path>(&out.motion);
  ASSERT_NE(path, nullptr);
  EXPECT_LT((path->waypoints.back().p_WB - agent_.station_position).head<2>().norm(), 33.0);
}

TEST_F(FarOut, LeavesWhenSomethingHasBeenUndeliveredForLong) {
  const Vector3d p(20.0, 30.0, 20.0);
  const auto wait = [&](double time_s, std::size_t undelivered) {
    for (double t = 0.0; t < time_s; t += 0.05) delivery_.update(input(p, false, 9e3, undelivered), 40.0);
  };
  wait(300.0, 0);
  EXPECT_FALSE(delivery_.due(input(p, false, 9e3, 1))) << "for so long there was nothing to deliver";
  wait(239.5, 1);
  EXPECT_FALSE(delivery_.due(input(p, false, 9e3, 1)));
  wait(1.0, 1);
  EXPECT_TRUE(delivery_.due(input(p, false, 9e3, 1)));
  EXPECT_FALSE(delivery_.due(input(p, false, 9e3, 0)));
}

TEST_F(FarOut, IsNeverDueBeforeTheFirstTakeOff) {
  const Vector3d p(20.0, 30.0, 20.0);
  EXPECT_FALSE(delivery_.due(input(p, false, 1.0))) << "it was told nothing yet";
  delivery_.update(input(p, false, 500.0), 40.0);
  EXPECT_TRUE(delivery_.due(input(p, false, 1.0)));
  PlannerInput on_the_ground = input(p, false, 1.0);
  on_the_ground.mission_remaining_s.reset();
  EXPECT_FALSE(delivery_.due(on_the_ground));
}

TEST_F(FarOut, RetreatsAtEveryThirdTimeThatNoWayWasFound) {
  for (double y = 30.0; y < 60.0; y += 0.5) {  // the way it came
    PlannerOutput out;
    pilot_.look_out(input({-30.0, y, 20.0}, false, 500.0), {}, true, out);
  }
  const FreeSpace::Config nowhere{.floor_m = 1e3};
  PlannerOutput out;
  delivery_.begin(input({-30.0, 60.0, 20.0}, false, 500.0), nowhere, 12.0, out);
  int steps = 0;
  for (; !std::holds_alternative<Path>(out.motion) && steps < 200; ++steps) {
    out = {};
    delivery_.step(input({-30.0, 60.0, 20.0}, false, 500.0), nowhere, out);
  }
  EXPECT_NEAR(0.05 * steps, 2.0, 0.051) << "the first try was at once, the others a second apart";
  EXPECT_LT(std::get<Path>(out.motion).waypoints.back().p_WB.y(), 52.0);
}

/// A UAV that is on its trip, or at the end of it.
class AtThePlace : public FarOut {
 protected:
  AtThePlace() {
    PlannerOutput out;
    delivery_.update(input({-30.0, 20.0, 20.0}, false, 500.0), 40.0);
    delivery_.begin(input({-30.0, 20.0, 20.0}, false, 500.0), {}, 12.0, out);
    place_ = goal_of(out);
  }
  static Vector3d goal_of(const PlannerOutput& out) {
    const Path* path = std::get_if<Path>(&out.motion);
    return path != nullptr ? path->waypoints.back().p_WB : Vector3d::Zero().eval();
  }
  bool step(bool linked, std::size_t undelivered, double remaining_s, PlannerOutput& out) {
    return delivery_.step(input(place_, linked, remaining_s, undelivered), {}, out);
  }
  Vector3d place_;
};

TEST_F(AtThePlace, WorkGoesOnOnlyWhenAllIsDeliveredAndThereIsTimeToComeBack) {
  PlannerOutput out;
  EXPECT_FALSE(step(false, 0, 500.0, out)) << "without a link nobody knows";
  EXPECT_FALSE(step(true, 1, 500.0, out));
  EXPECT_TRUE(step(true, 0, 500.0, out));
  // The way home takes six seconds, more where there was no link before, and ten are to be spare: twice that must be
  // left.
  EXPECT_TRUE(step(true, 0, 41.0, out));
  EXPECT_FALSE(step(true, 0, 40.0, out));
  for (int i = 0; i < 100; ++i) delivery_.update(input(place_, true, 500.0), 40.0);
  EXPECT_TRUE(step(true, 0, 33.0, out));
  EXPECT_FALSE(step(true, 0, 31.0, out));
}

TEST_F(AtThePlace, StaysForAsLongAsItHasALinkAndSomethingToDeliver) {
  for (const std::size_t undelivered : {2, 0}) {  // none: the last time, for what may still come
    PlannerOutput out;
    for (int i = 0; i < 400; ++i) ASSERT_FALSE(step(true, undelivered, 25.0, out));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(out.motion)) << undelivered;
  }
}

TEST_F(AtThePlace, WithoutALinkItTriesOnePlaceAfterTheOtherAndThenHighAboveAll) {
  const std::vector<Vector3d> expected = delivery_places(agent_, FreeSpace({}, boxes_, map_), 12.0);
  ASSERT_GT(expected.size(), 3U);
  std::vector<Vector3d> tried = {place_};
  while (tried.size() < expected.size() + 2) {
    int steps = 0;
    PlannerOutput out;
    while (!std::holds_alternative<Path>(out.motion) && ++steps < 200) {
      out = {};
      ASSERT_FALSE(step(false, 1, 500.0, out));
    }
    ASSERT_NEAR(0.05 * steps, 4.0, 0.2) << "so long it waits for a link";
    place_ = goal_of(out);
    tried.push_back(place_);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(tried[i], expected[i]) << i;
  const Vector3d& high = tried[expected.size()];
  EXPECT_EQ(high.head<2>(), agent_.station_position.head<2>());
  EXPECT_GT(high.z(), 40.0) << "the top of all structure";
  EXPECT_EQ(tried.back(), expected.front()) << "and from the beginning again";
}

TEST_F(AtThePlace, AMomentsLinkBeginsTheWaitAnew) {
  PlannerOutput out;
  for (int i = 0; i < 200; ++i) {
    ASSERT_FALSE(step(i % 60 == 59, 1, 500.0, out));
    ASSERT_FALSE(std::holds_alternative<Path>(out.motion)) << "after " << 0.05 * i << " s";
  }
}

TEST_F(AtThePlace, TriesElsewhereOrAgainAfterASecond) {
  for (const bool elsewhere : {true, false}) {
    PlannerOutput out;
    const PlannerInput in = input(place_, false, 500.0);
    pilot_.stop(out);  // somebody else stopped it on its way
    elsewhere ? delivery_.try_elsewhere(in) : delivery_.try_again(in);
    int steps = 0;
    while (!std::holds_alternative<Path>(out.motion) && ++steps < 100) {
      out = {};
      delivery_.step(input({-30.0, 20.0, 20.0}, false, 500.0), {}, out);
    }
    EXPECT_NEAR(0.05 * steps, 1.0, 0.051);
    EXPECT_EQ((goal_of(out) - place_).norm() > 1.0, elsewhere);
    place_ = goal_of(out);
  }
}

TEST(SurveyRing, ExplorersShareTheWholeRingAtADistance) {
  for (const double yaw : {0.0, 0.4, 1.2}) {
    const std::vector<OrientedBox> boxes = {tower(yaw)};
    double angle = 0.0;
    for (std::size_t self = 0; self < 2; ++self) {
      const auto share = survey_ring(fleet_of(2, self), boxes, 10.0, 25.0);
      ASSERT_GT(share.size(), 4U);
      for (std::size_t i = 0; i < share.size(); ++i) {
        EXPECT_FALSE(boxes[0].contains(share[i], 9.9));
        EXPECT_TRUE(boxes[0].contains(share[i], 10.1));
        if (i == 0) continue;
        const Vector3d a = share[i - 1] - boxes[0].center, b = share[i] - boxes[0].center;
        angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
      }
    }
    EXPECT_NEAR(std::abs(angle), 2.0 * M_PI, 1e-6) << "together once around";
  }
}

TEST(SurveyRing, IsNothingForAPhotographerOrWithoutBoxes) {
  AgentConfig config = fleet_of(1, 0);
  EXPECT_TRUE(survey_ring(config, {}, 10.0, 25.0).empty());
  config.fleet[0].role = Role::photographer;
  EXPECT_TRUE(survey_ring(config, {tower()}, 10.0, 25.0).empty());
}

}  // namespace
}  // namespace skein::agent
