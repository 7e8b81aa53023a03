// What the server leaves behind: poses, digests, the scene, and what of it could not be written; collisions.
#include "sim_server/record/run_files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/random_stream.hpp"
#include "core/scenario_reader.hpp"
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

TEST_F(RunFilesTest, ALineTellsPairTimeAndPlace) {
  EXPECT_EQ(describe(with_structure_, scenario_),
            "changi collided with structure at 12.3025 s, at (1.50, -2.00, 7.00): it is out");
  EXPECT_EQ(describe(with_uav_, scenario_),
            "jurong collided with changi at 1.0000 s, at (1.00, 2.00, 3.00): it is out");
}

TEST_F(RunFilesTest, TheReportTellsPairTimeAndPlace) {
  const std::filesystem::path& folder = folder_;
  const Simulation simulation(scenario_, {}, 0);
  RunDigest digest(scenario_.uav_names());
  RunSummary summary;
  summary.collisions = {with_uav_, with_structure_};
  StatusPipe nobody(-1);
  RunFiles(folder, scenario_, digest).write_report(simulation, summary, nobody);
  const auto report = nlohmann::json::parse(std::ifstream(folder / "sim_server.report.json"));
  const auto expected = nlohmann::json::parse(R"([
      {"time_s": 1.0, "uav": "jurong", "with": "changi", "position": [1.0, 2.0, 3.0]},
      {"time_s": 12.3025, "uav": "changi", "with": "structure", "position": [1.5, -2.0, 7.0]}])");
  EXPECT_EQ(report["collisions"], expected);
  EXPECT_EQ(report.value("unwritten", nlohmann::json::array()), nlohmann::json::array());
}

TEST_F(RunFilesTest, APoseATenthOfASecondAndADigestAnExchange) {
  Simulation simulation(scenario_, {}, 0);
  RunDigest digest(scenario_.uav_names());
  RunFiles files(folder_, scenario_, digest);
  constexpr int kExchanges = 9;  // 50 ms each
  for (int k = 0; k < kExchanges; ++k) {
    files.add_step(simulation, {.k = simulation.step(), .running = "r" + std::to_string(k), .fields = {"x", "y"}});
    simulation.advance();
  }
  StatusPipe nobody(-1);
  files.write_report(simulation, {}, nobody);
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

TEST_F(RunFilesTest, TheSceneHasItsBoxesAndPointsAsTheyStand) {
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
  RunFiles(folder_, scenario_, RunDigest(scenario_.uav_names())).write_scene(scene);
  const auto json = nlohmann::json::parse(std::ifstream(folder_ / "scene.json"));
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

TEST_F(RunFilesTest, AFileThatTheDiskRefusesIsNamedAndNoOther) {
  for (const char* full : {"trajectories.csv", "digests.csv", "events.csv"}) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::filesystem::create_symlink("/dev/full", folder_ / full);
    const Simulation simulation(scenario_, {}, 0);
    StatusPipe nobody(-1);
    RunFiles(folder_, scenario_, RunDigest(scenario_.uav_names())).write_report(simulation, {}, nobody);
    const auto report = nlohmann::json::parse(std::ifstream(folder_ / "sim_server.report.json"));
    ASSERT_EQ(report["unwritten"].size(), 1u) << report;
    EXPECT_NE(report["unwritten"][0].get<std::string>().find(full), std::string::npos) << report["unwritten"];
  }
}

}  // namespace
}  // namespace skein::sim
