// There are two ways to read a run's folder. Both read the same from a sound folder of a random run. With damage, one
// refuses the folder, and the other ends the damaged table.
#include "results/run_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "results/testing/scratch.hpp"

namespace skein::results {
namespace {

class DrawnFolder : public testing::TestWithParam<unsigned> {
 protected:
  static constexpr std::array kTables = {run_folder::kCaptures, run_folder::kEvents, run_folder::kTrajectories,
                                         run_folder::kScoreTimeline};

  DrawnFolder() : random_(GetParam()) {
    write_text(
        dir() / run_folder::kResult,
        R"({"status": "completed", "uavs": [{"name": "a", "role": "explorer"}, {"name": "b"}], "sim_time_s": 1})");
    heads_ = {
        {run_folder::kCaptures, "uav,capture,time_s,point,q_blur,q_res,q_distance,q,delivered_at_s,reason"},
        {run_folder::kEvents, "step,time_s,event,subject,object"},
        {run_folder::kTrajectories, "time_s,uav,x,y,z,qw,qx,qy,qz,vx,vy,vz,gimbal_pitch,gimbal_yaw,alive,clearance"},
        {run_folder::kScoreTimeline, "time_s,points,score"}};
    for (std::size_t k = 0, rows = 2 + below(20); k < rows; ++k) {
      const std::string time = std::to_string(k) + ".5,";
      lines_[run_folder::kCaptures].push_back(uav() + "," + number() + "," + time + number() + ",0.5,0.25,0.75," +
                                              number() + "," + (below(2) > 0 ? number() : "") + "," +
                                              (below(2) > 0 ? run_tables::kUavCollided : ""));
      lines_[run_folder::kEvents].push_back(std::to_string(k) + "," + time + "link_up," + uav() + ",gcs");
      std::string pose = time + uav();
      for (int column = 0; column < 12; ++column) pose += "," + number();
      lines_[run_folder::kTrajectories].push_back(pose + "," + (below(2) > 0 ? "1," : "0,") +
                                                  (below(2) > 0 ? number() : ""));
      lines_[run_folder::kScoreTimeline].push_back(time + number() + "," + number());
    }
    for (const char* table : kTables) write(table);
  }

  std::size_t below(std::size_t limit) { return random_() % limit; }
  std::string number() { return std::to_string(below(100)); }
  std::string uav() { return below(2) > 0 ? "a" : "b"; }
  const std::filesystem::path& dir() const { return scratch_.path(); }
  void write(const std::string& table) {
    write_text(dir() / table, heads_.at(table) + "\n" + joined(lines_.at(table), "\n") + "\n");
  }
  /// Whether the run notes that only the first `rows` rows of this table are valid.
  static bool is_told(const RunRecord& run, const std::string& table, std::size_t rows) {
    return std::ranges::any_of(run.missing, [&](const std::string& sentence) {
      return sentence.starts_with(table + " is readable only up to row " + std::to_string(rows) + " (");
    });
  }
  /// The rows of kTables as text, by table.
  static std::map<std::string, std::vector<std::string>> rows_of(const RunRecord& run) {
    std::map<std::string, std::vector<std::string>> rows;
    const auto add = [&](const char* table, const auto&... cells) {
      std::ostringstream line;
      ((line << cells << ","), ...);
      rows[table].push_back(line.str());
    };
    for (const CaptureRow& row : run.captures) {
      add(CaptureRow::kTable, row.uav, row.capture, row.time_s, row.point, row.q_blur, row.q_res, row.q_distance, row.q,
          row.delivered_at_s ? number_text(*row.delivered_at_s) : "", row.reason);
    }
    for (const EventRow& row : run.events)
      add(EventRow::kTable, row.step, row.time_s, row.event, row.subject, row.object);
    for (const PoseRow& row : run.poses) {
      const auto& [p_W, v_W, q_WB] = std::tie(row.p_W, row.v_W, row.q_WB);
      add(PoseRow::kTable, row.time_s, row.uav, p_W.x(), p_W.y(), p_W.z(), q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z(),
          v_W.x(), v_W.y(), v_W.z(), row.gimbal.pitch, row.gimbal.yaw, row.alive ? 1 : 0,
          row.clearance_m ? number_text(*row.clearance_m) : "");
    }
    for (const ScoreRow& row : run.scores) add(ScoreRow::kTable, row.time_s, row.points, row.score);
    return rows;
  }

