#include "sim_server/conditions/lidar_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/math/random_stream.hpp"

namespace skein::sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

LidarConfig one_ring() {
  LidarConfig lidar;
  lidar.rings = 1;
  return lidar;
}

/// Ranges of a ring to a straight wall, whose nearest point is `distance_m` away at azimuth 0.
std::vector<double> wall(const LidarConfig& lidar, double distance_m) {
  std::vector<double> ranges;
  for (int column = 0; column < lidar.columns; ++column) {
    const double azimuth = 2.0 * std::numbers::pi * column / lidar.columns - std::numbers::pi;
    ranges.push_back(std::cos(azimuth) > 0.05 ? distance_m / std::cos(azimuth) : kNothing);
  }
  return ranges;
}

TEST(LidarErrors, TheIncidenceOnAWallFollowsFromTheRanges) {
  const LidarConfig lidar = one_ring();
  const std::vector<double> ranges = wall(lidar, 10.0);
  const LidarErrors errors({}, lidar, 1, UavIndex{0});
  for (const double azimuth : {0.0, 0.3, -0.7, 1.2}) {
    const auto beam =
        static_cast<std::size_t>(std::lround((azimuth + std::numbers::pi) / (2.0 * std::numbers::pi) * lidar.columns));
    EXPECT_NEAR(errors.cos_incidence(ranges, beam), std::cos(azimuth), 0.03) << azimuth;
  }
}

TEST(LidarErrors, DarkSurfacesVanishAtTheRangeThatTheirAngleAllows) {
  const LidarConfig lidar = one_ring();
  LidarErrors errors({.reflectivity = 0.04, .full_range_m = 100.0}, lidar, 1, UavIndex{0});
  const std::vector<double> ranges = wall(lidar, 15.0);
  const std::vector<double>& measured = errors.measure(0, ranges);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!std::isfinite(ranges[i])) continue;
    // 20 m sqrt(cos) against 15 m / cos.
    const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(i) / lidar.columns - std::numbers::pi;
    const double seen_m = 20.0 * std::sqrt(std::cos(azimuth));
    if (std::abs(ranges[i] / seen_m - 1.0) < 0.03) continue;
    EXPECT_EQ(measured[i], ranges[i] < seen_m ? ranges[i] : kNothing) << azimuth;
  }
}

/// measure() mostly compares powers instead of roots. It must lose the same returns as the formula, also those whose
/// range is within a rounding error of the limit.
TEST(LidarErrors, ExactlyTheReturnsThatTheFormulaLosesAreLost) {
  LidarConfig lidar;
  lidar.rings = 4;
  lidar.columns = 90;
  RandomStream draw(1, "lidar_errors_test", 0);
  int lost = 0, seen = 0, close = 0;
  for (std::uint64_t scan = 0; scan < 500; ++scan) {
    const LidarConditions conditions{.reflectivity = draw.uniform(0.01, 1.0),
                                     .full_range_m = draw.uniform(20.0, 150.0)};
    LidarErrors errors(conditions, lidar, 1, UavIndex{0});
    const auto seen_m = [&](double cos) { return conditions.full_range_m * std::sqrt(*conditions.reflectivity * cos); };
    std::vector<double> ranges(static_cast<std::size_t>(lidar.rings * lidar.columns), kNothing);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double kind = draw.uniform();
      // Ranges near the limit, or near the previous beam: perpendicular and slanted surfaces, edges, and nothing.
      if (kind < 0.3) ranges[i] = seen_m(1.0) * (1.0 + std::round(draw.uniform(-4.0, 4.0)) * 0x1p-52);
      if (kind > 0.5) ranges[i] = draw.uniform(0.0, 120.0);
      if (kind > 0.7 && i > 0 && std::isfinite(ranges[i - 1])) ranges[i] = ranges[i - 1] * draw.uniform(0.8, 1.25);
    }
    const std::vector<double>& measured = errors.measure(scan, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (!std::isfinite(ranges[i])) continue;
      const double most_m = seen_m(errors.cos_incidence(ranges, i));
      ASSERT_EQ(measured[i], ranges[i] > most_m ? kNothing : ranges[i]) << scan << ", " << i;
      (ranges[i] > most_m ? lost : seen) += 1;
      close += std::abs(ranges[i] / most_m - 1.0) < 1e-14;
    }
  }
  EXPECT_GT(std::min(lost, seen), 10'000);
  EXPECT_GT(close, 1000);
}

