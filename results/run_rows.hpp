// Rows of a run's tables. Whoever reads a table reads it here: this is the one place where readers name columns, and
// where they go on or stop at a row that makes no sense. The parts of a row are parsed when they are asked for, so that
// each reader needs the columns that it uses, and no others: tables of an earlier version may lack them.
// Frame W (ENU), metres, simulated seconds. docs/results.md describes the columns.   Threads: any.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/activity.hpp"
#include "core/types.hpp"
#include "results/csv_table.hpp"
#include "results/run_folder.hpp"

namespace skein::results {

/// A row while its table is at it. Its parts throw std::runtime_error naming file and line where they make no sense.
class RunRow {
 public:
  explicit RunRow(const CsvTable& table) : table_(table) {}

 protected:
  Vector3d vector(const char* x, const char* y, const char* z) const;

  const CsvTable& table_;
};

/// One point of a capture in the ledger, as the station saw it in the end.
class CaptureCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kCaptures;
  using RunRow::RunRow;
  const std::string& uav() const;
  std::uint64_t capture() const;
  double time_s() const;
  std::uint64_t point() const;
  double q() const;
  double q_blur() const;
  double q_res() const;
  double q_distance() const;
  std::optional<double> delivered_at_s() const;
  const std::string& reason() const;  ///< why it does not count; empty when it does
};

/// One event as the server saw it, in force from its step on.
class EventCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kEvents;
  using RunRow::RunRow;
  std::uint64_t step() const;
  double time_s() const;
  const std::string& event() const;  ///< a word of run_tables.hpp
  const std::string& subject() const;
  const std::string& object() const;
};

/// A message with capture reports that was lost or late on a link with faults.
class MessageCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kCaptureMessages;
  using RunRow::RunRow;
  std::uint64_t step() const;
  const std::string& uav() const;
  std::optional<std::uint64_t> arrives() const;
};

/// Where a UAV was, and where its camera looked.
class PoseCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kTrajectories;
  using RunRow::RunRow;
  double time_s() const;
  const std::string& uav() const;
  Vector3d p_W() const;
  Quaterniond q_WB() const;
  Vector3d v_W() const;
  GimbalState gimbal() const;
  bool alive() const;  ///< in doubt it is
  bool alive_beyond_doubt() const;
  std::optional<double> clearance_m() const;
};

/// The delivered score from a time on, and of how many points.
class ScoreCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kScoreTimeline;
  using RunRow::RunRow;
  double time_s() const;
  double points() const;
  double score() const;
};

/// An interest point.
class PointCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kScore;
  using RunRow::RunRow;
  Vector3d p_W() const;
  Vector3d normal_W() const;
  double score() const;
};

/// What a point scored less than it could, and why.
class LossCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kLosses;
  using RunRow::RunRow;
  std::uint64_t index() const;  ///< of the point in score.csv
  double estimate() const;
  double loss() const;
  const std::string& cause() const;  ///< a key of causes.hpp, or "none"
};

/// How long a UAV had been without work, at the end of a second.
class WorkCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kWork;
  using RunRow::RunRow;
  double time_s() const;
  const std::string& uav() const;
  double without_work_s() const;
};

/// What a UAV did, as its program said.
class ActivityCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kActivity;
  using RunRow::RunRow;
  double time_s() const;
  const std::string& uav() const;
  Activity activity() const;
};

/// Calls `on_row` with each row of a table, by its class; a table that is not there has none.
/// @throws std::runtime_error naming file and line at a row that makes no sense.
template <class Row, class OnRow>
void each_row(const std::filesystem::path& dir, const OnRow& on_row) {
  for (CsvTable table(dir / Row::kTable); table.next();) on_row(Row(table));
}

/// The sentences of each_sound_row().
std::string no_file(const char* file);
std::string damaged_table(const std::filesystem::path& dir, const char* table, std::size_t rows, const char* what);

/// The same as far as rows make sense, which `on_row` may judge, too, by throwing. What is not there, or is damaged, is
/// told of in a sentence.
template <class Row, class OnRow>
void each_sound_row(const std::filesystem::path& dir, std::vector<std::string>& missing, const OnRow& on_row) {
  std::size_t rows = 0;
  try {
    if (!std::filesystem::exists(dir / Row::kTable)) return missing.push_back(no_file(Row::kTable));
    each_row<Row>(dir, [&](const Row& row) {
      on_row(row);
      ++rows;
    });
  } catch (const std::exception& error) {
    missing.push_back(damaged_table(dir, Row::kTable, rows, error.what()));
  }
}

}  // namespace skein::results
