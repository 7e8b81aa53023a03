// Writes the station's result files: score_timeline.csv, captures.csv (the fate of every capture) and
// station.report.json, from which the launcher fills the station's part of result.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "process/status/status_pipe.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

struct StationNotes {
  std::uint64_t malformed = 0;              ///< number of samples that could not be read as their topic's type
  std::uint64_t unsent = 0;                 ///< number of samples that could not be sent
  std::string dds = {};                     ///< DDS vendor
  std::vector<std::string> unwritten = {};  ///< files that could not be written, and why: one sentence each
};

/// Writes the three files into `folder`, each atomically (never half a file).
///
/// score_timeline.csv: time_s, points, score; one line per change.
/// captures.csv: uav, capture, tick, time_s, point, q_seen, q_blur, q_res, q_distance, q, delivered_at_s, reason; a
///   line per point of each capture in the ledger. `reason` says why this point of it does not count: "not received",
///   "refused: <why>", "uav collided", "better capture" (another capture of the point counts); empty: it counts.
/// station.report.json: a StationReport (process/reports/reports.hpp); score_earned is left out when the ledger has
///   entries but none of them stands; `points` has the points that count.
/// @param uav_names  in fleet order.
/// @param notes  facts for the report that are not in the scoreboard; a table that cannot be written is added to
///   `unwritten` instead of throwing.
/// @throws std::runtime_error under the same conditions as hand_in_report().
void write_station_report(const std::filesystem::path& folder, const Scoreboard& scoreboard,
                          const std::vector<std::string>& uav_names, StatusPipe& status, StationNotes notes = {});

}  // namespace skein::station
