// What the server leaves behind about collisions: who, with what, when, where.
#include "sim_server/record/run_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "skein_run_files";
  std::filesystem::create_directories(folder);
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
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skein::sim
