// What is known of a run of which only its folder is left, as `skein merge` finds it: its reports stand in for the
// launcher.
#pragma once

#include <filesystem>

#include "results/result.hpp"

namespace skein::results {

/// Who flew, with which DDS, what was earned, and who was out at the end. Scenario, seed and clock are the caller's.
/// @param dir  of the run. @param reports  with the server's.
RunFacts reported_facts(const std::filesystem::path& dir, const Scenario& scenario, const Reports& reports);

}  // namespace skein::results
