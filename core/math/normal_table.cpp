#include "core/math/normal_table.hpp"

#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

/// The x > 0 that a standard normal number exceeds with probability p in [2^-36, 0.5]: Wichura, algorithm AS 241
/// (Applied Statistics 37, 1988, pages 477 to 484), to 1e-16.
double upper_quantile(double p) {
  const auto polynomial = [](const std::array<double, 8>& coefficients, double x) {
    double sum = 0.0;
    for (const double coefficient : coefficients) sum = sum * x + coefficient;
    return sum;
  };
  const double q = 0.5 - p;
  if (q <= 0.425) {
    const double r = 0.180625 - q * q;
    return q *
           polynomial({2509.0809287301226727, 33430.575583588128105, 67265.770927008700853, 45921.953931549871457,
                       13731.693765509461125, 1971.5909503065514427, 133.14166789178437745, 3.3871328727963666080},
                      r) /
           polynomial({5226.4952788528545610, 28729.085735721942674, 39307.895800092710610, 21213.794301586595867,
                       5394.1960214247511077, 687.18700749205790830, 42.313330701600911252, 1.0},
                      r);
  }
  const double r = std::sqrt(-portable_log(p)) - 1.6;
  return polynomial(
             {7.74545014278341407640e-4, 2.27238449892691845833e-2, 2.41780725177450611770e-1, 1.27045825245236838258,
              3.64784832476320460504, 5.76949722146069140550, 4.63033784615654529590, 1.42343711074968357734},
             r) /
         polynomial({1.05075007164441684324e-9, 5.47593808499534494600e-4, 1.51986665636164571966e-2,
                     1.48103976427480074590e-1, 6.89767334985100004550e-1, 1.67638483018380384940,
                     2.05319162663775882187, 1.0},
                    r);
}

}  // namespace

const NormalTable& NormalTable::get() {
  static const NormalTable table;
  return table;
}

NormalTable::NormalTable() {
  double octave_end = 1.0;  // P(|z| > x), so twice that of one tail
  for (std::size_t octave = 0; octave < kOctaves; ++octave) {
    octave_end *= 0.5;
    const auto value = [&](std::size_t segment) {
      return upper_quantile(0.5 * octave_end * (1.0 + static_cast<double>(segment) / kSegments));
    };
    for (std::size_t i = 0; i < kSegments; ++i) {
      segments_[octave * kSegments + i] = {value(i), value(i + 1) - value(i)};
    }
  }
}

}  // namespace skein
