// Scores over simulated time: median, least and greatest over the seeds of each planner. Pure; any thread.
#pragma once

#include <vector>

#include "cli/study/figures.hpp"

namespace skein::cli {

/// Scores of one planner in one scene, each at the times of curve_times().
struct ScoreCurve {
  std::size_t planner = 0;
  std::size_t flights = 0;  ///< flights whose score over time is known
  std::vector<double> median, least, greatest;
};

/// The times of all curves: equally spaced from 0 to the end of the study's longest flight [simulated s].
std::vector<double> curve_times(const Study& study);

/// Curves of the planners that have a flight with a known score over time in the scene. After the end of a flight its
/// score stays the same.
std::vector<ScoreCurve> score_curves(const Study& study, std::size_t scenario, const std::vector<double>& times_s);

}  // namespace skein::cli
