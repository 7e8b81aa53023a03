#include "core/scenario/scenario_reader.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <stdlib.h>

#include <cmath>
#include <fstream>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "tests/support/places.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// A temporary folder with files.
class ScenarioReader : public ::testing::Test {
 protected:
  ScenarioReader() {
    std::string pattern = (fs::path(::testing::TempDir()) / "skein_scenario_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    ::unsetenv("SKEIN_ASSETS");
    options_.config_dir = source_path("config");
  }
  ~ScenarioReader() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string scenario(const std::string& scene, const std::string& more = {}) const {
    return write("s.yaml", "desired_mm_per_pixel: 2\nscene: " + scene + "\n" + more +
                               "fleet: [{name: jurong, vehicle: explorer, start: [0, 5], start_yaw_deg: 30},"
                               " {name: changi, vehicle: photographer, start: [0, 3]}]\n");
  }
  std::string complaint(const std::string& file) const {
    try {
      load_scenario(file, options_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_;
  LoadOptions options_;
};

TEST_F(ScenarioReader, FillsTheFleetFromItsVehicles) {
  const Scenario read = load_scenario(scenario("{family: towers}"), options_);
  EXPECT_EQ(read.name, "s");
  ASSERT_EQ(read.fleet.size(), 2u);
  EXPECT_EQ(read.fleet[0].vehicle.role, Role::explorer);
  EXPECT_TRUE(read.fleet[0].vehicle.lidar);
  EXPECT_NEAR(read.fleet[0].start_yaw, 30 * kRadPerDeg, 1e-15);
  EXPECT_EQ(read.fleet[1].vehicle.role, Role::photographer);
  EXPECT_FALSE(read.fleet[1].vehicle.lidar);
  EXPECT_EQ(read.fleet[1].vehicle.mass_kg, 1.5);
}

TEST_F(ScenarioReader, GivesTheNamesOfNodes) {
  const Scenario read = load_scenario(scenario("{family: towers}"), options_);
  EXPECT_EQ(read.node_name(kStationNode), "gcs");
  EXPECT_EQ(read.node_name(Node{2}), "changi");
  EXPECT_EQ(read.uav_index("changi"), 1u);
  EXPECT_THROW(read.uav_index("gcs"), InputError);
}

TEST_F(ScenarioReader, OverridesReplaceTheFilesValues) {
  options_.duration_s = 12.0;
  options_.scene_seed = 9;
  const Scenario read = load_scenario(scenario("{family: towers}"), options_);
  EXPECT_EQ(read.duration_s, 12.0);
  EXPECT_EQ(read.scene.scene_seed, 9u);
  options_.duration_s = -1.0;
  EXPECT_NE(complaint(scenario("{family: towers}")).find("--duration"), std::string::npos);
}

TEST_F(ScenarioReader, ASwitchOverridesItsPresetInAnyOrder) {
  const Scenario paper =
      load_scenario(scenario("{family: towers}", "rules: {collision_voids_score: false, preset: paper}\n"), options_);
  EXPECT_FALSE(paper.rules.unnormalised_displacement);
  EXPECT_FALSE(paper.rules.collision_voids_score);
  EXPECT_EQ(paper.rules.preset, "paper");
  const Scenario contest = load_scenario(scenario("{family: towers}"), options_);
  EXPECT_TRUE(contest.rules.unnormalised_displacement);
}

TEST_F(ScenarioReader, PresetsDifferAsTheirSourcesDo) {
  const RulesConfig contest = rules_preset("contest"), paper = rules_preset("paper");
  EXPECT_EQ(contest.min_point_score, 0.2);
  EXPECT_EQ(paper.min_point_score, 0.0) << "Eq. 1 has no least score";
  EXPECT_TRUE(contest.limit_search_radius);
  EXPECT_TRUE(contest.unnormalised_displacement);
  EXPECT_FALSE(paper.limit_search_radius);
  EXPECT_FALSE(paper.unnormalised_displacement);
  for (const RulesConfig& rules : {contest, paper}) {
    EXPECT_TRUE(rules.reject_commands_beyond_limits);
    EXPECT_TRUE(rules.guard_position_commands);
    EXPECT_TRUE(rules.collision_voids_score);
    EXPECT_FALSE(rules.phantom_gimbal_rate);
    EXPECT_FALSE(rules.ray_ends_at_point);
    EXPECT_TRUE(rules.camera_blind_in_structure);
    EXPECT_FALSE(rules.collision_kills_both);
  }
  for (const RulesConfig& rules : rules_presets()) {
    EXPECT_TRUE(rules.own_body_hides) << "a matter of physics, so it is in all presets";
    EXPECT_EQ(rules.takeoff_height_m, 0.1);
    EXPECT_EQ(rules.takeoff_speed_mps, 0.1);
  }
  const RulesConfig reference = rules_preset("reference");
  EXPECT_TRUE(reference.ray_ends_at_point && reference.phantom_gimbal_rate && reference.limit_search_radius &&
              reference.unnormalised_displacement);
  EXPECT_FALSE(reference.reject_commands_beyond_limits || reference.guard_position_commands ||
               reference.collision_voids_score || reference.camera_blind_in_structure);
  EXPECT_EQ(reference.min_point_score, 0.2);
}

TEST_F(ScenarioReader, AnOptionReplacesTheRulesOfTheFile) {
  options_.rules = "reference";
  const auto file = scenario("{family: towers}", "rules: {preset: paper, min_point_score: 0.3}\n");
  const RulesConfig rules = load_scenario(file, options_).rules;
  EXPECT_EQ(rules.preset, "reference");
  EXPECT_EQ(rules.min_point_score, 0.2);
  options_.rules = "referenze";
  const std::string message = complaint(file);
  for (const char* part : {"--rules", "'referenze'", "did you mean 'reference'?"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(ScenarioReader, OwnSwitchesAreThoseThatDifferFromThePreset) {
  for (const RulesConfig& preset : rules_presets()) EXPECT_TRUE(own_switches(preset).empty()) << preset.preset;
  const RulesConfig rules =
      load_scenario(scenario("{family: towers}",
                             "rules: {preset: paper, min_point_score: 0.3, limit_search_radius: false, "
                             "collision_voids_score: false}\n"),
                    options_)
          .rules;
  EXPECT_EQ(own_switches(rules), (std::vector<RuleSwitch>{{"collision_voids_score", false}, {"min_point_score", 0.3}}));
}

TEST_F(ScenarioReader, EveryRuleHasItsSwitch) {
  const Scenario read = load_scenario(
      scenario("{family: towers}",
               "rules: {reject_commands_beyond_limits: false, guard_position_commands: false, limit_search_radius: "
               "false, unnormalised_displacement: false, phantom_gimbal_rate: true, collision_voids_score: false, "
               "ray_ends_at_point: true, own_body_hides: false, camera_blind_in_structure: false, "
               "collision_kills_both: true, "
               "min_point_score: 0.1, takeoff_height_m: 0.5, takeoff_speed_mps: 0.2}\n"),
      options_);
  EXPECT_FALSE(read.rules.reject_commands_beyond_limits || read.rules.guard_position_commands ||
               read.rules.limit_search_radius || read.rules.unnormalised_displacement ||
               read.rules.collision_voids_score);
  EXPECT_TRUE(read.rules.phantom_gimbal_rate && read.rules.ray_ends_at_point && read.rules.collision_kills_both);
  EXPECT_FALSE(read.rules.own_body_hides || read.rules.camera_blind_in_structure);
  EXPECT_EQ(read.rules.min_point_score, 0.1);
  EXPECT_EQ(read.rules.takeoff_height_m, 0.5);
  EXPECT_EQ(read.rules.takeoff_speed_mps, 0.2);
}

TEST_F(ScenarioReader, ShippedVehiclesAndTimesAreThoseOfTheBenchmark) {
  const VehicleConfig explorer = load_vehicle("explorer", options_.config_dir);
  const VehicleConfig photographer = load_vehicle("photographer", options_.config_dir);
  EXPECT_EQ(explorer.max_speed_mps, 6.0);
  EXPECT_EQ(explorer.max_acceleration_mps2, 4.0);
  EXPECT_EQ(photographer.max_speed_mps, 8.0);
  EXPECT_EQ(photographer.max_acceleration_mps2, 6.0);
  options_.needs_scene_files = false;
  for (const auto& [name, budget_s] : {std::pair{"mbs", 600.0}, {"crane", 600.0}, {"hangar", 240.0}}) {
    EXPECT_EQ(load_scenario(name, options_).duration_s, budget_s) << name;
  }
}

TEST_F(ScenarioReader, TheLidarOfAVehicleMayLoseReturns) {
  const auto vehicle = [&](const std::string& lidar) {
    return write("v.yaml", "name: v\nrole: explorer\nlidar:\n" + lidar);
  };
  const auto refused = [&](const std::string& lidar) {
    try {
      load_vehicle(vehicle(lidar), options_.config_dir);
    } catch (const InputError& error) {
      const std::string text = error.what();
      return text.substr(text.find("v.yaml"));
    }
    return std::string("accepted");
  };
  const LidarConfig none = *load_vehicle("explorer", options_.config_dir).lidar;
  EXPECT_EQ(none.no_return_p, 0.0);
  EXPECT_FALSE(none.dropped_sectors);
  const LidarConfig some =
      *load_vehicle(vehicle("  no_return_p: 0.3\n  dropped_sectors: {share: 0.1, width_deg: 30, hold_s: 2}\n"),
                    options_.config_dir)
           .lidar;
  EXPECT_EQ(some.no_return_p, 0.3);
  ASSERT_TRUE(some.dropped_sectors);
  EXPECT_EQ(some.dropped_sectors->share, 0.1);
  EXPECT_EQ(some.dropped_sectors->width_deg, 30.0);
  EXPECT_EQ(some.dropped_sectors->hold_s, 2.0);
  EXPECT_EQ(refused("  no_return_p: 0.6\n"),
            "v.yaml:4: lidar.no_return_p: must be a number within [0, 0.5], not '0.6'");
  EXPECT_EQ(refused("  no_return: 0.3\n"), "v.yaml:4: unknown key 'lidar.no_return'; did you mean 'no_return_p'?");
  EXPECT_EQ(refused("  dropped_sectors: 0.1\n"), "v.yaml:4: lidar.dropped_sectors: must be a map of keys, not '0.1'");
  EXPECT_EQ(refused("  dropped_sectors:\n    share: 0.51\n    width_deg: 30\n    hold_s: 2\n"),
            "v.yaml:5: lidar.dropped_sectors.share: must be a number within [0, 0.5], not '0.51'");
  EXPECT_EQ(refused("  dropped_sectors:\n    share: 0.1\n    width_deg: 0\n    hold_s: 2\n"),
            "v.yaml:6: lidar.dropped_sectors.width_deg: must be a number above 0 and at most 360, not '0'");
  EXPECT_EQ(refused("  dropped_sectors:\n    share: 0.1\n    width_deg: 30\n    hold_s: -1\n"),
            "v.yaml:7: lidar.dropped_sectors.hold_s: must be a number within [0.0025, 36000], not '-1'");
  EXPECT_EQ(refused("  dropped_sectors:\n    share: 0.1\n    width_deg: 30\n"),
            "v.yaml:5: missing key 'lidar.dropped_sectors.hold_s': it is required");
}

TEST_F(ScenarioReader, FindsSceneFilesBesideTheScenarioOrInTheAssets) {
  write("own.stl", "");
  fs::create_directories(folder_ / "data" / "models");
  write("data/models/p.pcd", "");
  write("data/models/b.yaml", "");
  const std::string file = scenario("{meshes: [./own.stl], points: models/p.pcd, boxes: models/b.yaml}");
  const std::string advice = complaint(file);
  EXPECT_NE(advice.find("--assets"), std::string::npos) << advice;
  EXPECT_NE(advice.find("'towers'"), std::string::npos) << advice;

  options_.assets_dir = folder_ / "data";
  const Scenario read = load_scenario(file, options_);
  EXPECT_TRUE(fs::equivalent(read.scene.meshes.at(0), folder_ / "own.stl"));
  EXPECT_TRUE(fs::equivalent(read.scene.points, folder_ / "data" / "models" / "p.pcd"));

  options_.assets_dir = folder_;
  EXPECT_NE(complaint(file).find("s.yaml:2: scene.points: there is no file"), std::string::npos) << complaint(file);

  options_.assets_dir.clear();
  options_.needs_scene_files = false;
  EXPECT_EQ(complaint(file), "accepted");
}

TEST_F(ScenarioReader, ASeedForASceneFromFilesIsRefused) {
  options_.needs_scene_files = false;
  options_.scene_seed = 1;
  EXPECT_NE(complaint(scenario("{meshes: [a.stl], points: p.pcd, boxes: b.yaml}")).find("--scene-seed"),
            std::string::npos);
}

TEST_F(ScenarioReader, TheOptionUavsChangesTheSizeOfTheFleet) {
  const auto fleet_of = [&](std::size_t uavs) {
    options_.uavs = uavs;
    return load_scenario("towers", options_).fleet;
  };
  const auto whole = fleet_of(5), more = fleet_of(8);
  for (std::size_t uavs = 1; uavs <= 8; ++uavs) {
    const auto fleet = fleet_of(uavs);
    ASSERT_EQ(fleet.size(), uavs);
    for (std::size_t i = 0; i < uavs; ++i) {
      EXPECT_EQ(fleet[i].name, i < 5 ? whole[i].name : whole[i - 5].name + "2");
      EXPECT_EQ(fleet[i].vehicle.role, whole[i % 5].vehicle.role);
      EXPECT_EQ(fleet[i].start, more[i].start) << "a UAV starts at the same place in fleets of any size";
    }
  }
  for (const auto& [uavs, reason] :
       {std::pair(0, "--uavs"), {1025, "--uavs"}, {9, "the scene has places for 8 UAVs"}}) {
    options_.uavs = static_cast<std::size_t>(uavs);
    EXPECT_NE(complaint("towers").find(reason), std::string::npos) << complaint("towers");
  }
}

TEST_F(ScenarioReader, AVehicleFileMayBeBesideTheScenario) {
  write("tiny.yaml", "name: tiny\nrole: photographer\nmass_kg: 1.25\n");
  const std::string file = write("s.yaml",
                                 "desired_mm_per_pixel: 2\nscene: {family: towers}\n"
                                 "fleet: [{name: a, vehicle: ./tiny.yaml, start: [0, 0]}]\n");
  EXPECT_EQ(load_scenario(file, options_).fleet[0].vehicle.mass_kg, 1.25);
  write("tiny.yaml", "name: tiny\nrole: photographer\nmass_kg: heavy\n");
  EXPECT_NE(complaint(file).find("tiny.yaml:3: mass_kg: must be a number"), std::string::npos) << complaint(file);
}

TEST_F(ScenarioReader, StartsTooCloseForTheTwoBodiesAreRefused) {
  RandomStream random(1, "starts", 0);
  for (int i = 0; i < 60; ++i) {
    const std::string first = i % 2 == 0 ? "explorer" : "photographer", second = i % 3 == 0 ? "explorer" : first;
    const VehicleConfig a = load_vehicle(first, options_.config_dir), b = load_vehicle(second, options_.config_dir);
    const double needed = a.arm_m + a.rotor_radius_m + b.arm_m + b.rotor_radius_m + 0.02;
    const bool enough = i % 4 < 2;
    const double distance = needed + (enough ? 1.0 : -1.0) * random.uniform(1e-3, 0.4);
    const double way = random.uniform(-3.0, 3.0);
    const std::string file =
        write("s.yaml", fmt::format("desired_mm_per_pixel: 2\nscene: {{family: towers}}\nfleet:\n"
                                    "  - {{name: jurong, vehicle: {}, start: [9, 3]}}\n"
                                    "  - {{name: changi, vehicle: {}, start: [{}, {}]}}\n",
                                    first, second, 9 + distance * std::cos(way), 3 + distance * std::sin(way)));
    const std::string expected =
        enough
            ? "accepted"
            : fmt::format(":5: fleet[1].start: 'changi' starts {:.3f} m from 'jurong' and must start {:.3f} m or more",
                          distance, needed);
    EXPECT_NE(complaint(file).find(expected), std::string::npos) << distance << ": " << complaint(file);
  }
}

TEST_F(ScenarioReader, APrintedScenarioReadsBackTheSame) {
  const std::string radio =
      "radio: {topics: [{name: /chat, type: std_msgs/msg/String, sources: all, targets: [gcs, changi]}]}\n";
  const Scenario read = load_scenario(scenario("{family: towers, scene_seed: 4}", radio), options_);
  const std::string printed = to_yaml(read);
  const Scenario again = load_scenario(write("again.yaml", printed), options_);
  EXPECT_EQ(to_yaml(again), printed);
  EXPECT_EQ(again.fleet[0].start_yaw, read.fleet[0].start_yaw);
  EXPECT_EQ(again.radio.at(0).sources, std::vector<std::string>{"all"});
  EXPECT_EQ(again.radio.at(0).targets, (std::vector<std::string>{"gcs", "changi"}));
}

TEST_F(ScenarioReader, HelpsWithAMistypedScenario) {
  EXPECT_NE(complaint("twoers").find("did you mean 'towers'?"), std::string::npos);
  EXPECT_NE(complaint("distrit").find("did you mean 'district'?"), std::string::npos);
  EXPECT_NE(complaint("./none.yaml").find("none.yaml: no such scenario file"), std::string::npos);
  EXPECT_NE(complaint("").find("no scenario is called ''"), std::string::npos);
  EXPECT_NE(complaint("distrikt").find("did you mean 'district'?"), std::string::npos)
      << "a family without a file is suggested, too";
  EXPECT_NE(complaint("wild").find("have no file here; write one with `skein scene wild "), std::string::npos);
}

TEST(ConfigDir, IsTheFolderThatTheEnvironmentNames) {
  const std::string config = source_path("config");
  ASSERT_EQ(::setenv("SKEIN_CONFIG_DIR", config.c_str(), 1), 0);
  EXPECT_EQ(default_config_dir(), config);
  ASSERT_EQ(::setenv("SKEIN_CONFIG_DIR", "/no/such/folder", 1), 0);
  EXPECT_THROW(default_config_dir(), InputError);
  ::unsetenv("SKEIN_CONFIG_DIR");
}

// Otherwise a UAV could have the name of a member of the lock-step, of a node or of a folder of topics.
TEST_F(ScenarioReader, AUavWithTheNameOfAProgramOrNodeIsRefused) {
  for (const std::string name :
       {"all", "clock", "comm_router", "gcs", "one_process", "sim", "sim_server", "skein", "station", "uav_agent"}) {
    const std::string file =
        write("s.yaml", "desired_mm_per_pixel: 2\nscene: {family: towers}\nfleet:\n  - {name: " + name +
                            ", vehicle: explorer, start: [0, 5]}\n");
    EXPECT_EQ(complaint(file), file + ":4: fleet[0].name: '" + name + "' is reserved; choose another name");
  }
}

TEST_F(ScenarioReader, AMissingStartIsTheOnlyErrorReportedForAUav) {
  write("o.stl", "");
  const std::string file =
      write("s.yaml",
            "desired_mm_per_pixel: 2\nstation: {position: [0, 0, 0.3]}\n"
            "scene: {meshes: [./o.stl], points: ./o.stl, boxes: ./o.stl}\n"
            "fleet: [{name: a, vehicle: explorer}, {name: b, vehicle: explorer, start: [9, 9]}]\n");
  EXPECT_EQ(complaint(file),
            file + ":4: fleet[0]: 'a' needs a 'start: [x, y]': a scene from files has no places of its own");
}

TEST_F(ScenarioReader, TheErrorNamesThePathAtWhichAFileIsMissing) {
  const std::string beside = complaint(scenario("{meshes: [./models/own.stl], points: ./p.pcd, boxes: ./b.yaml}"));
  EXPECT_NE(beside.find("there is no file " + (folder_ / "models/own.stl").string() + "\n"), std::string::npos)
      << beside;
  EXPECT_EQ(beside.find("--assets"), std::string::npos) << beside;

  const std::string in_assets = scenario("{meshes: [models/own.stl], points: ./p.pcd, boxes: ./b.yaml}");
  const std::string no_assets = complaint(in_assets);
  EXPECT_NE(no_assets.find("models/own.stl"), std::string::npos) << no_assets;
  EXPECT_NE(no_assets.find("--assets"), std::string::npos) << no_assets;
  EXPECT_NE(no_assets.find("./models/own.stl for a file beside the scenario"), std::string::npos) << no_assets;
  EXPECT_EQ(no_assets.find("needs CARIC"), std::string::npos) << no_assets;

  options_.assets_dir = folder_ / "data";
  const std::string missing = complaint(in_assets);
  EXPECT_NE(missing.find((folder_ / "data/models/own.stl").string() + "; --assets"), std::string::npos) << missing;
}

// A reader whose time grew with the square of the file's length would take minutes.
TEST_F(ScenarioReader, LargeFilesAreReadOrRefusedInTimeProportionalToTheirLength) {
  const std::string head = "desired_mm_per_pixel: 2\nscene: {family: towers}\nfleet: [{name: a, vehicle: explorer}]\n";
  std::string topics = head + "radio:\n  topics:\n";
  for (int i = 0; i < 20000; ++i) {
    topics += "  - {name: /t" + std::to_string(i) + ", type: std_msgs/msg/String, sources: all, targets: all}\n";
  }
  EXPECT_EQ(load_scenario(write("topics.yaml", topics), options_).radio.size(), 20000U);

  const std::string description(4 << 20, 'x');
  EXPECT_EQ(load_scenario(write("long.yaml", head + "description: " + description + "\n"), options_).description,
            description);

  std::string keys = head,
              names = head + "radio: {topics: [{name: /t, type: std_msgs/msg/String, targets: all, sources: [";
  std::string fleet = "desired_mm_per_pixel: 2\nscene: {family: towers}\nfleet:\n";
  for (int i = 0; i < 100000; ++i) {
    keys += "k" + std::to_string(i) + ": 1\n";
    names += "a, ";
  }
  for (int i = 0; i < 5000; ++i) fleet += "- {name: u" + std::to_string(i) + ", vehicle: explorer, start: [1, 1]}\n";
  EXPECT_NE(complaint(write("keys.yaml", keys)).find("and 99990 more"), std::string::npos);
  EXPECT_NE(complaint(write("names.yaml", names + "a]}]}\n")).find("'a' is named twice"), std::string::npos);
  EXPECT_NE(complaint(write("fleet.yaml", fleet)).find("must have 1 to 1024 UAVs"), std::string::npos);
}

}  // namespace
}  // namespace skein
