// The tables of a flight that a study reads: the score over time, and the delays of captures to the station.
#pragma once

#include <filesystem>
#include <vector>

#include "report/figures.hpp"

namespace skein::cli {

struct FlightTables {
  std::vector<results::ScoreRow> scores;   ///< at each change; empty: not known
  double end_s = 0.0;                      ///< end of the flight [simulated s]
  std::vector<report::Latency> latencies;  ///< by UAV, of captures that improved a point; empty: not known

  /// Score at a simulated time; 0 before the first change, and if the scores are not known.
  double score_at(double time_s) const;
};

/// Reads the tables of a results folder. A missing table counts as empty, a damaged one ends before the damage.
/// Never throws for damage; without a valid result.json, everything is empty.
FlightTables read_flight_tables(const std::filesystem::path& dir);

}  // namespace skein::cli
