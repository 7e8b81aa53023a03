// Planner against planner: the differences of their scores, seed by seed. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/figures.hpp"
#include "cli/study/statistics.hpp"

namespace skein::cli {

struct PlannerPair {
  std::size_t first = 0, second = 0;
  std::optional<std::size_t> scenario;  ///< none: totals, the sums over all scenes
  /// First less second, by seed, of the seeds with which both have flights that count.
  std::vector<std::pair<std::uint64_t, double>> differences;
  std::optional<double> median;      ///< none without a difference
  std::optional<Interval> interval;  ///< for the median; from kFewestPairs on
  std::optional<SignedRank> test;    ///< from kFewestPairs on

  std::vector<double> values() const;
};

/// All pairs in each scene, then, where there are several scenes, over all of them.
std::vector<PlannerPair> planner_pairs(const Study& study);

/// "0.031", "< 0.001"; none: an empty text.
std::string p_text(const std::optional<SignedRank>& test);

}  // namespace skein::cli
