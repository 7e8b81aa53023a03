// Random numbers that depend only on their key: (seed, purpose, entity, sequence). The same key gives the same numbers
// on every machine and in every thread, independent of earlier draws. The code uses only + - * / and square roots,
// never libm or std:: distributions, whose results differ between libraries.
// Seed 0 is not special here: callers must check for it, where it means "draw nothing".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skein {

/// Not thread-safe.
class RandomStream {
 public:
  /// @param purpose  what the numbers are for: "lidar_noise".
  /// @param entity  the entity for which they are drawn: a UAV's index, or a name such as a link's.
  /// @param sequence  number of the scan, message or other event of this entity. A separate stream for each event
  ///   keeps the draws of different events independent.
  RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t entity, std::uint64_t sequence = 0);
  RandomStream(std::uint64_t seed, std::string_view purpose, std::string_view entity, std::uint64_t sequence = 0);

  /// 64 random bits: xoshiro256++ (Blackman and Vigna), its 256 bits of state being the SHA-256 of the key.
  std::uint64_t bits();
  /// In [0, 1), a multiple of 2^-53.
  double uniform();
  /// In [lo, hi); lo <= hi.
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Standard normal, by Marsaglia's polar method.
  double normal();

 private:
  std::array<std::uint64_t, 4> state_;
  std::optional<double> spare_normal_;
};

/// The n-th number, from 0 on, of the generator SplitMix64 (Steele, Lea and Flood 2014) that starts at `key`: 64 random
/// bits that depend on no other draw. @param key  random, from a RandomStream.
inline std::uint64_t numbered_bits(std::uint64_t key, std::uint64_t n) {
  std::uint64_t z = key + (n + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

/// Natural logarithm from + - * / alone: x = m 2^e with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh((m-1)/(m+1)) as
/// its series; within 4 units in the last place, and near 1 within 1e-16.  @param x above 0 and normal.
double portable_log(double x);

}  // namespace skein