TEST(LidarErrors, NoiseGrowsWithTheRange) {
  const LidarConfig lidar = one_ring();
  LidarErrors errors({.sigma_per_m = 0.002}, lidar, 1, UavIndex{0});
  for (const double range : {5.0, 40.0}) {
    const std::vector<double> ranges(static_cast<std::size_t>(lidar.columns), range);
    double sum = 0.0, squares = 0.0;
    constexpr int kScans = 200;
    for (std::uint64_t scan = 0; scan < kScans; ++scan) {
      for (const double measured : errors.measure(scan, ranges)) {
        sum += measured - range;
        squares += (measured - range) * (measured - range);
      }
    }
    const double count = kScans * lidar.columns, sigma = 0.002 * range;
    EXPECT_NEAR(sum / count, 0.0, 0.02 * sigma);
    EXPECT_NEAR(squares / count, sigma * sigma, 0.03 * sigma * sigma);
  }
}

/// Angle of a beam of wall(), which is its incidence angle.
double azimuth_of(const LidarConfig& lidar, std::size_t column) {
  return 2.0 * std::numbers::pi * static_cast<double>(column) / lidar.columns - std::numbers::pi;
}

double tan_of(double cos) { return std::sqrt(1.0 / (cos * cos) - 1.0); }

/// Squares of the noise of a ring's beams, on average over scans.
std::vector<double> mean_squares(LidarErrors& errors, const std::vector<double>& ranges, std::uint64_t scans) {
  std::vector<double> squares(ranges.size(), 0.0);
  for (std::uint64_t scan = 0; scan < scans; ++scan) {
    const std::vector<double>& measured = errors.measure(scan, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double noise = std::isfinite(ranges[i]) ? measured[i] - ranges[i] : 0.0;
      squares[i] += noise * noise / static_cast<double>(scans);
    }
  }
  return squares;
}

TEST(LidarErrors, NoiseIsThatOfTheModelAtEachRangeAndIncidence) {
  const LidarConfig lidar = one_ring();
  RandomStream draw(2, "lidar_errors_test", 0);
  constexpr std::uint64_t kScans = 4000;
  constexpr double kStatistics = 5.5 * std::numbers::sqrt2 / 63.0;  // of a mean of 4000 squares
  int bounded = 0;
  for (std::uint64_t world = 0; world < 6; ++world) {
    const LidarConditions conditions{.sigma_per_m = world == 0 ? 0.0 : draw.uniform(0.0005, 0.003),
                                     .divergence_mrad = world == 1 ? 0.0 : draw.uniform(0.5, 6.0)};
    LidarErrors errors(conditions, lidar, world, UavIndex{0});
    const std::vector<double> ranges = wall(lidar, draw.uniform(1.0, 40.0));
    const std::vector<double> squares = mean_squares(errors, ranges, kScans);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double azimuth = azimuth_of(lidar, i);
      if (!std::isfinite(ranges[i]) || std::abs(azimuth) < 0.1) continue;
      const double estimated = lidar_sigma_m(conditions, ranges[i], tan_of(errors.cos_incidence(ranges, i)));
      ASSERT_NEAR(squares[i] / (estimated * estimated), 1.0, kStatistics) << world << ", " << azimuth;
      // The angle is computed from beams 0.8 degrees apart.
      const double real = lidar_sigma_m(conditions, ranges[i], std::tan(std::abs(azimuth)));
      ASSERT_NEAR(std::sqrt(squares[i]) / real, 1.0, 0.5 * kStatistics + 0.1) << world << ", " << azimuth;
      if (std::tan(std::abs(azimuth)) < 1.1 * kMostTanIncidence) continue;
      const double most = lidar_sigma_m(conditions, ranges[i], kMostTanIncidence);
      ASSERT_NEAR(squares[i] / (most * most), 1.0, kStatistics) << "beyond 80 degrees: " << azimuth;
      ++bounded;
    }
  }
  EXPECT_GT(bounded, 50);
}

TEST(LidarErrors, EdgesAndSingleBeamsHaveTheNoiseOfPerpendicularSurfaces) {
  const LidarConfig lidar = one_ring();
  const LidarConditions conditions{.sigma_per_m = 0.001, .divergence_mrad = 3.0};
  LidarErrors errors(conditions, lidar, 1, UavIndex{0});
  std::vector<double> ranges(static_cast<std::size_t>(lidar.columns), kNothing);
  std::fill_n(ranges.begin() + 100, 20, 30.0);  // background, a plate in front of it, background, nothing
  std::fill_n(ranges.begin() + 120, 20, 10.0);
  std::fill_n(ranges.begin() + 140, 20, 30.0);
  ranges[200] = 20.0;
  const std::vector<double> squares = mean_squares(errors, ranges, 4000);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!std::isfinite(ranges[i])) continue;
    EXPECT_NEAR(squares[i] / (1e-6 * ranges[i] * ranges[i]), 1.0, 0.13) << i;
  }
}

