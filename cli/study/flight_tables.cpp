#include "cli/study/flight_tables.hpp"

#include <algorithm>

#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

double FlightTables::score_at(double time_s) const {
  const auto after =
      std::upper_bound(scores.begin(), scores.end(), time_s,
                       [](double time, const results::ScoreRow& change) { return time < change.time_s; });
  return after == scores.begin() ? 0.0 : std::prev(after)->score;
}

FlightTables read_flight_tables(const std::filesystem::path& dir) try {
  results::RunRecord run = results::read_sound_files(dir, {run_folder::kCaptures, run_folder::kScoreTimeline});
  FlightTables tables{std::move(run.scores), run.end_s, {}};
  if (std::filesystem::exists(dir / run_folder::kCaptures)) tables.latencies = report::latency_by_uav(run);
  return tables;
} catch (const InputError&) {  // there is no result
  return {};
}

}  // namespace skein::cli
