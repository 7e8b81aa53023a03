#include "station/settlement.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "station/journal.hpp"
#include "tests/support/text_files.hpp"

namespace skein::station {
namespace {

class Settlement : public testing::Test {
 protected:
  Settlement() {
    std::filesystem::create_directories(folder_);
    scenario_.fleet.resize(2);
    scenario_.fleet[0].name = "a";
    scenario_.fleet[1].name = "b";
  }
  ~Settlement() override { std::filesystem::remove_all(folder_); }

  static TallyRecord record(std::uint64_t index, UavIndex uav, std::uint64_t capture, std::uint32_t point, float q) {
    TallyRecord record;
    record.tick = static_cast<Tick>(100 * index);
    record.entry = {index, record.tick, uav, false, {uav, capture, record.tick, 7, {{point, q, 1.0F, q}}}};
    return record;
  }
  nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(folder_ / "station.report.json")); }
  std::string text(const char* file) const { return read_text(folder_ / file); }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("skein_settlement_" + std::to_string(::getpid()));
  Scenario scenario_;
  StatusPipe no_launcher_{-1};
};

TEST_F(Settlement, TheReportIsComputedFromTheJournal) {
  std::ofstream(folder_ / "scene.json") << R"({"points": [[0,0,0,0,0,1], [1,0,0,0,0,1], [2,0,0,0,0,1]]})";
  // Entries of the ledger that never arrived leave gaps in the numbers.
  Journal(folder_ / "station.journal")
      .append(std::vector<TallyRecord>{record(2, UavIndex{0}, 0, 1, 0.5F), record(5, UavIndex{1}, 3, 1, 0.75F),
                                       record(9, UavIndex{1}, 4, 2, 0.25F)});
  settle(folder_, scenario_, RunId::none, no_launcher_);
  EXPECT_EQ(report()["score"], 1.0);
  EXPECT_EQ(report()["points_detected"], 2);
  EXPECT_EQ(report()["score_by_uav"]["b"], 1.0);
  EXPECT_FALSE(report().contains("score_earned")) << "only the ledger has the earned score";
  EXPECT_EQ(report()["reports_received"], 3);
  const std::string captures = text("captures.csv");
  EXPECT_NE(captures.find("a,0,200,0.5,1,1,0.5,1,0,0.5,0.5,better capture\n"), std::string::npos) << captures;
  EXPECT_NE(captures.find("b,4,900,2.25,2,1,0.25,1,0,0.25,2.25,\n"), std::string::npos) << captures;
  EXPECT_NE(text("score_timeline.csv").find("2.25,2,1\n"), std::string::npos) << text("score_timeline.csv");
}

// The station was away when b collided, so its journal does not say so.
TEST_F(Settlement, ACollisionThatTheStationDidNotHearOfVoidsTheScore) {
  std::ofstream(folder_ / "scene.json") << R"({"points": [[0,0,0,0,0,1], [1,0,0,0,0,1], [2,0,0,0,0,1]]})";
  std::ofstream(folder_ / "sim_server.report.json")
      << R"({"collisions": [{"uav": "b", "time_s": 20.0, "with": "ground", "cause": "battery"}]})";
  Journal(folder_ / "station.journal")
      .append(std::vector<TallyRecord>{record(2, UavIndex{0}, 0, 1, 0.5F), record(5, UavIndex{1}, 3, 1, 0.75F),
                                       record(9, UavIndex{1}, 4, 2, 0.25F)});
  for (const bool voids : {true, false}) {
    scenario_.rules.collision_voids_score = voids;
    settle(folder_, scenario_, RunId::none, no_launcher_);
    EXPECT_EQ(report()["score"], voids ? 0.5 : 1.0);
    EXPECT_EQ(text("captures.csv").find("uav collided") != std::string::npos, voids);
  }
}

TEST_F(Settlement, WithoutDeliveriesTheReportIsEmpty) {
  std::ofstream(folder_ / "scene.json") << R"({"points": []})";
  settle(folder_, scenario_, RunId::none, no_launcher_);
  EXPECT_EQ(report()["score"], 0.0);
}

TEST_F(Settlement, WithoutASceneThereIsNoReport) {
  EXPECT_THROW(settle(folder_, scenario_, RunId::none, no_launcher_), std::runtime_error);
}

}  // namespace
}  // namespace skein::station
