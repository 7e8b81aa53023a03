// Summary of a study over many generated scenes: how planners perform in unseen worlds, and the worst flights with the
// commands that repeat them. Pure.
#pragma once

#include <iosfwd>
#include <vector>

#include "cli/study/figures.hpp"
#include "cli/study/requirement.hpp"

namespace skein::cli {

/// The `most` worst flights, worst first: failed flights, then those with the most collisions, then the most frozen
/// UAVs, then the least share of the estimate. Flights that are not over are left out.
std::vector<const FlightEntry*> worst_flights(const Study& study, std::size_t most);

/// Prints for each planner its flights, its share of the estimate (median, tenth percentile, least) [%], flights with a
/// frozen UAV, idle and waiting time of all UAVs [s], and collisions; then the ten worst flights.
void print_worlds(std::ostream& out, const Study& study);

/// Prints each flight that does not meet a requirement, with its command. @returns whether all flights that are over
/// meet all.
bool print_requirements(std::ostream& out, const Study& study, const std::vector<Requirement>& requirements);

}  // namespace skein::cli
