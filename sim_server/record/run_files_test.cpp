// The server's output files: poses, digests, the scene, and the report with collisions, losses and unwritten files.
#include "sim_server/record/run_files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/scoring/camera_quality.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

class RunFilesTest : public testing::Test {
 protected:
  RunFilesTest() {
    const std::filesystem::path config = source_path("config");
    scenario_.file = "files.yaml";
    for (const char* name : {"jurong", "changi"}) {
      const double y = 3.0 * static_cast<double>(scenario_.fleet.size());
      scenario_.fleet.push_back({.name = name, .vehicle = load_vehicle("photographer", config), .start = {0, y}});
    }
  }
  ~RunFilesTest() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ = [] {
    std::string name = std::filesystem::path(testing::TempDir()) / "skein_run_files_XXXXXX";
    return std::filesystem::path(::mkdtemp(name.data()));
  }();
  Scenario scenario_;
  const Collision with_structure_{
      .tick = 4921, .uav = UavIndex{1}, .with = {BodyId::Kind::structure, UavIndex{0}}, .p_W = {1.5, -2, 7}};
  const Collision with_uav_{
      .tick = 400, .uav = UavIndex{0}, .with = {BodyId::Kind::uav, UavIndex{1}}, .p_W = {1, 2, 3}};
};

TEST_F(RunFilesTest, TheLogLineOfACollisionHasPairTimeAndPlace) {
  EXPECT_EQ(describe(with_structure_, scenario_),
            "changi collided with structure at 12.3025 s, at (1.50, -2.00, 7.00): it is out");
  EXPECT_EQ(describe(with_uav_, scenario_),
            "jurong collided with changi at 1.0000 s, at (1.00, 2.00, 3.00): it is out");
}

TEST_F(RunFilesTest, TheReportHasPairTimeAndPlaceOfEachCollision) {
  const std::filesystem::path& folder = folder_;
  const Simulation simulation(scenario_, {}, 0);
  RunDigest digest(scenario_.uav_names());
  RunSummary summary;
  summary.collisions = {with_uav_, with_structure_};
  StatusPipe no_launcher(-1);
  RunFiles(folder, scenario_, digest).write_report(simulation, summary, no_launcher);
  const auto report = nlohmann::json::parse(std::ifstream(folder / "sim_server.report.json"));
  const auto expected = nlohmann::json::parse(R"([
      {"time_s": 1.0, "uav": "jurong", "with": "changi", "position": [1.0, 2.0, 3.0]},
      {"time_s": 12.3025, "uav": "changi", "with": "structure", "position": [1.5, -2.0, 7.0]}])");
  EXPECT_EQ(report["collisions"], expected);
  EXPECT_EQ(report.value("unwritten", nlohmann::json::array()), nlohmann::json::array());
}

TEST_F(RunFilesTest, TheFilesHaveAPoseEveryTenthOfASecondAndADigestEveryExchange) {
  Simulation simulation(scenario_, {}, 0);
  RunDigest digest(scenario_.uav_names());
  RunFiles files(folder_, scenario_, digest);
  constexpr int kExchanges = 9;  // 50 ms each
  for (int k = 0; k < kExchanges; ++k) {
    files.add_step(simulation, {.k = simulation.step(), .running = "r" + std::to_string(k), .fields = {"x", "y"}});
    simulation.advance();
  }
  StatusPipe no_launcher(-1);
  files.write_report(simulation, {}, no_launcher);
  const auto lines = [&](const char* name) {
    std::ifstream in(folder_ / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line.substr(0, line.find(',', line.find(',') + 1)));
    return all;
  };
  std::vector<std::string> poses = {"time_s,uav"};
  for (const char* time_s : {"0.00", "0.10", "0.20", "0.30", "0.40"}) {
    for (const std::string& name : scenario_.uav_names()) poses.push_back(time_s + ("," + name));
  }
  EXPECT_EQ(lines("trajectories.csv"), poses);
  const std::vector<std::string> digests = lines("digests.csv");
  ASSERT_EQ(digests.size(), kExchanges + 1u);
  for (int k = 0; k < kExchanges; ++k) {
    EXPECT_EQ(digests[static_cast<std::size_t>(k) + 1], std::to_string(k) + ",r" + std::to_string(k));
  }
}

