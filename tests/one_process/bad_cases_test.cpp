// The default planner with unusual fleets, scenes, boxes and stations, dead sensors, restarts and partitions. No UAV
// collides, or flies too fast to stop before an obstacle; none deviates from its setpoint by more than the flight core
// assumes; and the fleet leaves its starts.
#include <functional>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::test {
namespace {

constexpr double kLeastWay_m = 3.0;  ///< least mean distance of a fleet's UAVs; a UAV that only takes off flies less

struct BadCase {
  std::string name;
  std::function<void(SmallScene&)> change = [](SmallScene&) {};  ///< of default_scene()
  std::string faults = {};                                       ///< lines of a fault file
  Arguments world = {};                                          ///< flown in place of a small scene
};

std::string explorer(const std::string& name, int x, int y) {
  return "  - {name: " + name + ", vehicle: explorer, start: [" + std::to_string(x) + ", " + std::to_string(y) + "]}\n";
}
std::string photographer(const std::string& name, int x, int y) {
  return "  - {name: " + name + ", vehicle: photographer, start: [" + std::to_string(x) + ", " + std::to_string(y) +
         "]}\n";
}

void eight_explorers(SmallScene& scene) {
  scene.fleet.clear();
  for (int i = 0; i < 8; ++i) scene.fleet += explorer("uav" + std::to_string(i), 4 * (i % 4) - 10, 8 * (i / 4) - 4);
}

/// Bars of 5 cm in place of the block, a metre apart.
void lattice(SmallScene& scene) {
  scene.blocks.clear();
  for (int i = 0; i <= 10; ++i) {
    scene.blocks.push_back({{20.0, -5.0 + i, 6.0}, {0.05, 0.05, 12.0}});
    scene.blocks.push_back({{20.0, 0.0, 1.0 + i}, {0.05, 10.0, 0.05}});
  }
  scene.boxes = {{{20.0, 0.0, 6.0}, {2.0, 10.0, 12.0}}};
  scene.points.clear();
  for (int i = 0; i < 40; ++i) {
    scene.points.push_back({19.975, -4.0 + 3.0 * (i % 4) - (i % 4 > 2 ? 1.0 : 0.0), 2.0 + 0.9 * (i / 4), -1, 0, 0});
  }
}

const std::vector<BadCase>& bad_cases() {
  static const std::vector<BadCase> cases = {
      {"one_uav", [](SmallScene& scene) { scene.fleet = explorer("jurong", 0, 5); }},
      {"eight_explorers", eight_explorers},
      {"photographers_alone_and_far_off",
       [](SmallScene& scene) { scene.fleet = photographer("sentosa", -60, -6) + photographer("changi", -60, 0); }},
      {"a_photographer_far_off",
       [](SmallScene& scene) { scene.fleet = explorer("jurong", 0, 5) + photographer("changi", -60, -5); }},
      {"a_mission_of_120_s", [](SmallScene& scene) { scene.duration_s = 120.0; }},
      {"fine_resolution", [](SmallScene& scene) { scene.desired_mm_per_pixel = 0.8; }},
      {"coarse_resolution", [](SmallScene& scene) { scene.desired_mm_per_pixel = 3.0; }},
      {"one_box_around_all_and_over_the_starts",
       [](SmallScene& scene) {
         scene.boxes = {{{18.0, 0.0, 8.0}, {50.0, 30.0, 16.0}}};
       }},
      {"an_empty_box",
       [](SmallScene& scene) {
         scene.boxes.push_back({{0.0, 30.0, 6.0}, {10.0, 10.0, 12.0}});
       }},
      {"a_lattice_of_5_cm", lattice},
      {"the_station_on_a_roof",
       [](SmallScene& scene) {
         scene.station = {30.0, 0.0, 12.3};
       }},
      {"the_station_hidden",
       [](SmallScene& scene) {
         scene.station = {60.0, 0.0, 0.3};
       }},
      {"dead_cameras", {}, "  - {at_s: 4, camera_failure: jurong}\n  - {at_s: 4, camera_failure: changi}\n"},
      {"stuck_gimbals", {}, "  - {at_s: 4, stuck_gimbal: jurong}\n  - {at_s: 4, stuck_gimbal: changi}\n"},
      {"a_blind_explorer", {}, "  - {at_s: 13, lidar_failure: jurong}\n"},
      {"restarts_in_flight",
       {},
       "  - {at_s: 12, until_s: 13.5, kill: jurong}\n  - {at_s: 18, until_s: 19, kill: changi}\n"},
      {"a_partition", {}, "  - {at_s: 10, until_s: 18, partition: [[gcs, jurong], [changi]]}\n"},
      {"a_generated_world_without_a_lidar", {}, {}, {"wild_blind", "--scene-seed", "3"}}};
  return cases;
}

class BadCases : public FleetTest, public testing::WithParamInterface<BadCase> {};

/// Expects that at each speed of the setpoint, 99.99 % of the tracking errors of a short flight are within the bound of
/// FlightConfig (error_m, error_per_mps_s). Uses the bound of explorers, which is the greater one, for all UAVs. The
/// report counts errors in steps of 1 cm.
void expect_small_tracking_errors(const Json& result) {
  constexpr double kRounded_m = 0.01;
  const agent::FlightConfig flight;
  EXPECT_FALSE(result["flight_check"]["tracking_by_speed"].empty());
  for (const Json& speeds : result["flight_check"]["tracking_by_speed"]) {
    const double most_mps = speeds["from_mps"].get<double>() + 1.0;
    EXPECT_LE(speeds["p9999"].get<double>(), flight.error_m + flight.error_per_mps_s * most_mps + kRounded_m) << speeds;
  }
}

TEST_P(BadCases, AreFlownSafely) {
  const BadCase& bad = GetParam();
  SmallScene scene = default_scene();
  if (bad.change) bad.change(scene);
  Arguments flight = bad.world;
  if (flight.empty()) flight = {write_small_scene(folder() / "scene", scene)};
  flight.insert(flight.end(), {"--planner", "flock", "--stop-at", "20", "--one-process", "--no-oracle", "--no-report",
                               "--record=none"});
  if (!bad.faults.empty()) {
    flight.insert(flight.end(), {"--faults", write("faults.yaml", "faults:\n" + bad.faults)});
  }
  const Json result = run("flight", flight).result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["collisions"].empty()) << result["collisions"];
  const Json& check = result["flight_check"];
  EXPECT_EQ(check["braking_hits"], 0) << check;
  EXPECT_EQ(check["braking_meets"], 0) << check;
  if (bad.faults.empty()) expect_small_tracking_errors(result);
  double way_m = 0.0;
  for (const Json& uav : result["uavs"]) {
    EXPECT_TRUE(uav["alive"]) << uav["name"];
    EXPECT_FALSE(uav["program_lost"]) << uav["name"];
    way_m += uav["distance_m"].get<double>();
  }
  EXPECT_GT(way_m / static_cast<double>(result["uavs"].size()), kLeastWay_m);
}

INSTANTIATE_TEST_SUITE_P(Each, BadCases, testing::ValuesIn(bad_cases()),
                         [](const auto& bad) { return bad.param.name; });

}  // namespace
}  // namespace skein::test
