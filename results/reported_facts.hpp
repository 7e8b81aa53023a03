// What is known of a run of which only its folder is left, as `skein merge` finds it: its reports stand in for the
// launcher.
#pragma once

#include <filesystem>

#include "results/result.hpp"

namespace skein::results {

/// The facts that programs report: the UAVs and their planners, the DDS vendors, the score earned, and who was out at
/// the end. The caller adds scenario, seed and clock.
/// @param dir  of the run. @param reports  with the server's.
RunFacts reported_facts(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
