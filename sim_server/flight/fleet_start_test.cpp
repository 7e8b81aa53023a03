#include "sim_server/flight/fleet_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/scenario/scenario_reader.hpp"
#include "core/vehicle/airframe.hpp"
#include "scenes/enclosure.hpp"
#include "sim_server/flight/physics_world.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

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

VehicleConfig shipped(const std::string& name) { return load_vehicle(name, source_path("config")); }

TEST(FleetStart, UavsAtTheLeastStartDistanceDoNotTouch) {
  RandomStream random(1, "pairs", 0);
  for (int i = 0; i < 200; ++i) {
    const VehicleConfig a = shipped(i % 2 == 0 ? "explorer" : "photographer");
    const VehicleConfig b = shipped(i % 3 == 0 ? "explorer" : "photographer");
    const auto meet = [&](double distance) {
      PhysicsWorld world({});
      const double way = random.uniform(-3.0, 3.0);
      const auto add = [&](const VehicleConfig& vehicle, double x, double y) {
        world.add_uav(vehicle, Eigen::Translation3d(x, y, rest_height(vehicle)) *
                                   Quaterniond(Eigen::AngleAxisd(random.uniform(-3.0, 3.0), Vector3d::UnitZ())));
      };
      add(a, 0.0, 0.0);
      add(b, distance * std::cos(way), distance * std::sin(way));
      for (int tick = 0; tick < 10; ++tick) world.tick();
      return std::ranges::any_of(world.contacts(), [](const Contact& c) { return c.other.kind == BodyId::Kind::uav; });
    };
    EXPECT_FALSE(meet(least_start_distance(a, b)));
    if (a.name != b.name) continue;  // the rotors of different vehicles are at different heights
    EXPECT_TRUE(meet(0.25 * least_start_distance(a, b)));
  }
}

TEST(FleetStart, DrawnStartsKeepTheLeastDistanceIfTheScenarioKeepsIt) {
  RandomStream random(2, "crowds", 0);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Scenario scenario;
    while (scenario.fleet.size() < 8) {
      UavConfig uav;
      uav.name = "uav" + std::to_string(scenario.fleet.size());
      uav.vehicle = shipped(scenario.fleet.size() % 2 == 0 ? "explorer" : "photographer");
      uav.start = {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)};
      const bool legal = std::ranges::all_of(scenario.fleet, [&](const UavConfig& other) {
        return (other.start - uav.start).norm() >= least_start_distance(other.vehicle, uav.vehicle);
      });
      if (legal) scenario.fleet.push_back(uav);
    }
    const auto starts = draw_fleet_start(scenario, seed, open_field, in_the_open);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3d apart = starts[i].X_WB.translation() - starts[j].X_WB.translation();
        EXPECT_GE(apart.head<2>().norm(),
                  least_start_distance(scenario.fleet[i].vehicle, scenario.fleet[j].vehicle) - 1e-12);
      }
    }
  }
}

TEST(FleetStart, AStationWithoutAWayOutIsAnInputError) {
  // A closed block with a hall in it, 1 m of wall around; places drawn on both sides of the walls.
  TriangleMesh mesh;
  test::add_box(mesh, {10, 0, 4}, {12, 12, 10});
  test::add_box(mesh, {10, 0, 4}, {10, 10, 8});
  const RayScene rays(mesh);
  const auto enclosed = [&](const Vector3d& p_W) { return is_enclosed(rays, p_W); };
  Scenario scenario;
  scenario.file = "field.yaml";
  RandomStream random(3, "stations", 0);
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    scenario.station_position = test::random_in_box(random, {2, -8, 0}, {18, 8, 12});
    if (i % 4 == 0) scenario.station_position.z() = 0.0;
    const Vector3d off = scenario.station_position - Vector3d(10, 0, 0);
    if (off.head<2>().cwiseAbs().maxCoeff() < 6.0 && off.z() < 9.0) {
      ++inside;
      try {
        check_station(scenario, enclosed);
        ADD_FAILURE() << scenario.station_position.transpose();
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("field.yaml: station.position: ("), std::string::npos) << error.what();
      }
    } else {
      EXPECT_NO_THROW(check_station(scenario, enclosed)) << scenario.station_position.transpose();
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 150);
}

TEST(FleetStart, OneUavsDrawDoesNotDependOnTheOthers) {
  Scenario scenario = two_close_and_one_apart();
  const auto all = draw_fleet_start(scenario, 3, open_field, in_the_open);
  scenario.fleet[0].start.x() -= 10.0;
  const auto moved = draw_fleet_start(scenario, 3, open_field, in_the_open);
  EXPECT_TRUE(all[2].X_WB.isApprox(moved[2].X_WB));
  EXPECT_EQ(all[1].motor_delay, moved[1].motor_delay);
}

TEST(FleetStart, AFleetThatIsTooCrowdedForDrawsStartsAtItsNominalPlaces) {
  Scenario scenario = two_close_and_one_apart();
  scenario.fleet[1].start.x() = 0.8;  // no draw can part the circles of their rotors
  EXPECT_EQ(draw_fleet_start(scenario, 5, open_field, in_the_open)[1].X_WB.translation().head<2>(), Vector2d(0.8, 0.0));
}

TEST(FleetStart, AStartInTheStructureIsAnInputError) {
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

TEST(FleetStart, AStartWithoutAWayOutIsAnInputError) {
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
