// Planner against planner: the differences of their scores and of other figures, seed by seed. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/figures.hpp"
#include "cli/study/statistics.hpp"

namespace skein::cli {

struct PlannerPair {
  std::string figure = "score";  ///< a column of flights.csv, or kDeviation
  std::size_t first = 0, second = 0;
  std::optional<std::size_t> scenario;  ///< none: totals, the sums over all scenes
  /// First less second, by seed, of the seeds with which both have flights that count.
  std::vector<std::pair<std::uint64_t, double>> differences;
  std::optional<double> median;      ///< none without a difference
  std::optional<Interval> interval;  ///< for the median; from kFewestPairs on
  std::optional<SignedRank> test;    ///< from kFewestPairs on
  /// Of the test, corrected for those of the same two planners and figure in all scenes; of totals, for all pairs.
  std::optional<double> p_holm;

  std::vector<double> values() const;
};

/// How far a score is from the planner's median in the scene, in percent of that: whose scores are spread wider.
inline constexpr const char* kDeviation = "score_deviation_percent";

/// All pairs in each scene, then, where there are several scenes, over all of them: sums of scores.
std::vector<PlannerPair> planner_pairs(const Study& study);
/// The same of what else is paired (columns.hpp), and of deviations; over all scenes their means.
std::vector<PlannerPair> other_pairs(const Study& study);

/// "0.031", "< 0.001"; none: an empty text.
std::string p_text(const std::optional<double>& p);

}  // namespace skein::cli
