// Compares planners in pairs: the differences of their scores and other figures, seed by seed. Pure; any thread.
#pragma once

#include <iosfwd>
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
  std::optional<std::size_t> scenario;  ///< nullopt: over all scenes, sums of scores or means of others
  /// Value of `first` minus value of `second`, for each seed with which both have a value.
  std::vector<std::pair<std::uint64_t, double>> differences;
  std::optional<double> median;      ///< nullopt: there is no difference
  std::optional<Interval> interval;  ///< for the median; nullopt below kFewestPairs
  std::optional<SignedRank> test;    ///< nullopt below kFewestPairs
  /// p of the test after Holm's correction for all tests of the same figure and the same two planners in single scenes;
  /// without `scenario`, for those of the same figure and all pairs over all scenes.
  std::optional<double> p_holm;

  std::vector<double> values() const;
};

/// Figure: distance of a score from the planner's median score in the scene, in percent of that median. The greater it
/// is, the more widely the scores are spread.
inline constexpr const char* kDeviation = "score_deviation_percent";

/// Scores of all pairs in each scene; then, if there are several scenes, sums of scores over all scenes.
std::vector<PlannerPair> planner_pairs(const Study& study);
/// The same for the columns that are `paired` (columns.hpp) and for kDeviation; over all scenes, means.
std::vector<PlannerPair> other_pairs(const Study& study);

/// Prints the differences of scores: a row for each of the `pairs` (of planner_pairs()) or, if these are many, only for
/// those over all scenes. If no pair has enough seeds for a significant difference, a last line says so.
void print_pairs(std::ostream& out, const Study& study, const std::vector<PlannerPair>& pairs);

/// "0.031", "< 0.001"; nullopt: an empty text.
std::string p_text(const std::optional<double>& p);

}  // namespace skein::cli
