// Deterministic statistics of small samples. Pure; any thread.
#pragma once

#include <optional>
#include <vector>

namespace skein::cli {

/// With fewer pairs, neither an interval nor a test is meaningful.
inline constexpr std::size_t kFewestPairs = 5;

struct Interval {
  double low = 0.0, high = 0.0;
};

/// 95 % confidence interval of the population's median: the middle 95 % of the medians of all samples that can be drawn
/// from this one with replacement. This is the percentile bootstrap (Efron and Tibshirani, An Introduction to the
/// Bootstrap, 1993, chapter 13), over all samples instead of some thousand random ones: the probability of each median
/// follows from binomials (Efron, Annals of Statistics 7, 1979, 1-26, section 3). The order of the values does not
/// matter. Takes about 20 n steps for n values. @param values  not empty.
Interval median_interval(std::vector<double> values);

struct SignedRank {
  std::size_t used = 0;  ///< differences other than 0
  double p = 1.0;        ///< two-sided
  bool exact = true;     ///< false: normal approximation, corrected for ties and continuity
};

/// Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945, 80-83). p is the probability that random signs distribute
/// the ranks of the differences between plus and minus at least as unevenly. As with Wilcoxon, zeros are left out.
/// Differences of equal size share their mean rank. p is exact, also with ties, for up to 100 differences.
SignedRank signed_rank_test(const std::vector<double>& differences);

/// The p values of a family of tests after Holm's correction (Scandinavian Journal of Statistics 6, 1979, 65-70), in
/// the same order. If corrected values below 5 % count as findings, at most 5 % of studies contain a false finding.
std::vector<double> holm(const std::vector<double>& p);

}  // namespace skein::cli