TEST_F(RunFilesTest, TheSceneFileHasBoxesAndPointsUnchanged) {
  Scene scene;
  for (std::uint64_t i = 0; i < 20; ++i) {
    RandomStream random(i, "boxes", 0);
    const Vector3d axis = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    OrientedBox box;
    box.name = "box " + std::to_string(i);
    box.center = 10.0 * axis;
    box.size = Vector3d(1.0, 2.0 + random.uniform(), 3.0);
    box.R_WO = Eigen::AngleAxisd(random.uniform(-3.0, 3.0), axis).toRotationMatrix();
    scene.boxes.push_back(box);
    scene.points.push_back({.p_W = (3.0 * axis).cast<float>(), .n_W = axis.cast<float>()});
  }
  scenario_.scene.meshes = {"/some/where/crane.stl", "hall.stl"};
  RunFiles(folder_, scenario_, RunDigest(scenario_.uav_names())).write_scene(scene);
  const auto json = nlohmann::json::parse(std::ifstream(folder_ / "scene.json"));
  EXPECT_EQ(json["mesh"]["files"], nlohmann::json({"crane.stl", "hall.stl"})) << "without the folder";
  ASSERT_EQ(json["cameras"].size(), scenario_.fleet.size());
  const CameraConfig& camera = scenario_.fleet.back().vehicle.camera;
  EXPECT_EQ(json["cameras"].back(),
            (nlohmann::json{{"uav", scenario_.fleet.back().name},
                            {"hfov_deg", camera.hfov_deg},
                            {"vfov_deg", camera.vfov_deg},
                            {"range_m", resolution_distance(camera, scenario_.desired_mm_per_pixel)}}));
  ASSERT_EQ(json["boxes"].size(), scene.boxes.size());
  ASSERT_EQ(json["points"].size(), scene.points.size());
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const OrientedBox& box = scene.boxes[i];
    EXPECT_EQ(json["boxes"][i]["name"], box.name);
    ASSERT_EQ(json["boxes"][i]["rotation"].size(), 3u);
    for (int row = 0; row < 3; ++row) {
      EXPECT_EQ(json["boxes"][i]["center"][row], box.center[row]);
      EXPECT_EQ(json["boxes"][i]["size"][row], box.size[row]);
      EXPECT_EQ(json["points"][i][row], scene.points[i].p_W[row]);
      EXPECT_EQ(json["points"][i][row + 3], scene.points[i].n_W[row]);
      for (int column = 0; column < 3; ++column) {
        EXPECT_EQ(json["boxes"][i]["rotation"][row][column], box.R_WO(row, column));
      }
    }
  }
}

TEST_F(RunFilesTest, TheReportNamesLostMembersSeenPointsAndMissingFiles) {
  Scene scene;
  scene.points.resize(3);
  const Simulation simulation(scenario_, scene, 0);
  RunSummary summary;
  summary.lost = {{.name = "jurong", .step = 3, .tick = 400, .reason = "it ended"},
                  {.name = "changi", .step = 5, .tick = 800, .reason = "killed", .back = Tick{1200}}};
  StatusPipe no_launcher(-1);
  RunFiles files(folder_, scenario_, RunDigest(scenario_.uav_names()));
  std::filesystem::create_directory(folder_ / "scene.json");  // so that the server cannot write the file
  files.write_scene(scene);
  files.note_unwritten("");
  files.note_unwritten("the disk is full");
  files.write_report(simulation, summary, no_launcher);
  const auto report = nlohmann::json::parse(std::ifstream(folder_ / "sim_server.report.json"));
  EXPECT_EQ(report["lost_members"], nlohmann::json::parse(R"([
      {"member": "jurong", "step": 3, "time_s": 1.0, "reason": "it ended", "back_at_s": null},
      {"member": "changi", "step": 5, "time_s": 2.0, "reason": "killed", "back_at_s": 3.0}])"));
  EXPECT_EQ(report["points_total"], 3);
  EXPECT_EQ(report["points_seen"], "000") << "no UAV took a picture";
  EXPECT_EQ(report["points_poor"], nlohmann::json::array());
  ASSERT_EQ(report["unwritten"].size(), 2u) << report["unwritten"];
  EXPECT_NE(report["unwritten"][0].get<std::string>().find("scene.json"), std::string::npos) << report["unwritten"];
  EXPECT_EQ(report["unwritten"][1], "the disk is full");
}

// A full battery lasts for 30 s of hover, in the last case for 60 s. A UAV descends after 6 s or 21 s.
TEST_F(RunFilesTest, AUavIsGroundedIfItLandsWithLittleMoreThanItsReserve) {
  scenario_.duration_s = 30.0;
  scenario_.conditions.battery.endurance_missions = 1.0;
  scenario_.conditions.battery.reserve = 0.2;
  const auto grounded_after = [&](double up_s) {
    Simulation simulation(scenario_, {}, 0);
    const auto fly = [&](double until_s, double height_m, double climb_mps) {
      while (seconds(simulation.tick()) < until_s) {
        const TrajectoryCommand command{.p_WB = {0.0, 0.0, height_m}, .v_WB = {0.0, 0.0, climb_mps}};
        simulation.command_trajectory(UavIndex{0}, command);
        simulation.advance();
      }
    };
    fly(up_s, 1.5, 0.0);
    fly(up_s + 4.0, 0.05, -1.0);
    EXPECT_FALSE(simulation.uav(UavIndex{0}).airborne);
    StatusPipe no_launcher(-1);
    RunFiles(folder_, scenario_, RunDigest(scenario_.uav_names())).write_report(simulation, {}, no_launcher);
    const auto report = nlohmann::json::parse(std::ifstream(folder_ / "sim_server.report.json"));
    EXPECT_EQ(report["uavs"][1]["battery"]["grounded"], false) << "it has never flown";
    return report["uavs"][0]["battery"]["grounded"].get<bool>();
  };
  EXPECT_FALSE(grounded_after(6.0));
  EXPECT_TRUE(grounded_after(21.0));
  scenario_.conditions.battery.reserve = 0.7;
  EXPECT_TRUE(grounded_after(6.0));
  scenario_.conditions.battery.endurance_missions = 2.0;
  scenario_.conditions.battery.reserve = 0.2;
  EXPECT_FALSE(grounded_after(21.0));
}