/// Scans of walls, plates, single beams and nothing.
std::vector<double> drawn_scan(const LidarConfig& lidar, RandomStream& draw) {
  std::vector<double> ranges;
  while (ranges.size() < static_cast<std::size_t>(lidar.rings * lidar.columns)) {
    const double kind = draw.uniform(), change = draw.uniform(-0.02, 0.02);
    double range = draw.uniform(1.0, 49.0);
    for (double left = std::floor(draw.uniform(1.0, 40.0)); left > 0.0; left -= 1.0) {
      ranges.push_back(kind < 0.5 ? kNothing : range);
      range = std::clamp(range * (1.0 + change), 1.0, 49.0);
    }
  }
  ranges.resize(static_cast<std::size_t>(lidar.rings * lidar.columns));
  return ranges;
}

LidarConditions drawn_conditions(RandomStream& draw) {
  LidarConditions conditions;
  if (draw.uniform() < 0.7) conditions.sigma_per_m = draw.uniform(0.0, 0.01);
  if (draw.uniform() < 0.7) conditions.divergence_mrad = draw.uniform(0.0, 10.0);
  if (draw.uniform() < 0.7) conditions.reflectivity = draw.uniform(0.05, 1.0);
  if (draw.uniform() < 0.7) conditions.clutter_p = draw.uniform(0.0, 0.05);
  return conditions;
}

TEST(LidarErrors, TheErrorsDependOnlyOnSeedUavScanAndConditions) {
  LidarConfig lidar;
  lidar.rings = 4;
  RandomStream draw(3, "lidar_errors_test", 0);
  LidarErrors changing({}, lidar, 7, UavIndex{2});
  for (std::uint64_t scan = 0; scan < 100; ++scan) {
    LidarConditions conditions = drawn_conditions(draw);
    const std::vector<double> ranges = drawn_scan(lidar, draw);
    changing.change(conditions);  // in flight
    const std::vector<double> measured = changing.measure(scan, ranges);
    ASSERT_EQ(LidarErrors(conditions, lidar, 7, UavIndex{2}).measure(scan, ranges), measured);
    conditions.sigma_per_m = 0.001;
    const std::vector<double> noisy = LidarErrors(conditions, lidar, 7, UavIndex{2}).measure(scan, ranges);
    EXPECT_NE(LidarErrors(conditions, lidar, 8, UavIndex{2}).measure(scan, ranges), noisy);
    EXPECT_NE(LidarErrors(conditions, lidar, 7, UavIndex{3}).measure(scan, ranges), noisy);
    EXPECT_NE(LidarErrors(conditions, lidar, 7, UavIndex{2}).measure(scan + 1, ranges), noisy);
  }
}

/// Neither rain nor the ranges of beams that are not adjacent change the noise of a beam, and noise changes no loss.
TEST(LidarErrors, TheErrorsDoNotDependOnEachOther) {
  LidarConfig lidar;
  lidar.rings = 4;
  RandomStream draw(4, "lidar_errors_test", 0);
  const auto measured = [&](const LidarConditions& conditions, std::uint64_t scan, const std::vector<double>& ranges) {
    return LidarErrors(conditions, lidar, 7, UavIndex{0}).measure(scan, ranges);
  };
  int same = 0, rain = 0;
  for (std::uint64_t scan = 0; scan < 100; ++scan) {
    const LidarConditions all = drawn_conditions(draw);
    LidarConditions dry = all, clear = all;
    dry.clutter_p = clear.clutter_p = 0.0;
    clear.sigma_per_m = clear.divergence_mrad = 0.0;
    std::vector<double> ranges = drawn_scan(lidar, draw);
    const std::vector<double> with_all = measured(all, scan, ranges), noisy = measured(dry, scan, ranges),
                              exact = measured(clear, scan, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ASSERT_EQ(std::isfinite(noisy[i]), std::isfinite(exact[i])) << scan << ", " << i;
      (with_all[i] == noisy[i] ? same : rain) += 1;
      ASSERT_TRUE(with_all[i] == noisy[i] || with_all[i] < ranges[i]) << scan << ", " << i;
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (i % 10 > 2) ranges[i] = kNothing;  // leaves one beam in ten with both neighbours
    }
    const std::vector<double> fewer = measured(dry, scan, ranges);
    for (std::size_t i = 1; i < ranges.size(); i += 10) ASSERT_EQ(fewer[i], noisy[i]) << scan << ", " << i;
  }
  EXPECT_GT(same, 50 * rain);
  EXPECT_GT(rain, 1000);
}

