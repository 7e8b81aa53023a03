// Scores over time: how far each planner was at which time, over its seeds. Pure; any thread.
#pragma once

#include <vector>

#include "cli/study/figures.hpp"

namespace skein::cli {

/// One planner in one scene, at the times of the study's grid.
struct ScoreCurve {
  std::size_t planner = 0;
  std::size_t flights = 0;  ///< with a known score over time
  std::vector<double> median, least, greatest;
};

/// Times that all scenes share: from 0 to the end of the longest flight, simulated seconds.
std::vector<double> curve_times(const Study& study);

/// Of planners with such a flight in the scene. A flight that is over keeps its score.
std::vector<ScoreCurve> score_curves(const Study& study, std::size_t scenario, const std::vector<double>& times_s);

}  // namespace skein::cli
