// What a study reads of each flight beside its result: the score over time, and how captures reached the station.
#pragma once

#include <filesystem>
#include <vector>

#include "report/figures.hpp"

namespace skein::cli {

struct FlightTables {
  std::vector<results::RunScore> scores;   ///< whenever it changed; empty: not known
  double end_s = 0.0;                      ///< of the simulated time
  std::vector<report::Latency> latencies;  ///< by UAV, of captures that improved a point; empty: not known

  /// At a time; 0 before the first change. Scores must be known.
  double score_at(double time_s) const;
};

/// A table that is missing gives nothing, one that is damaged what is whole of it. Never throws.
FlightTables read_flight_tables(const std::filesystem::path& dir);

}  // namespace skein::cli
