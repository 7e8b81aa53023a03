// How the CPU time of single exchanges is spread: a mean hides the one in a hundred that is too slow for the field.
// Memory is bounded, however long the run. Never part of a decision. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skein::agent {

class CpuHistogram {
 public:
  /// The time between two exchanges of the reference: a planner that takes longer would not keep up.
  static constexpr double kFieldExchangeS = 0.05;

  /// @param cpu_s  of one exchange; below zero counts as zero.
  void add(double cpu_s);

  double total_s() const { return total_s_; }
  double max_s() const { return max_s_; }
  std::uint64_t count() const { return count_; }
  /// Exchanges that took more than kFieldExchangeS.
  std::uint64_t over_field_exchange() const { return over_; }
  /// The time that a share of all exchanges kept to: never too low, and at most 5 % (or 1 us) too high.
  /// 0 without exchanges. @param share  in (0, 1].
  double quantile_s(double share) const;

 private:
  /// Each is 2^(1/16) times as long as the one before; the first ends at 1 us, the last takes all that is longer.
  static constexpr std::size_t kBuckets = 512, kBucketsAnOctave = 16;
  static constexpr double kFirstEndS = 1e-6;
  static double end_s(std::size_t bucket);

  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0, over_ = 0;
  double total_s_ = 0.0, max_s_ = 0.0;
};

}  // namespace skein::agent