  std::mt19937 random_;
  const Scratch scratch_;
  std::map<std::string, std::string> heads_;               ///< the head of each table
  std::map<std::string, std::vector<std::string>> lines_;  ///< the lines of each table
};

TEST_P(DrawnFolder, IsReadAsItWasWritten) {
  auto expected = lines_;
  for (auto& [table, lines] : expected) {
    for (std::string& line : lines) line += ",";
  }
  const RunRecord judged = read_run(dir()), shown = read_sound_run(dir());
  EXPECT_EQ(rows_of(judged), expected);
  EXPECT_EQ(rows_of(shown), expected);
  EXPECT_EQ(judged.end_s, shown.end_s);
  EXPECT_EQ(judged.uavs, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(shown.explorer, (std::vector<bool>{true, false}));
  const auto tracks = shown.by_uav(shown.poses);
  EXPECT_EQ(tracks[0].size() + tracks[1].size(), shown.poses.size());
}

TEST_P(DrawnFolder, AnEventOfACaptureWithoutItsNumberIsRefusedWithItsLine) {
  for (const char* event : {"captured", "released"}) {
    for (const char* number : {"x", "", "1x", "-1", "99999999999999999999"}) {
      lines_.at(run_folder::kEvents)[0] = std::string("0,0,") + event + ",a," + number;
      write(run_folder::kEvents);
      try {
        read_run(dir());
        ADD_FAILURE() << event << " of '" << number << "'";
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("events.csv:2: column 'object': "), std::string::npos) << error.what();
      }
    }
  }
}

TEST_P(DrawnFolder, ADamagedRowIsRefusedWithItsLineOrEndsItsTable) {
  for (const std::string table : kTables) {
    const auto sound = lines_.at(table);
    const std::size_t place = below(sound.size());
    const std::vector<std::string> columns = split(heads_.at(table));
    const auto time = static_cast<std::size_t>(std::ranges::find(columns, "time_s") - columns.begin());
    for (const std::string cell : {"x", "", "nan", "1e300", "-1e8"}) {
      std::vector<std::string> cells = split(sound[place]);
      cells[time] = cell;
      std::string line = cells[0];  // joined() leaves out an empty first cell
      for (std::size_t i = 1; i < cells.size(); ++i) line += "," + cells[i];
      lines_.at(table)[place] = line;
      write(table);
      try {
        read_run(dir());
        ADD_FAILURE() << table << " with '" << cell << "'";
      } catch (const std::runtime_error& error) {
        const std::string told = table + ":" + std::to_string(place + 2) + ": column 'time_s': '" + cell + "' is ";
        EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
      }
      const RunRecord run = read_sound_run(dir());
      EXPECT_EQ(rows_of(run)[table].size(), place) << "the rows before it stay";
      EXPECT_TRUE(is_told(run, table, place)) << table << " with '" << cell << "'";
    }
    lines_.at(table) = sound;
    write(table);
  }
}

TEST_P(DrawnFolder, PagesLeaveOutUavsThatTheResultDoesNotName) {
  const std::size_t rows = lines_.at(run_folder::kCaptures).size();
  lines_.at(run_folder::kCaptures).insert(lines_.at(run_folder::kCaptures).begin(), "nobody,0,1,0,1,1,1,1,,");
  write(run_folder::kCaptures);
  EXPECT_EQ(read_run(dir()).captures.size(), rows + 1);
  EXPECT_EQ(read_sound_run(dir()).captures.size(), rows);
}

TEST_P(DrawnFolder, OnlyFilesThatAreAskedForAreRead) {
  const RunRecord run = read_sound_files(dir(), {run_folder::kEvents});
  EXPECT_EQ(run.events.size(), lines_.at(run_folder::kEvents).size());
  EXPECT_TRUE(run.captures.empty() && run.poses.empty() && run.scores.empty());
  EXPECT_TRUE(run.missing.empty()) << "the caller did not ask for scene.json";
}

TEST_P(DrawnFolder, DamagedFilesAreDistinguishedFromMissingOnes) {
  EXPECT_TRUE(damaged_files(dir()).empty()) << "scene.json is missing, but no file is damaged";
  write_text(dir() / run_folder::kTrajectories, "time_s,uav\n0.5,a\n");
  EXPECT_EQ(damaged_files(dir()).size(), 1U);
}

// A program writes the names of the columns at its start, so an empty table is one that was lost.
TEST_P(DrawnFolder, AnEmptyTableIsDamaged) {
  for (const std::string table : kTables) {
    write_text(dir() / table, heads_.at(table) + "\n");
    EXPECT_TRUE(damaged_files(dir()).empty()) << table << " without rows";
    write_text(dir() / table, "");
    EXPECT_TRUE(is_told(read_sound_run(dir()), table, 0)) << table;
    EXPECT_EQ(damaged_files(dir()).size(), 1U) << table;
    write(table);
  }
}

TEST_P(DrawnFolder, ColumnsThatEarlierVersionsDidNotWriteKeepTheirDefaults) {
  write_text(dir() / run_folder::kTrajectories, "time_s,uav,x,y,z\n0.5,a,1,2,3\n");
  for (const RunRecord& run : {read_run(dir()), read_sound_run(dir())}) {
    ASSERT_EQ(run.poses.size(), 1U);
    EXPECT_TRUE(run.poses[0].p_W.isApprox(Vector3d(1, 2, 3)));
    EXPECT_TRUE(run.poses[0].v_W.isZero());
    EXPECT_TRUE(run.poses[0].alive);
    EXPECT_FALSE(run.poses[0].clearance_m);
  }
}

TEST_P(DrawnFolder, WithoutAResultThereIsNoRun) {
  std::filesystem::remove(dir() / run_folder::kResult);
  EXPECT_THROW(read_sound_run(dir()), InputError);
  try {
    read_run(dir());
    ADD_FAILURE();
  } catch (const InputError&) {
    ADD_FAILURE() << "read_run() must not report this as the user's mistake";
  } catch (const std::runtime_error&) {
  }
}

INSTANTIATE_TEST_SUITE_P(Drawn, DrawnFolder, testing::Range(1U, 9U));

}  // namespace
}  // namespace skein::results
