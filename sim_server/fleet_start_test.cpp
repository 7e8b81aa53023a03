#include "sim_server/fleet_start.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sim_server/physics_world.hpp"

namespace skein::sim {
namespace {

bool open_field(const VehicleConfig&, const Isometry3d&) { return false; }

bool in_the_open(const Vector3d&) { return false; }

Scenario two_close_and_one_apart() {
  Scenario scenario;
  scenario.file = "field.yaml";
  for (const Vector2d& start : {Vector2d(0, 0), Vector2d(1.4, 0), Vector2d(20, 5)}) {
    UavConfig uav;
    uav.name = "uav" + std::to_string(scenario.fleet.size());
    uav.start = start;
    uav.start_yaw = 0.5;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

TEST(FleetStart, SeedZeroIsTheNominalRun) {
  const Scenario scenario = two_close_and_one_apart();
  const auto starts = draw_fleet_start(scenario, 0, open_field, in_the_open);
  ASSERT_EQ(starts.size(), scenario.fleet.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Vector2d& nominal = scenario.fleet[i].start;
    EXPECT_EQ(starts[i].motor_delay, 0);
    EXPECT_FALSE(starts[i].late_commands);
    EXPECT_EQ(starts[i].X_WB.translation(), Vector3d(nominal.x(), nominal.y(), rest_height(scenario.fleet[i].vehicle)));
    EXPECT_NEAR(Quaterniond(starts[i].X_WB.linear()).angularDistance(Quaterniond::Identity()), 0.5, 1e-12);
  }
}

TEST(FleetStart, DrawsStayInBoundsAndNeverOverlap) {
  const Scenario scenario = two_close_and_one_apart();
  std::set<Tick> delays;
  std::size_t late = 0;
  double farthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto starts = draw_fleet_start(scenario, seed, open_field, in_the_open);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Vector3d p = starts[i].X_WB.translation();
      const double offset = (p.head<2>() - scenario.fleet[i].start).norm();
      EXPECT_LE(offset, 0.2);
      farthest = std::max(farthest, offset);
      EXPECT_GE(starts[i].motor_delay, 0);
      EXPECT_LE(starts[i].motor_delay, kTicksPerSecond);
      delays.insert(starts[i].motor_delay);
      late += starts[i].late_commands;
      for (std::size_t j = 0; j < i; ++j) {
        const double gap = (starts[j].X_WB.translation() - p).norm();
        EXPECT_GT(gap, 2.0 * body_radius(scenario.fleet[i].vehicle));
      }
    }
  }
  EXPECT_GT(farthest, 0.19);
  EXPECT_GT(delays.size(), 200U);
  EXPECT_NEAR(static_cast<double>(late), 300.0, 60.0);
}

TEST(FleetStart, OneUavsDrawDoesNotDependOnTheOthers) {
  Scenario scenario = two_close_and_one_apart();
  const auto all = draw_fleet_start(scenario, 3, open_field, in_the_open);
  scenario.fleet[0].start.x() -= 10.0;
  const auto moved = draw_fleet_start(scenario, 3, open_field, in_the_open);
  EXPECT_TRUE(all[2].X_WB.isApprox(moved[2].X_WB));
  EXPECT_EQ(all[1].motor_delay, moved[1].motor_delay);
}

TEST(FleetStart, TooCrowdedMeansNominal) {
  Scenario scenario = two_close_and_one_apart();
  scenario.fleet[1].start.x() = 0.8;  // no draw can part the circles of their rotors
  EXPECT_EQ(draw_fleet_start(scenario, 5, open_field, in_the_open)[1].X_WB.translation().head<2>(), Vector2d(0.8, 0.0));
}

TEST(FleetStart, AStartInTheStructureIsTheUsersMistake) {
  const Scenario scenario = two_close_and_one_apart();
  const auto touches = [](const VehicleConfig&, const Isometry3d& X_WB) { return X_WB.translation().x() > 10.0; };
  try {
    draw_fleet_start(scenario, 0, touches, in_the_open);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("field.yaml: the start of uav2 at (20, 5) lies in the structure"),
              std::string::npos)
        << error.what();
  }
}

TEST(FleetStart, SoIsAStartWithoutAWayOut) {
  const Scenario scenario = two_close_and_one_apart();
  const auto enclosed = [](const Vector3d& p_WB) { return p_WB.x() > 10.0 && p_WB.z() > 0.0; };
  try {
    draw_fleet_start(scenario, 0, open_field, enclosed);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("field.yaml: the start of uav2 at (20, 5) is enclosed by the structure"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace skein::sim
