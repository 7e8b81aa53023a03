// Standard normal numbers for programs that need thousands at once: each from 64 random bits, by linear interpolation
// in a table of quantiles. Several times as fast as RandomStream::normal(), and likewise the same bits on every
// machine. Accuracy: the probability of each tail is within 0.02 % of the normal distribution's down to 6e-11; no
// number is beyond 6.7; variance and kurtosis are within 1e-4 of 1 and 3.
// Pure; safe from any thread.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace skein {

/// The table divides the tail probabilities P(|z| > x), from 0 to 1, into octaves, one for each power of two, and each
/// octave into equal segments.
class NormalTable {
 public:
  static const NormalTable& get();

  /// @param bits  random; the last one is the sign.
  double operator()(std::uint64_t bits) const {
    const int octave = std::countl_zero(bits | kLast);
    // The position within the octave; its first bits are the segment.
    const std::uint64_t position = (bits & ~std::uint64_t{1}) << octave << 1;
    const Segment& segment =
        segments_[static_cast<std::size_t>(octave) * kSegments + (position >> (64 - kSegmentBits))];
    const double within = static_cast<double>(static_cast<std::int64_t>(position << kSegmentBits >> 11)) * 0x1p-53;
    const double value = segment.start + segment.change * within;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ (bits << 63));
  }

 private:
  static constexpr std::size_t kOctaves = 35, kSegmentBits = 5, kSegments = 1U << kSegmentBits;
  static constexpr std::uint64_t kLast = std::uint64_t{1} << (64 - kOctaves);  ///< ends the last octave
  struct Segment {
    double start, change;
  };

  NormalTable();

  std::array<Segment, kOctaves * kSegments> segments_;
};

}  // namespace skein
