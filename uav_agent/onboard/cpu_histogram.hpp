// Histogram of the CPU time per exchange. A mean would hide that one exchange in a hundred is too slow for a real UAV.
// Memory is bounded for runs of any length. For reports only: no decision uses it. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skein::agent {

class CpuHistogram {
 public:
  /// Measured: exchange period of CARIC [s]; a planner that takes longer would not keep up on a real UAV.
  static constexpr double kFieldExchangeS = 0.05;

  /// @param cpu_s  CPU time of one exchange; a negative value counts as zero.
  void add(double cpu_s);

  double total_s() const { return total_s_; }
  double max_s() const { return max_s_; }
  std::uint64_t count() const { return count_; }
  /// Number of exchanges that took more than kFieldExchangeS.
  std::uint64_t over_field_exchange() const { return over_; }
  /// Quantile [s]: the time that a share of all exchanges did not exceed. The result is never too low, and at most 5 %
  /// (or 1 us) too high. 0 if there were no exchanges. @param share  in (0, 1].
  double quantile_s(double share) const;

 private:
  /// Upper limits of buckets: 1 us for the first, 2^(1/16) times the one before for each further one, none for the
  /// last. Chosen.
  static constexpr std::size_t kBuckets = 512, kBucketsAnOctave = 16;
  static constexpr double kFirstEndS = 1e-6;  ///< chosen
  static double end_s(std::size_t bucket);

  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0, over_ = 0;
  double total_s_ = 0.0, max_s_ = 0.0;
};

}  // namespace skein::agent
