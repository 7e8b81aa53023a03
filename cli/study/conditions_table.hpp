// Table of how conditions (docs/conditions.md) change the results of planners. Pure.
#pragma once

#include <iosfwd>

#include "cli/study/figures.hpp"

namespace skein::cli {

/// Prints two Markdown tables with a row for each set of conditions and planner. The first has flights, median share of
/// the estimate over all scenes and seeds [%], this median relative to that under the first conditions [%], collisions,
/// and those of UAVs with an empty battery. The second has the score lost to each cause, as a share of the sum of all
/// estimates [%], over the flights whose losses are known; its last columns split `below_threshold` by part. Prints
/// nothing if the study names no conditions.
void print_conditions(std::ostream& out, const Study& study);

}  // namespace skein::cli
