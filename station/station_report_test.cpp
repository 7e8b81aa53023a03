#include "station/station_report.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "tests/support/text_files.hpp"

namespace skein::station {
namespace {

namespace fs = std::filesystem;

/// One capture of each fate: it counts, another is better, never received, altered, of a UAV that collided.
Scoreboard eventful_run() {
  Scoreboard score(3, 10, RulesConfig{});
  const CaptureReport counts{UavIndex{0}, 0, 100, 11, {{2, 1.0F, 0.75F, 0.75F, 0.875F}}};
  const CaptureReport worse{UavIndex{1}, 0, 110, 12, {{2, 0.5F, 1.0F, 0.5F}}};
  const CaptureReport kept{UavIndex{1}, 1, 150, 13, {{4, 1.0F, 0.5F, 0.5F}}};
  CaptureReport altered{UavIndex{1}, 2, 160, 14, {{5, 1.0F, 0.25F, 0.25F}}};
  const CaptureReport crashed{UavIndex{2}, 0, 170, 15, {{6, 1.0F, 1.0F, 1.0F}}};
  std::uint64_t index = 0;
  for (const CaptureReport& report : {counts, worse, kept, altered, crashed}) {
    score.add_entry({index++, report.tick, report.uav, false, report});
  }
  score.add_entry({index++, 190, UavIndex{2}, true, {}});
  altered.points[0].q = 1.0F;
  for (const CaptureReport& report : {counts, worse, altered, crashed}) score.add_report(report.uav, report);
  score.end_step(180, 5);
  score.add_report(0, counts);
  score.end_step(200, 6);
  return score;
}

class StationReport : public testing::Test {
 protected:
  StationReport() {
    std::string pattern = (fs::temp_directory_path() / "skein-report-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    StatusPipe no_launcher(-1);
    write_station_report(folder_, eventful_run(), {"jurong", "raffles", "changi"}, no_launcher,
                         {.malformed = 3, .unsent = 2});
  }
  ~StationReport() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StationReport, TheAuditStatesTheFateOfEachCapture) {
  EXPECT_EQ(read_text(folder_ / "captures.csv"),
            "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason\n"
            "jurong,0,100,0.25,2,1,1,0.75,0.875,0.75,0.45,\n"
            "raffles,0,110,0.275,2,1,0.5,1,0,0.5,0.45,better capture\n"
            "raffles,1,150,0.375,4,1,1,0.5,0,0.5,,not received\n"
            "raffles,2,160,0.4,5,1,1,0.25,0,0.25,,refused: altered\n"
            "changi,0,170,0.425,6,1,1,1,0,1,0.45,uav collided\n");
}

TEST_F(StationReport, TheTimelineFallsAtACollision) {
  EXPECT_EQ(read_text(folder_ / "score_timeline.csv"),
            "time_s,points,score\n"
            "0,0,0\n"
            "0.45,2,1.75\n"
            "0.5,1,0.75\n");
}

TEST_F(StationReport, TheReportHasTheValuesThatTheResultNeeds) {
  auto report = nlohmann::json::parse(read_text(folder_ / "station.report.json"));
  EXPECT_EQ(report["checksum"].get<std::string>().size(), 64U);
  report.erase("checksum");
  EXPECT_EQ(report, nlohmann::json::parse(R"({
    "points_detected": 1, "score": 0.75, "score_earned": 1.5,
    "score_by_uav": {"jurong": 0.75, "raffles": 0.0, "changi": 0.0},
    "points": [{"index": 2, "score": 0.75, "uav": "jurong", "capture": 0}],
    "refused": {"unknown": 0, "borrowed": 0, "altered": 1},
    "reports_received": 5, "duplicates": 1, "malformed": 3, "unsent": 2, "unwritten": []})"));
}

}  // namespace
}  // namespace skein::station
