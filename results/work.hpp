// How long UAVs went without work: the server's record of each second (sim_server/work/work_log.hpp) beside what agents
// say of their waiting, judged (core/run/work_time.hpp). Simulated time.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/run/work_time.hpp"
#include "results/result.hpp"

namespace skein::results {

/// In fleet order; nullopt where the server told nothing of a UAV's work. Of waits that no agent reports nobody knows.
std::vector<std::optional<WorkTime>> work_times(const Scenario& scenario, const Reports& reports);

/// Writes work.csv into a run's folder: a line a UAV and whole second, `time_s` being its end (docs/results.md).
/// @throws std::runtime_error when it cannot be written.
void write_work_csv(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
