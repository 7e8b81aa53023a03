// Random numbers that depend on nothing but their key: (seed, purpose, entity, sequence). The same key gives the same
// numbers on every machine, whatever else was drawn before, in whatever thread. Only + - * / and square roots are
// used, never libm or std:: distributions, whose results differ between libraries.
// That seed 0 means "draw nothing" is the caller's affair.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skein {

/// One thread at a time.
class RandomStream {
 public:
  /// @param purpose what the numbers are for: "lidar_noise".
  /// @param entity whose they are: a UAV's index, or a name such as a link's.
  /// @param sequence which draw of it: a scan's number, a message's. A stream for each keeps draws independent.
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

/// Natural logarithm from + - * / alone: x = m 2^e with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh((m-1)/(m+1)) as
/// its series; within 4 units in the last place, and near 1 within 1e-16.  @param x above 0 and normal.
double portable_log(double x);

}  // namespace skein
