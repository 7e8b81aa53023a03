// What the station leaves behind: score_timeline.csv, captures.csv (what became of every capture) and
// station.report.json, from which the launcher makes its part of result.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "process/status_pipe.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

/// Writes the three files into `folder`, each in one piece (never half a file).
///
/// score_timeline.csv: time_s, points, score; a line for each change.
/// captures.csv: uav, capture, tick, time_s, point, q_seen, q_blur, q_res, q_distance, q, delivered_at_s, reason; a
///   line for each point of each capture in the ledger. `reason` says why it does not count: "not received",
///   "refused: <why>", "uav collided", "better capture" (another one of this point counts); empty when it does.
/// station.report.json: a StationReport (process/reports.hpp); score_earned is left out when no entry of the ledger
///   stands, points are those that count.
/// @param uav_names  in fleet order.
/// @param malformed  samples received that were no message of their topic's type.
/// @param unwritten  what the disk has refused before; the report lists it, and which of the tables it refuses.
/// @throws std::runtime_error as hand_in_report().
void write_station_report(const std::filesystem::path& folder, const Scoreboard& scoreboard,
                          const std::vector<std::string>& uav_names, StatusPipe& status, std::uint64_t malformed = 0,
                          std::vector<std::string> unwritten = {});

}  // namespace skein::station
