// Scores of all planners in a fixed set of scenes, and how they moved since a table of them was written. What a change
// of the flights does to each planner is told in figures (docs/performance.md).   Pure; any thread.
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

/// Of the flights of a study that count, in their order.
std::vector<PlannerScore> planner_scores(const Study& study);

/// scene,planner,score,points,collisions,frozen_uavs
std::string planner_scores_csv(const std::vector<PlannerScore>& scores);
/// @throws InputError that names the file and the line which is no such row.
std::vector<PlannerScore> read_planner_scores(const std::filesystem::path& file);

/// A line a planner and kind of scene (all worlds of a family are one kind): sums over the scenes of both tables.
void print_planner_scores(std::ostream& out, const std::vector<PlannerScore>& before,
                          const std::vector<PlannerScore>& now);

}  // namespace skein::cli
