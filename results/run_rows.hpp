// Typed access to the rows of a run's tables, except digests.csv (diff.hpp) and tracking.csv (tracking_table.hpp). This
// is the one place where readers name columns and go on or stop at an invalid row. A cell is parsed when a reader asks
// for it, so that tables of an earlier version may lack columns that a reader does not use.
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

/// The present row of a table; valid until the table goes to the next one. Access to an invalid or missing cell throws
/// std::runtime_error, with file and line.
class RunRow {
 public:
  explicit RunRow(const CsvTable& table) : table_(table) {}

 protected:
  Vector3d vector(const char* x, const char* y, const char* z) const;

  const CsvTable& table_;
};

/// One point of a capture in the referee's ledger, with its delivery as the station knew it at the end.
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
  const std::string& reason() const;  ///< why it does not count; empty: it counts
};

/// One event that sim_server recorded; it takes effect in its step.
class EventCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kEvents;
  using RunRow::RunRow;
  std::uint64_t step() const;
  double time_s() const;
  const std::string& event() const;  ///< one of the events in run_tables.hpp
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
  std::optional<std::uint64_t> arrives() const;  ///< step; nullopt: lost
};

/// Pose and velocity of a UAV, and the angles of its gimbal.
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
  bool alive() const;               ///< true unless the cell is "0"
  bool alive_beyond_doubt() const;  ///< throws if the cell is not a number
  std::optional<double> clearance_m() const;
  std::optional<double> charge() const;
};

/// The delivered score from a time on, and the number of points in it.
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

/// The loss of a point: by how much it scored less than its estimate, and why.
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

/// What a UAV did, as its agent reported.
class ActivityCells : public RunRow {
 public:
  static constexpr const char* kTable = run_folder::kActivity;
  using RunRow::RunRow;
  double time_s() const;
  const std::string& uav() const;
  Activity activity() const;
};

/// Calls `on_row` with each row of the table that `Row` reads; a missing table has no rows.
/// @throws what `on_row` throws: std::runtime_error, with file and line, for an invalid cell.
template <class Row, class OnRow>
void each_row(const std::filesystem::path& dir, const OnRow& on_row) {
  for (CsvTable table(dir / Row::kTable); table.next();) on_row(Row(table));
}

/// The sentences that each_sound_row() adds to `missing`.
std::string no_file(const char* file);
std::string damaged_table(const std::filesystem::path& dir, const char* table, std::size_t rows, const char* what);

/// The same, but stops at the first row for which `on_row` throws. Adds a sentence to `missing` if this happens or the
/// table is missing.
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
