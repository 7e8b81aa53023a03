// The rows of a run's tables, except digests.csv (diff.hpp) and tracking.csv (tracking_table.hpp). Only this code names
// columns, and decides whether an invalid row is an error or the end of its table. A member whose column does not exist
// in a table of an earlier version keeps its default, if it has one here.
// Frame W (ENU), metres, metres per second, simulated seconds and steps. docs/results.md describes the columns.
// Threads: any.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/messages/activity.hpp"
#include "core/types.hpp"
#include "results/csv_table.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::results {

/// Bound of plausible values [m, s, ...]: no run exceeds it, and a drawing of a larger number would be endless.
inline constexpr double kFarthest = 1e7;

// The function read() of each type reads the present row of its table. It throws std::runtime_error, with file and
// line, if a cell is invalid, or a number is beyond kFarthest.

/// One point of a capture in the referee's ledger, with its delivery as the station knew it at the end.
struct CaptureRow {
  static constexpr const char* kTable = run_folder::kCaptures;
  static CaptureRow read(const CsvTable& table);

  std::string uav;
  std::uint64_t capture = 0;
  double time_s = 0.0;
  std::size_t point = 0;
  double q = 0.0;
  std::optional<double> delivered_at_s = {};
  std::string reason = {};  ///< why it does not count; empty: it counts
  double q_blur = 0.0, q_res = 0.0, q_distance = 0.0;

  bool voided() const { return reason == run_tables::kUavCollided; }
};

/// One event that sim_server recorded; it takes effect in its step.
struct EventRow {
  static constexpr const char* kTable = run_folder::kEvents;
  static EventRow read(const CsvTable& table);

  std::uint64_t step = 0;
  std::string event;            ///< one of the events in run_tables.hpp
  std::string subject, object;  ///< of a link: sender, receiver; else: member, number of the capture
  double time_s = 0.0;          ///< of the step

  bool is_of_a_link() const { return event == run_tables::kLinkUp || event == run_tables::kLinkDown; }
  bool is_of_a_capture() const { return event == run_tables::kCaptured || event == run_tables::kReleased; }
  /// Number of the capture, if it is an event of a capture; read() refuses other texts there.
  std::uint64_t capture() const { return std::stoull(object); }
};

/// A message with capture reports that was lost or late on a link with faults.
struct MessageRow {
  static constexpr const char* kTable = run_folder::kCaptureMessages;
  static MessageRow read(const CsvTable& table);

  std::uint64_t step = 0;  ///< in which it was sent
  std::string uav;
  std::optional<std::uint64_t> arrives;  ///< step; nullopt: lost
};

/// Pose and velocity of a UAV, and the angles of its gimbal.
struct PoseRow {
  static constexpr const char* kTable = run_folder::kTrajectories;
  static PoseRow read(const CsvTable& table);

  double time_s = 0.0;
  std::string uav;
  Vector3d p_W;
  Vector3d v_W = Vector3d::Zero();
  bool alive = true;
  std::optional<double> clearance_m = {};  ///< to the structure
  std::optional<double> charge = {};       ///< of the battery, as a share of its capacity
  Quaterniond q_WB = Quaterniond::Identity();
  GimbalState gimbal = {};
};

/// The delivered score from a time on, and the number of points in it.
struct ScoreRow {
  static constexpr const char* kTable = run_folder::kScoreTimeline;
  static ScoreRow read(const CsvTable& table);

  double time_s = 0.0, score = 0.0, points = 0.0;
};

/// An interest point.
struct PointRow {
  static constexpr const char* kTable = run_folder::kScore;
  static PointRow read(const CsvTable& table);

  Vector3d p_W = Vector3d::Zero(), normal_W = Vector3d::Zero();
  double score = 0.0;
};

/// The loss of a point: by how much it scored less than its estimate, and why.
struct LossRow {
  static constexpr const char* kTable = run_folder::kLosses;
  static LossRow read(const CsvTable& table);

  std::size_t point = 0;  ///< index in score.csv
  double estimate = 0.0, loss = 0.0;
  std::string cause;  ///< a key of causes.hpp, or "none"
};

/// How long a UAV had been without work, at the end of a second.
struct WorkRow {
  static constexpr const char* kTable = run_folder::kWork;
  static WorkRow read(const CsvTable& table);

  double time_s = 0.0;
  std::string uav;
  double without_work_s = 0.0;
};

/// What a UAV did from this time on, as its agent reported: all of an Activity but its numbers.
struct ActivityRow {
  static constexpr const char* kTable = run_folder::kActivity;
  static ActivityRow read(const CsvTable& table);

  double time_s = 0.0;
  std::string uav;
  Activity activity = {};
};

/// Calls `on_row` with each row of the table of `Row`; a missing table has no rows.
/// @throws std::runtime_error, with file and line, at an invalid row, and what `on_row` throws.
template <class Row, class OnRow>
void each_row(const std::filesystem::path& dir, const OnRow& on_row) {
  for (CsvTable table(dir / Row::kTable); table.next();) on_row(Row::read(table));
}

/// The rows of a table. @throws like each_row()
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& dir) {
  std::vector<Row> rows;
  each_row<Row>(dir, [&](Row row) { rows.push_back(std::move(row)); });
  return rows;
}

/// The sentences that each_sound_row() adds to `missing`.
inline constexpr const char* kThereIsNo = "There is no ";  ///< begins that of a missing file
std::string no_file(const char* file);
std::string damaged_table(const std::filesystem::path& dir, const char* table, std::size_t rows, const char* what);

/// Like each_row(), but stops at the first row that is invalid or for which `on_row` throws. Adds a sentence to
/// `missing` if this happens, or if the table is missing or has not even the names of its columns.
template <class Row, class OnRow>
void each_sound_row(const std::filesystem::path& dir, std::vector<std::string>& missing, const OnRow& on_row) {
  std::size_t rows = 0;
  try {
    const std::filesystem::path table = dir / Row::kTable;
    if (!std::filesystem::exists(table)) return missing.push_back(no_file(Row::kTable));
    if (std::filesystem::is_regular_file(table) && std::filesystem::file_size(table) == 0) {
      throw std::runtime_error("the file is empty: the line with the names of the columns is missing");
    }
    each_row<Row>(dir, [&](Row row) {
      on_row(std::move(row));
      ++rows;
    });
  } catch (const std::exception& error) {
    missing.push_back(damaged_table(dir, Row::kTable, rows, error.what()));
  }
}

}  // namespace skein::results
