// Simulated time in nanoseconds, the unit of recordings.   Pure.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace skein {

/// Exact: a tick is a whole number of nanoseconds.
constexpr std::uint64_t nanoseconds(Tick tick) {
  constexpr std::uint64_t kTickNs = 1'000'000'000 / kTicksPerSecond;
  static_assert(kTickNs * kTicksPerSecond == 1'000'000'000);
  return static_cast<std::uint64_t>(tick) * kTickNs;
}

}  // namespace skein
