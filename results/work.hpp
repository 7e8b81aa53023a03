// How long UAVs were without work: joins the server's record of each second (sim_server/work/work_log.hpp) with the
// waits that agents report, and judges both (core/run/work_time.hpp). Simulated time.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/run/work_time.hpp"
#include "results/result.hpp"

namespace skein::results {

/// In fleet order; nullopt where the server recorded nothing of a UAV's work. Only reported waits are excused.
std::vector<std::optional<WorkTime>> work_times(const Scenario& scenario, const Reports& reports);

/// Writes work.csv into a run's folder: a line per UAV and whole second, whose end is `time_s` (docs/results.md).
/// @throws std::runtime_error when it cannot be written.
void write_work_csv(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
