// Draws and roundings that the parts of a hunt share. Rounded values are stated exactly by a fault file.   Pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/random_stream.hpp"

namespace skein::cli {

/// A drawn number from 0 to count - 1. @param count  above 0.
inline std::size_t below(RandomStream& draw, std::size_t count) {
  return std::min(static_cast<std::size_t>(draw.uniform() * static_cast<double>(count)), count - 1);
}

/// Rounds to a multiple of 1 / parts.
inline double in_parts(double value, double parts) { return std::round(parts * value) / parts; }
inline double tenths(double value) { return in_parts(value, 10.0); }
inline double hundredths(double value) { return in_parts(value, 100.0); }

}  // namespace skein::cli
