#include "core/math/random_stream.hpp"

#include <bit>
#include <cmath>

#include "core/text/sha256.hpp"

namespace skein {
namespace {

std::array<std::uint64_t, 4> state_of(const Sha256& key) {
  const auto digest = key.digest();
  std::array<std::uint64_t, 4> state{};
  for (std::size_t i = 0; i < digest.size(); ++i) state[i / 8] |= std::uint64_t{digest[i]} << (8 * (i % 8));
  return state;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t entity, std::uint64_t sequence)
    : state_(state_of(Sha256().add(seed).add(purpose).add("number").add(entity).add(sequence))) {}

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose, std::string_view entity,
                           std::uint64_t sequence)
    : state_(state_of(Sha256().add(seed).add(purpose).add("name").add(entity).add(sequence))) {}

std::uint64_t RandomStream::bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double RandomStream::normal() {
  if (spare_normal_) {
    const double value = *spare_normal_;
    spare_normal_.reset();
    return value;
  }
  double u = 0.0, v = 0.0, square = 0.0;
  do {
    u = uniform(-1.0, 1.0);
    v = uniform(-1.0, 1.0);
    square = u * u + v * v;
  } while (square >= 1.0 || square == 0.0);
  const double factor = std::sqrt(-2.0 * portable_log(square) / square);
  spare_normal_ = v * factor;
  return u * factor;
}

double portable_log(double x) {
  constexpr double kLn2 = 0.69314718055994530942;
  constexpr double kSqrt2 = 1.41421356237309504880;
  const auto word = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(word >> 52) - 1023;
  double mantissa = std::bit_cast<double>((word & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa >= kSqrt2) {
    mantissa *= 0.5;
    ++exponent;
  }
  const double s = (mantissa - 1.0) / (mantissa + 1.0);  // |s| < 0.1716: s^23/23 is below 2^-60
  const double square = s * s;
  double series = 0.0;
  for (int power = 21; power >= 1; power -= 2) series = series * square + 1.0 / power;
  return exponent * kLn2 + 2.0 * s * series;
}

}  // namespace skein
