// For `skein merge`: reads from the reports in a run's folder what the launcher would know of the run.
// Threads: any.
#pragma once

#include <filesystem>

#include "results/result.hpp"

namespace skein::results {

/// The facts that the programs report: the planner of each UAV, the DDS vendor of each program, and the programs that a
/// fault had killed or paused and that were not back when the run ended. The reports do not contain the earned score,
/// so `score_earned` is the delivered score. The caller adds scenario, seed and clock.
/// @param dir  the run's folder. @param reports  must include sim_server's.
RunFacts reported_facts(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
