#include "sim_server/mission.hpp"

#include <gtest/gtest.h>

namespace skein::sim {
namespace {

constexpr double kRest = 0.16;
const BodyId kGround{BodyId::Kind::ground, UavIndex{0}}, kStructure{BodyId::Kind::structure, UavIndex{0}};

RigidBodyState at(double z, double speed) { return {.p_WB = {0, 0, z}, .v_WB = {0, 0, speed}}; }
RigidBodyState resting() { return at(kRest, 0.0); }
RigidBodyState flying() { return at(10.0, 1.0); }

class MissionTest : public testing::Test {
 protected:
  MissionTest() {
    scenario_.duration_s = 10.0;
    scenario_.takeoff_timeout_s = 5.0;
  }
  Mission mission(std::size_t fleet) { return Mission(scenario_, std::vector<double>(fleet, kRest)); }

  Scenario scenario_;
};

TEST_F(MissionTest, TheClockStartsAtTheFirstTakeoff) {
  Mission m = mission(2);
  m.update(1, {resting(), resting()}, {});
  m.update(2, {resting(), at(kRest + 0.2, 0.05)}, {});  // high, but slow
  m.update(3, {resting(), at(kRest + 0.05, 1.0)}, {});  // fast, but low
  EXPECT_EQ(m.phase(), Phase::waiting);
  EXPECT_DOUBLE_EQ(m.remaining_s(3), 10.0);
  m.update(4, {resting(), at(kRest + 0.11, 0.11)}, {});
  EXPECT_EQ(m.phase(), Phase::flying);
  EXPECT_EQ(m.start_tick(), 4);
  EXPECT_TRUE(m.airborne(UavIndex{1}));
  EXPECT_FALSE(m.airborne(UavIndex{0}));
  EXPECT_DOUBLE_EQ(m.remaining_s(4 + 400), 9.0);
}

TEST_F(MissionTest, AMissionEndsAfterItsDurationAndStaysEnded) {
  Mission m = mission(1);
  m.update(100, {flying()}, {});
  m.update(100 + 3999, {flying()}, {});
  EXPECT_EQ(m.phase(), Phase::flying);
  m.update(100 + 4000, {flying()}, {});
  EXPECT_EQ(m.phase(), Phase::ended);
  EXPECT_EQ(m.end(), MissionEnd::duration);
  EXPECT_EQ(m.end_tick(), 4100);
  EXPECT_EQ(m.remaining_s(4100), 0.0);
  EXPECT_TRUE(m.update(4101, {flying()}, {{UavIndex{0}, kStructure, Vector3d::Zero()}}).empty());
  EXPECT_TRUE(m.alive(UavIndex{0}));
}

TEST_F(MissionTest, AMissionEndsWhenNoUavTakesOffInTime) {
  Mission m = mission(1);
  m.update(1999, {resting()}, {});
  EXPECT_EQ(m.phase(), Phase::waiting);
  m.update(2000, {resting()}, {});
  EXPECT_EQ(m.end(), MissionEnd::takeoff_timeout);
  EXPECT_FALSE(m.start_tick().has_value());
}

TEST_F(MissionTest, AMissionEndsWhenEachUavIsDeadOrHasLanded) {
  Mission m = mission(3);
  m.update(1, {flying(), flying(), resting()}, {});
  m.update(2, {flying(), resting(), resting()}, {});  // 1 landed; 2 never flew
  EXPECT_EQ(m.phase(), Phase::flying);
  m.update(3, {flying(), resting(), resting()}, {{UavIndex{0}, kStructure, Vector3d::Zero()}});
  EXPECT_EQ(m.phase(), Phase::flying);  // 2 may still take off
  m.update(4, {flying(), resting(), flying()}, {});
  m.update(5, {flying(), resting(), resting()}, {});
  EXPECT_EQ(m.end(), MissionEnd::no_uav_flies);
}

TEST_F(MissionTest, AMissionGoesOnIfLandedUavsGetNewBatteries) {
  scenario_.conditions.battery.endurance_missions = 0.3;
  scenario_.conditions.battery.swap_s = 30.0;
  Mission m = mission(2);
  m.update(1, {flying(), flying()}, {});
  m.update(2, {resting(), resting()}, {});
  EXPECT_EQ(m.phase(), Phase::flying);
  EXPECT_TRUE(m.alive(UavIndex{0}));
  m.update(3, {flying(), resting()}, {});
  EXPECT_TRUE(m.airborne(UavIndex{0}));
  m.take_out(UavIndex{0});
  m.take_out(UavIndex{1});
  m.update(4, {resting(), resting()}, {});
  EXPECT_EQ(m.end(), MissionEnd::no_uav_flies);
}

TEST_F(MissionTest, AFallenUavHasLandedEvenIfItRestsOnARotorAboveItsRestHeight) {
  Mission m = mission(1);
  m.update(1, {flying()}, {});
  m.update(2, {at(kRest + 0.3, 0.01)}, {});  // slow and high: hovers
  EXPECT_TRUE(m.airborne(UavIndex{0}));
  m.update(3, {at(kRest + 0.3, 0.01)}, {{UavIndex{0}, kGround, Vector3d::Zero()}});
  EXPECT_FALSE(m.airborne(UavIndex{0}));
}

TEST_F(MissionTest, AContactKillsAnAirborneUavAndItsPlaceAndTimeAreReported) {
  Mission m = mission(2);
  m.update(1, {flying(), flying()}, {});
  const auto collisions = m.update(7, {flying(), flying()}, {{UavIndex{1}, kStructure, {3, 4, 5}}});
  ASSERT_EQ(collisions.size(), 1U);
  EXPECT_EQ(collisions[0].tick, 7);
  EXPECT_EQ(collisions[0].uav, 1U);
  EXPECT_EQ(collisions[0].with, kStructure);
  EXPECT_EQ(collisions[0].p_W, Vector3d(3, 4, 5));
  EXPECT_FALSE(m.alive(UavIndex{1}));
  EXPECT_TRUE(m.update(8, {flying(), flying()}, {{UavIndex{1}, kStructure, {3, 4, 5}}}).empty()) << "dies only once";
}

TEST_F(MissionTest, AUavSurvivesTheGroundAndARestingUavAlsoTheStructure) {
  Mission m = mission(2);
  m.update(1, {flying(), resting()},
           {{UavIndex{0}, kGround, Vector3d::Zero()},
            {UavIndex{1}, kGround, Vector3d::Zero()},
            {UavIndex{1}, kStructure, Vector3d::Zero()}});
  EXPECT_TRUE(m.alive(UavIndex{0}));
  EXPECT_TRUE(m.alive(UavIndex{1}));
}

TEST_F(MissionTest, EachOfAPairIsJudgedByItsOwnState) {
  const Contact pair{UavIndex{0}, {BodyId::Kind::uav, UavIndex{1}}, {1, 1, 1}};
  for (const auto& [first, second] : {std::pair{true, true}, {true, false}, {false, true}, {false, false}}) {
    Mission m = mission(3);
    const std::vector<RigidBodyState> states = {first ? flying() : resting(), second ? flying() : resting(), flying()};
    m.update(1, states, {});
    const auto collisions = m.update(2, states, {pair});
    EXPECT_EQ(m.alive(UavIndex{0}), !first);
    EXPECT_EQ(m.alive(UavIndex{1}), !second) << "a resting UAV that is touched survives";
    EXPECT_EQ(collisions.size(), static_cast<std::size_t>(first + second));
    EXPECT_TRUE(m.alive(UavIndex{2}));
  }
}

TEST_F(MissionTest, BothOfAPairDieEvenIfOneOfThemRestsWhereTheRulesSaySo) {
  scenario_.rules.collision_kills_both = true;
  Mission m = mission(3);
  m.update(1, {flying(), resting(), flying()}, {});
  const auto collisions =
      m.update(2, {flying(), resting(), flying()}, {{UavIndex{0}, {BodyId::Kind::uav, UavIndex{1}}, {1, 1, 1}}});
  ASSERT_EQ(collisions.size(), 2U);
  EXPECT_EQ(collisions[0].uav, 0U);
  EXPECT_EQ(collisions[0].with, (BodyId{BodyId::Kind::uav, UavIndex{1}}));
  EXPECT_EQ(collisions[1].uav, 1U);
  EXPECT_EQ(collisions[1].with, (BodyId{BodyId::Kind::uav, UavIndex{0}}));
  EXPECT_TRUE(m.alive(UavIndex{2}));
}

TEST_F(MissionTest, TheOrderOfContactsInATickDoesNotMatter) {
  // 0 hits the structure and 1 in the same tick: both die, whichever contact comes first.
  scenario_.rules.collision_kills_both = true;
  const Contact wall{UavIndex{0}, kStructure, Vector3d::Zero()},
      pair{UavIndex{0}, {BodyId::Kind::uav, UavIndex{1}}, Vector3d::Zero()};
  for (const auto& contacts : {std::vector<Contact>{wall, pair}, std::vector<Contact>{pair, wall}}) {
    Mission m = mission(2);
    m.update(1, {flying(), resting()}, {});
    m.update(2, {flying(), resting()}, contacts);
    EXPECT_FALSE(m.alive(UavIndex{0}));
    EXPECT_FALSE(m.alive(UavIndex{1}));
  }
}

}  // namespace
}  // namespace skein::sim
