// What the station leaves behind: score_timeline.csv, captures.csv (what became of every capture) and
// station.report.json, from which the launcher makes its part of result.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "process/status/status_pipe.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

struct StationNotes {
  std::uint64_t malformed = 0;              ///< samples received that were no message of their topic's type
  std::uint64_t unsent = 0;                 ///< samples that could not be sent
  std::string dds = {};                     ///< vendor
  std::vector<std::string> unwritten = {};  ///< what the disk has refused, one sentence each
};

/// Writes the three files into `folder`, each in one piece (never half a file).
///
/// score_timeline.csv: time_s, points, score; a line for each change.
/// captures.csv: uav, capture, tick, time_s, point, q_seen, q_blur, q_res, q_distance, q, delivered_at_s, reason; a
///   line for each point of each capture in the ledger. `reason` says why it does not count: "not received",
///   "refused: <why>", "uav collided", "better capture" (another one of this point counts); empty when it does.
/// station.report.json: a StationReport (process/reports/reports.hpp); score_earned is left out when no entry of the
///   ledger stands, points are those that count.
/// @param uav_names  in fleet order.
/// @param notes  what the station knows beside its tally; the report adds to `unwritten` which of the tables the disk
///   refuses.
/// @throws std::runtime_error as hand_in_report().
void write_station_report(const std::filesystem::path& folder, const Scoreboard& scoreboard,
                          const std::vector<std::string>& uav_names, StatusPipe& status, StationNotes notes = {});

}  // namespace skein::station
