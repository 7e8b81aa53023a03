#include "cli/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skein::cli {
namespace {

constexpr std::size_t kMostExact = 100;
constexpr double kTail = 0.025;   ///< share of the medians beyond either end of an interval
constexpr double kReach = 3.0;    ///< greatest distance from the middle rank, times sqrt(n): 6 standard deviations
constexpr double kLeast = 1e-12;  ///< lesser shares are neglected

/// A possible median, and the share of samples that have it.
struct Median {
  double value = 0.0, share = 0.0;
};

/// Distribution of the medians of all samples drawn with replacement from n sorted values. If n = 2 m, the median is
/// the mean of the sample's order statistics m and m + 1; if n is odd, it is the middle order statistic.
class MedianSamples {
 public:
  explicit MedianSamples(const std::vector<double>& sorted)
      : values_(sorted), n_(sorted.size()), middle_((n_ + 1) / 2), log_ways_(log_choices(n_, middle_)) {
    const double reach = kReach * std::sqrt(static_cast<double>(n_));
    const auto wide = static_cast<std::size_t>(reach) + 1;
    first_ = middle_ > wide ? middle_ - wide : 1;
    last_ = std::min(middle_ + wide, n_);
  }

  std::vector<Median> all() const {
    std::vector<Median> medians;
    const auto add = [&](std::size_t i, std::size_t j, double share) {
      if (share > kLeast) medians.push_back({0.5 * (values_[i - 1] + values_[j - 1]), share});
    };
    double below = middle_or_more(first_ - 1);
    for (std::size_t i = first_; i <= last_; ++i) {
      const double until = middle_or_more(i);
      double same = until - below;  // the middle order statistic is value i
      below = until;
      for (std::size_t j = i + 1; n_ % 2 == 0 && j <= last_; ++j) {
        const double share = std::exp(log_ways_ + log_just(i) + log_just(n_ + 1 - j));
        add(i, j, share);
        same -= share;
      }
      add(i, i, same);
    }
    return medians;
  }

 private:
  static double log_choices(std::size_t n, std::size_t k) {
    double sum = 0.0;
    for (std::size_t i = 1; i <= k; ++i) sum += std::log(static_cast<double>(n - k + i) / static_cast<double>(i));
    return sum;
  }

  /// Logarithm of the probability that `middle_` draws are all among the first i values, but not all among the first
  /// i - 1. The same for the last i values, counted from the end.
  double log_just(std::size_t i) const {
    const auto m = static_cast<double>(middle_), at = static_cast<double>(i);
    return m * std::log(at / static_cast<double>(n_)) + std::log(-std::expm1(m * std::log1p(-1.0 / at)));
  }

  /// Share of samples with at least `middle_` draws among the first i values: the upper tail of a binomial.
  double middle_or_more(std::size_t i) const {
    if (i == 0) return 0.0;
    if (i == n_) return 1.0;
    const double p = static_cast<double>(i) / static_cast<double>(n_), odds = p / (1.0 - p);
    const auto n = static_cast<double>(n_);
    double draws = static_cast<double>(middle_);
    double term = std::exp(log_ways_ + draws * std::log(p) + (n - draws) * std::log1p(-p)), share = 0.0;
    for (; draws <= n && (term > kLeast * share || draws < n * p); ++draws) {
      share += term;
      term *= odds * (n - draws) / (draws + 1.0);
    }
    return share;
  }

  const std::vector<double>& values_;
  std::size_t n_, middle_;    ///< middle_: rank of the lower middle order statistic, from 1
  double log_ways_;           ///< log of the number of ways to choose middle_ of n
  std::size_t first_, last_;  ///< values, from 1, whose share is not negligible
};

/// Size and sign of a difference, and twice its rank: equal sizes share their mean rank, which may end in .5.
struct Ranked {
  double size = 0.0;
  bool positive = false;
  std::size_t twice_rank = 0;
};

std::vector<Ranked> ranked(const std::vector<double>& differences) {
  std::vector<Ranked> all;
  for (const double difference : differences) {
    if (difference != 0.0) all.push_back({std::abs(difference), difference > 0.0, 0});
  }
  std::ranges::sort(all, {}, &Ranked::size);
  for (std::size_t from = 0, until = 0; from < all.size(); from = until) {
    while (until < all.size() && all[until].size == all[from].size) ++until;
    for (std::size_t i = from; i < until; ++i) all[i].twice_rank = from + until + 1;  // ranks count from 1
  }
  return all;
}

/// Share of all assignments of signs for which the sum of positive ranks is at most `least`. @param least, whole  twice
/// the sums of ranks; whole: of all.
double share_up_to(const std::vector<Ranked>& all, std::size_t least, std::size_t whole) {
  std::vector<double> shares(whole + 1, 0.0);
  shares[0] = 1.0;
  std::size_t reach = 0;
  for (const Ranked& one : all) {
    reach += one.twice_rank;
    for (std::size_t sum = reach + 1; sum-- > 0;) {
      shares[sum] = 0.5 * (shares[sum] + (sum >= one.twice_rank ? shares[sum - one.twice_rank] : 0.0));
    }
  }
  double share = 0.0;
  for (std::size_t sum = 0; sum <= least; ++sum) share += shares[sum];
  return share;
}

/// Two-sided p of the normal approximation, corrected for ties and continuity.
/// @param positive, whole  twice the sums of ranks
double normal_p(const std::vector<Ranked>& all, std::size_t positive, std::size_t whole) {
  double variance = 0.0;  // a quarter of the sum of squared ranks, also with ties
  for (const Ranked& one : all) variance += std::pow(0.5 * static_cast<double>(one.twice_rank), 2) / 4.0;
  const double off = std::abs(0.5 * static_cast<double>(positive) - 0.25 * static_cast<double>(whole));
  return std::min(1.0, std::erfc(std::max(0.0, off - 0.5) / std::sqrt(2.0 * variance)));
}

}  // namespace

Interval median_interval(std::vector<double> values) {
  std::ranges::sort(values);
  std::vector<Median> medians = MedianSamples(values).all();
  std::ranges::sort(medians, {}, &Median::value);
  const auto end_of = [](const auto& from, const auto& until) {
    double share = 0.0;
    return std::find_if(from, until, [&](const Median& median) { return (share += median.share) >= kTail; })->value;
  };
  return {end_of(medians.begin(), medians.end()), end_of(medians.rbegin(), medians.rend())};
}

SignedRank signed_rank_test(const std::vector<double>& differences) {
  const std::vector<Ranked> all = ranked(differences);
  if (all.empty()) return {};
  std::size_t positive = 0, whole = 0;
  for (const Ranked& one : all) {
    whole += one.twice_rank;
    positive += one.positive ? one.twice_rank : 0;
  }
  if (all.size() > kMostExact) return {all.size(), normal_p(all, positive, whole), false};
  // The distribution is symmetric in the two signs.
  const double share = share_up_to(all, std::min(positive, whole - positive), whole);
  return {all.size(), std::min(1.0, 2.0 * share), true};
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double so_far = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    so_far = std::max(so_far, std::min(1.0, static_cast<double>(p.size() - rank) * p[order[rank]]));
    corrected[order[rank]] = so_far;
  }
  return corrected;
}

}  // namespace skein::cli
