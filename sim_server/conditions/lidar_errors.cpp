#include "sim_server/conditions/lidar_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/normal_table.hpp"
#include "core/math/random_stream.hpp"

namespace skein::sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Least difference to the range of an adjacent beam: at an edge, the other adjacent beam hits another surface.
double least_rise(double before, double range, double after) {
  const double rise = std::min(std::abs(before - range), std::abs(after - range));
  return rise < kNothing ? rise : 0.0;
}

/// Angle between adjacent beams of a ring.
double column_step(const LidarConfig& lidar) { return 2.0 * std::numbers::pi / static_cast<double>(lidar.columns); }

}  // namespace

double LidarErrors::rise(std::span<const double> ranges, std::size_t beam) const {
  const auto columns = static_cast<std::size_t>(lidar_.columns);
  const std::size_t column = beam % columns, last = columns - 1;
  return least_rise(ranges[column > 0 ? beam - 1 : beam + last], ranges[beam],
                    ranges[column < last ? beam + 1 : beam - last]);
}

double LidarErrors::cos_incidence(std::span<const double> ranges, std::size_t beam) const {
  return 1.0 / std::hypot(1.0, rise(ranges, beam) / (ranges[beam] * column_step(lidar_)));
}

/// Noise, and surfaces that are too dark or too slanted to be seen at their ranges.
void LidarErrors::measure_surfaces(std::uint64_t scan, std::span<const double> ranges) {
  const double per_step = 1.0 / column_step(lidar_);
  // A beam that hits a surface with tangent t at range r is lost if r^4 (1 + t^2) > seen^4. The comparison of powers
  // needs no roots; within their rounding errors, the formula with roots decides.
  constexpr double kRounding = 1e-9;
  const double seen2 = conditions_.reflectivity
                           ? conditions_.full_range_m * conditions_.full_range_m * *conditions_.reflectivity
                           : kNothing;
  const double lost4 = (1.0 + kRounding) * seen2 * seen2, kept4 = (1.0 - kRounding) * seen2 * seen2;
  const double along = conditions_.sigma_per_m, across = lidar_sigma_across(conditions_);
  const double along2 = along * along, across2 = across * across;
  const bool noisy = along > 0.0 || across > 0.0;
  const NormalTable& normal = NormalTable::get();
  const std::uint64_t key = RandomStream(seed_, "lidar_errors", uav_, scan).bits();

  const auto columns = static_cast<std::size_t>(lidar_.columns), last = columns - 1;
  for (std::size_t first = 0; first < ranges.size(); first += columns) {
    const double* const ring = ranges.data() + first;
    for (std::size_t column = 0; column < columns; ++column) {
      const double range = ring[column], range2 = range * range;
      double& measured = measured_[first + column];
      measured = kNothing;
      if (!(range < kNothing) || range2 * range2 > lost4) continue;
      const double rise = least_rise(ring[column > 0 ? column - 1 : last], range, ring[column < last ? column + 1 : 0]);
      const double run = rise * per_step;  // range times tangent
      const double power4 = range2 * (range2 + run * run);
      if (power4 > lost4) continue;
      if (power4 >= kept4) {
        const double cos = cos_incidence(ranges, first + column);
        if (range > conditions_.full_range_m * std::sqrt(*conditions_.reflectivity * cos)) continue;
      }
      measured = range;
      if (!noisy) continue;
      const double slanted = std::min(run, kMostTanIncidence * range);
      measured += std::sqrt(along2 * range2 + across2 * slanted * slanted) * normal(numbered_bits(key, first + column));
    }
  }
}

/// Drops and particles that return a beam before it reaches a surface.
void LidarErrors::add_clutter(std::uint64_t scan, std::span<const double> ranges) {
  RandomStream draw(seed_, "lidar_clutter", uav_, scan);
  // Few beams meet a drop: draws the distance from one to the next, which is geometrically distributed.
  const double log_missed = portable_log(1.0 - conditions_.clutter_p);
  if (!(log_missed < 0.0)) return;  // 1 - clutter_p is 1 in its precision
  double beam = -1.0;
  while (true) {
    beam += 1.0 + std::floor(portable_log(1.0 - draw.uniform()) / log_missed);
    if (beam >= static_cast<double>(ranges.size())) return;
    const auto i = static_cast<std::size_t>(beam);
    const double to_drop_m = lidar_.range_min_m - conditions_.clutter_mean_m * portable_log(1.0 - draw.uniform());
    if (to_drop_m < std::min(ranges[i], lidar_.range_max_m)) measured_[i] = to_drop_m;
  }
}

const std::vector<double>& LidarErrors::measure(std::uint64_t scan, std::span<const double> ranges) {
  measured_.resize(ranges.size());
  measure_surfaces(scan, ranges);
  if (conditions_.clutter_p > 0.0) add_clutter(scan, ranges);
  return measured_;
}

}  // namespace skein::sim
