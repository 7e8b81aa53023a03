// Statistics of small samples, all of them deterministic. Pure; any thread.
#pragma once

#include <optional>
#include <vector>

namespace skein::cli {

/// Below this many pairs no interval and no test says anything.
inline constexpr std::size_t kFewestPairs = 5;

struct Interval {
  double low = 0.0, high = 0.0;
};

/// Where the median of what was sampled is to be looked for: the middle 95 % of the medians of all samples that can be
/// drawn from this one with replacement. That is the percentile bootstrap (Efron and Tibshirani, An Introduction to the
/// Bootstrap, 1993, chapter 13), of all samples instead of some thousand drawn ones: how often each median occurs is
/// known from binomials (Efron, Annals of Statistics 7, 1979, 1-26, section 3). The same values give the same interval,
/// in any order. Of n values it takes about 20 n steps.  @param values  not empty.
Interval median_interval(std::vector<double> values);

struct SignedRank {
  std::size_t used = 0;  ///< differences other than 0
  double p = 1.0;        ///< of both sides
  bool exact = true;     ///< or by the normal approximation, with correction for ties and continuity
};

/// Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945, 80-83): how likely ranks of differences are shared at
/// least as unevenly between the signs, if each sign is a coin's. Zeros are left out as Wilcoxon does; equal
/// sizes share their ranks, and p is exact with these too, up to 100 differences.
SignedRank signed_rank_test(const std::vector<double>& differences);

/// The same p after Holm's correction for all tests of a family (Scandinavian Journal of Statistics 6, 1979, 65-70):
/// who takes what is below 5 % of these for a finding is wrong about any of them in at most 5 % of studies.
std::vector<double> holm(const std::vector<double>& p);

}  // namespace skein::cli
