// Reads a finished run to judge it: result.json and the rows of the tables beside it (run_rows.hpp), with names and
// steps as in the tables. An invalid row is an error; run_data.hpp reads damaged runs, too, to show them.
// Frame W (ENU), metres, metres per second, simulated seconds and steps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "process/json_text.hpp"
#include "results/run_tables.hpp"

namespace skein::results {

/// One point of a capture in the referee's ledger, with its delivery as the station knew it at the end (captures.csv).
struct CaptureRow {
  std::string uav;
  std::uint64_t capture = 0;
  double time_s = 0.0;
  int point = 0;
  double q = 0.0;
  std::optional<double> delivered_at_s;
  std::string reason;  ///< why it does not count; empty: it counts
  double q_blur = 0.0, q_res = 0.0, q_distance = 0.0;

  bool voided() const { return reason == run_tables::kUavCollided; }
};

/// One event that sim_server recorded (events.csv); it takes effect in its step.
struct EventRow {
  std::uint64_t step = 0;
  std::string event;            ///< link_up, link_down, joined, left, captured, released
  std::string subject, object;  ///< of a link: sender, receiver; else: member, number of the capture
};

/// A message with capture reports that was lost or late on a link with faults (capture_messages.csv).
struct MessageRow {
  std::uint64_t step = 0;  ///< in which it was sent
  std::string uav;
  std::optional<std::uint64_t> arrives;  ///< step; nullopt: lost
};

/// Position and velocity of a UAV (trajectories.csv).
struct PositionRow {
  double time_s = 0.0;
  std::string uav;
  Vector3d p_W;
  Vector3d v_W = Vector3d::Zero();
  bool alive = true;
  std::optional<double> clearance_m = {};  ///< to the structure
  std::optional<double> charge = {};       ///< of the battery, as a share of its capacity
};

/// The delivered score from this time on, and the number of points in it (score_timeline.csv).
struct ScoreRow {
  double time_s = 0.0, score = 0.0, points = 0.0;
};

/// How long a UAV had been without work, at the end of a second (work.csv).
struct WorkRow {
  double time_s = 0.0;
  std::string uav;
  double without_work_s = 0.0;
};

struct RunRecord {
  std::filesystem::path dir;
  Json result;
  std::vector<CaptureRow> captures;    ///< in the ledger's order
  std::vector<EventRow> events;        ///< by step
  std::vector<MessageRow> messages;    ///< by step
  std::vector<PositionRow> positions;  ///< by time
  std::vector<ScoreRow> scores;        ///< by time
  std::vector<WorkRow> work;           ///< by time
};

/// Reads captures.csv of a run. @throws std::runtime_error if a row is invalid.
std::vector<CaptureRow> read_captures(const std::filesystem::path& dir);

/// Reads a run. A missing table counts as empty, since its program may have died.
/// @throws std::runtime_error if result.json is missing or damaged, or a row is invalid. It is no InputError, because
///   the run is wrong, not the user's input.
RunRecord read_run(const std::filesystem::path& dir);

}  // namespace skein::results