TEST_F(RunFilesTest, APoseHasAValueForEachColumn) {
  const Simulation simulation(scenario_, {}, 0);
  RunFiles files(folder_, scenario_, RunDigest(scenario_.uav_names()));
  files.add_step(simulation, {.k = 0, .running = "r", .fields = {}});
  StatusPipe no_launcher(-1);
  files.write_report(simulation, {}, no_launcher);
  std::ifstream in(folder_ / "trajectories.csv");
  const auto fields_of = [&in] {
    std::string line, field;
    std::getline(in, line);
    std::vector<std::string> fields;
    for (std::istringstream rest(line); std::getline(rest, field, ',');) fields.push_back(field);
    return fields;
  };
  const std::vector<std::string> columns = fields_of();
  for (const UavIndex i : FirstUavs(simulation.size())) {
    const std::vector<std::string> fields = fields_of();
    ASSERT_EQ(fields.size(), columns.size());
    const auto& [p, q, v, w] = simulation.uav(i).state;
    const std::map<std::string, double> expected = {{"x", p.x()},
                                                    {"y", p.y()},
                                                    {"z", p.z()},
                                                    {"qw", q.w()},
                                                    {"qx", q.x()},
                                                    {"qy", q.y()},
                                                    {"qz", q.z()},
                                                    {"vx", v.x()},
                                                    {"vy", v.y()},
                                                    {"vz", v.z()},
                                                    {"alive", 1},
                                                    {"time_s", 0},
                                                    {"gimbal_pitch", simulation.uav(i).gimbal.pitch},
                                                    {"gimbal_yaw", simulation.uav(i).gimbal.yaw}};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto found = expected.find(columns[c]);
      if (found == expected.end()) continue;  // the UAV's name, and the clearance
      EXPECT_NEAR(std::stod(fields[c]), found->second, 1e-4) << columns[c];
    }
  }
}

TEST_F(RunFilesTest, APoseHasTheChargeWhereThereAreBatteries) {
  const auto table = [&] {
    Simulation simulation(scenario_, {}, 0);
    while (seconds(simulation.tick()) < 3.0) {
      simulation.command_trajectory(UavIndex{0}, {.p_WB = {0.0, 0.0, 3.0}});
      simulation.advance();
    }
    RunFiles files(folder_, scenario_, RunDigest(scenario_.uav_names()));
    files.add_step(simulation, {.k = 20, .running = "r", .fields = {}});
    StatusPipe no_launcher(-1);
    files.write_report(simulation, {}, no_launcher);
    const auto battery = simulation.uav(UavIndex{0}).battery;
    std::ifstream in(folder_ / "trajectories.csv");
    std::string columns, row;
    std::getline(in, columns);
    std::getline(in, row);
    return std::tuple(columns, row, battery ? battery->charge : 1.0);
  };
  const auto [columns, row, full] = table();
  scenario_.conditions.battery = conditions_preset("harsh").battery;
  const auto [with_charge, charged_row, charge] = table();
  EXPECT_EQ(with_charge, columns + ",charge");
  ASSERT_LT(charge, 0.999) << "a UAV in flight uses its battery";
  EXPECT_NEAR(std::stod(charged_row.substr(charged_row.rfind(',') + 1)), charge, 1e-4);
  EXPECT_EQ(charged_row.substr(0, charged_row.rfind(',')), row);
}

TEST_F(RunFilesTest, TheReportNamesOnlyTheFileThatTheDiskRefuses) {
  for (const char* full : {"trajectories.csv", "digests.csv", "events.csv"}) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::filesystem::create_symlink("/dev/full", folder_ / full);
    const Simulation simulation(scenario_, {}, 0);
    StatusPipe no_launcher(-1);
    RunFiles(folder_, scenario_, RunDigest(scenario_.uav_names())).write_report(simulation, {}, no_launcher);
    const auto report = nlohmann::json::parse(std::ifstream(folder_ / "sim_server.report.json"));
    ASSERT_EQ(report["unwritten"].size(), 1u) << report;
    EXPECT_NE(report["unwritten"][0].get<std::string>().find(full), std::string::npos) << report["unwritten"];
  }
}

}  // namespace
}  // namespace skein::sim
