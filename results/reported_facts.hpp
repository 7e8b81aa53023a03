// Reconstructs what the launcher would know of a run from the reports in its folder, for `skein merge`.   Threads: any.
#pragma once

#include <filesystem>

#include "results/result.hpp"

namespace skein::results {

/// The facts that programs report: UAVs and their planners, DDS vendors, and the programs that a fault kept out at the
/// end. The delivered score replaces the unknown earned score. The caller adds scenario, seed and clock.
/// @param dir  the run's folder. @param reports  must include sim_server's.
RunFacts reported_facts(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
