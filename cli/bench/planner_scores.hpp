// Scores of all planners in a fixed set of scenes, and how they have changed since a table of them was written: the
// effect of a code change on each planner, in figures (docs/performance.md).   Pure, except for reading; any thread.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cli/study/figures.hpp"

namespace skein::cli {

struct PlannerScore {
  std::string scene;  ///< "towers", "wild 3": as a study names it
  std::string planner;
  double score = 0.0;
  int points = 0, collisions = 0, frozen_uavs = 0;
};

/// Scores of the flights of a study that have figures, in the order of the flights.
std::vector<PlannerScore> planner_scores(const Study& study);

/// A table with the header scene,planner,score,points,collisions,frozen_uavs.
std::string planner_scores_csv(const std::vector<PlannerScore>& scores);
/// Reads such a table. @throws InputError that names the file, and the line of an invalid row.
std::vector<PlannerScore> read_planner_scores(const std::filesystem::path& file);

/// Prints a line for each planner and kind of scene (all worlds of a family are one kind): sums over the scenes that
/// are in both tables, and the number of those that only one table has.
void print_planner_scores(std::ostream& out, const std::vector<PlannerScore>& before,
                          const std::vector<PlannerScore>& now);

}  // namespace skein::cli
