// A finished run, read for judging it: result.json and the rows of the tables beside it (run_rows.hpp), with names and
// steps as the tables have them. What makes no sense is an error here; who shows what is there reads run_data.hpp.
// Times in simulated seconds and steps.
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

/// One point of a capture in the ledger, as the station saw it in the end (captures.csv).
struct CaptureRow {
  std::string uav;
  std::uint64_t capture = 0;
  double time_s = 0.0;
  int point = 0;
  double q = 0.0;
  std::optional<double> delivered_at_s;
  std::string reason;  ///< why it does not count; empty when it does
  double q_blur = 0.0, q_res = 0.0, q_distance = 0.0;

  bool voided() const { return reason == run_tables::kUavCollided; }
};

/// One event as the server saw it (events.csv), in force from its step on.
struct EventRow {
  std::uint64_t step = 0;
  std::string event;            ///< link_up, link_down, joined, left, captured, released
  std::string subject, object;  ///< of a link: from, to; else the member, and the capture's number
};

/// A message with capture reports that was lost or late on a link with faults (capture_messages.csv).
struct MessageRow {
  std::uint64_t step = 0;  ///< in which it was sent
  std::string uav;
  std::optional<std::uint64_t> arrives;  ///< step; none: lost
};

/// Where a UAV was (trajectories.csv).
struct PositionRow {
  double time_s = 0.0;
  std::string uav;
  Vector3d p_W;
  Vector3d v_W = Vector3d::Zero();
  bool alive = true;
  std::optional<double> clearance_m = {};  ///< to the structure
};

/// The delivered score from this time on, and of how many points (score_timeline.csv).
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

/// captures.csv of a run. @throws std::runtime_error when a row makes no sense.
std::vector<CaptureRow> read_captures(const std::filesystem::path& dir);

/// A file that a program left out because it died is read as empty.
/// @throws std::runtime_error when there is no result.json or a row makes no sense: the fault of the run, not of the
/// user.
RunRecord read_run(const std::filesystem::path& dir);

}  // namespace skein::results