TEST(LidarErrors, NoiseOfBeamsAndOfScansIsNotCorrelated) {
  const LidarConfig lidar = one_ring();
  LidarErrors errors({.sigma_per_m = 0.001}, lidar, 1, UavIndex{0});
  const std::vector<double> ranges(static_cast<std::size_t>(lidar.columns), 20.0);
  std::vector<double> before(ranges.size(), 20.0);
  double beams = 0.0, scans = 0.0;
  constexpr int kScans = 2000;
  for (std::uint64_t scan = 0; scan < kScans; ++scan) {
    const std::vector<double>& measured = errors.measure(scan, ranges);
    for (std::size_t i = 1; i < ranges.size(); ++i) {
      beams += (measured[i] - 20.0) * (measured[i - 1] - 20.0) / 4e-4;
      scans += (measured[i] - 20.0) * (before[i] - 20.0) / 4e-4;
    }
    before = measured;
  }
  const double count = kScans * (lidar.columns - 1.0);
  EXPECT_NEAR(beams / count, 0.0, 5.0 / std::sqrt(count));
  EXPECT_NEAR(scans / count, 0.0, 5.0 / std::sqrt(count));
}

/// LidarErrors draws the number of beams from one drop to the next. Nevertheless, all beams must meet drops equally
/// often, and independently of each other.
TEST(LidarErrors, RainHitsAllBeamsEquallyOften) {
  const LidarConfig lidar = one_ring();
  const std::vector<double> ranges(static_cast<std::size_t>(lidar.columns), kNothing);
  for (const double p : {0.1, 0.01, 1e-18}) {
    LidarErrors errors({.clutter_p = p, .clutter_mean_m = 0.1}, lidar, 1, UavIndex{0});
    std::vector<double> drops(ranges.size(), 0.0);
    double all = 0.0, pairs = 0.0;
    constexpr double kScans = 10'000;
    for (std::uint64_t scan = 0; scan < kScans; ++scan) {
      const std::vector<double>& measured = errors.measure(scan, ranges);
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (!std::isfinite(measured[i])) continue;
        all += 1.0;
        drops[i] += 1.0;
        pairs += i > 0 && std::isfinite(measured[i - 1]);
      }
    }
    const auto near = [&](double count, double of, double probability) {
      EXPECT_NEAR(count, of * probability, 5.0 * std::sqrt(of * probability) + 0.5) << p;
    };
    near(all, kScans * lidar.columns, p);
    near(pairs, kScans * (lidar.columns - 1), p * p);
    for (const double count : drops) near(count, kScans, p);
  }
}

TEST(LidarErrors, RainReturnsAsOftenAsItsProbabilitySaysAndNeverBehindASurface) {
  const LidarConfig lidar = one_ring();
  LidarErrors errors({.clutter_p = 0.02, .clutter_mean_m = 4.0}, lidar, 1, UavIndex{0});
  std::vector<double> ranges(static_cast<std::size_t>(lidar.columns), kNothing);
  for (std::size_t i = 0; i < ranges.size(); i += 2) ranges[i] = lidar.range_min_m + 2.0;
  double drops = 0.0, before_surface = 0.0, way_m = 0.0;
  constexpr int kScans = 1000;
  for (std::uint64_t scan = 0; scan < kScans; ++scan) {
    const std::vector<double>& measured = errors.measure(scan, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ASSERT_LE(measured[i], ranges[i]);
      if (measured[i] == ranges[i]) continue;
      ASSERT_GE(measured[i], lidar.range_min_m);
      if (i % 2 == 0) {
        before_surface += 1.0;
      } else {
        drops += 1.0;
        way_m += measured[i] - lidar.range_min_m;
      }
    }
  }
  const double beams = 0.5 * kScans * lidar.columns;
  EXPECT_NEAR(drops / beams, 0.02, 0.001);
  EXPECT_NEAR(way_m / drops, 4.0, 0.25);
  EXPECT_NEAR(before_surface / beams, 0.02 * (1.0 - std::exp(-0.5)), 0.001);
}

}  // namespace
}  // namespace skein::sim
