// A study over many scenes of one family: how planners do in worlds that nobody has seen, and the worst flights with
// the commands that repeat them. Pure.
#pragma once

#include <iosfwd>
#include <vector>

#include "cli/study/figures.hpp"
#include "cli/study/requirement.hpp"

namespace skein::cli {

/// The worst flights first: those that failed, then by collisions, by UAVs that froze, and by their share of the
/// estimate, the least first.
std::vector<const FlightEntry*> worst_flights(const Study& study, std::size_t most);

/// Each planner's share of the estimate over all scenes (median, tenth percentile, least), flights in which anybody
/// froze, and collisions; then the ten worst flights.
void print_worlds(std::ostream& out, const Study& study);

/// A line for each flight that does not keep a requirement. @returns whether there is none.
bool print_requirements(std::ostream& out, const Study& study, const std::vector<Requirement>& requirements);

}  // namespace skein::cli
