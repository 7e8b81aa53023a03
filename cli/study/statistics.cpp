#include "cli/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "core/random_stream.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kResamples = 10'000, kMostExact = 100;

/// Of a sample that has each of the sorted values so many times. Counting is ten times faster than ordering a sample.
double median_of_counts(const std::vector<double>& values, const std::vector<std::uint32_t>& counts) {
  const std::size_t middle = values.size() / 2;  // in the sample, from 0
  std::size_t at = 0, until = counts[0];
  while (until <= middle) until += counts[++at];
  if (values.size() % 2 == 1) return values[at];
  std::size_t before = at;
  if (until - counts[at] == middle) {
    do --before;
    while (counts[before] == 0);
  }
  return 0.5 * (values[at] + values[before]);
}

/// A difference without its sign, and twice its rank: equal ones share a mean, which may end in one half.
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

/// The share of all ways to deal signs whose positive ranks sum to `least` or less, twice the ranks being counted.
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

/// With corrections for ties and continuity. @param positive, whole  twice the sums of ranks.
double normal_p(const std::vector<Ranked>& all, std::size_t positive, std::size_t whole) {
  double variance = 0.0;  // a quarter of the squares' sum, ties or not
  for (const Ranked& one : all) variance += std::pow(0.5 * static_cast<double>(one.twice_rank), 2) / 4.0;
  const double off = std::abs(0.5 * static_cast<double>(positive) - 0.25 * static_cast<double>(whole));
  return std::min(1.0, std::erfc(std::max(0.0, off - 0.5) / std::sqrt(2.0 * variance)));
}

}  // namespace

Interval median_interval(std::vector<double> values, const std::string& purpose) {
  std::ranges::sort(values);
  RandomStream random(0, "median_interval", purpose);
  std::vector<double> medians(kResamples);
  std::vector<std::uint32_t> counts(values.size());
  for (double& median : medians) {
    std::ranges::fill(counts, 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ++counts[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
    }
    median = median_of_counts(values, counts);
  }
  std::ranges::sort(medians);
  return {medians[kResamples / 40 - 1], medians[kResamples - kResamples / 40]};
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
  // What one sign gets and what the other gets are as likely as each other.
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
