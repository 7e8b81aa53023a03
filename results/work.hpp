// Computes how long UAVs were without work, from sim_server's record of each second (sim_server/work/work_log.hpp) and
// the waits that agents report, by the rules of core/run/work_time.hpp. Simulated time.
// Threads: any, but one for each folder.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/run/work_time.hpp"
#include "results/result.hpp"

namespace skein::results {

/// In fleet order; nullopt: sim_server recorded nothing of the UAV's work. Excuses only waits that an agent reported.
std::vector<std::optional<WorkTime>> work_times(const Scenario& scenario, const Reports& reports);

/// Writes work.csv into a run's folder: a line per UAV and whole second; `time_s` is its end (docs/results.md).
/// @throws std::runtime_error if the file cannot be written.
void write_work_csv(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
