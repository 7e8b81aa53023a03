#include "sim_server/conditions/lidar_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random_stream.hpp"

namespace skein::sim {

/// Tangent of the incidence angle; 0 if both adjacent beams hit nothing.
double LidarErrors::slope(std::span<const double> ranges, std::size_t beam) const {
  const auto columns = static_cast<std::size_t>(lidar_.columns);
  const std::size_t column = beam % columns, last = columns - 1;
  const double before = ranges[column > 0 ? beam - 1 : beam + last],
               after = ranges[column < last ? beam + 1 : beam - last];
  const double range = ranges[beam], step = 2.0 * std::numbers::pi / static_cast<double>(columns);
  // Uses the side with the smaller slope: at an edge, the other side's beam hits another surface.
  const double slope = std::min(std::abs(before - range), std::abs(after - range)) / (range * step);
  return std::isfinite(slope) ? slope : 0.0;
}

double LidarErrors::cos_incidence(std::span<const double> ranges, std::size_t beam) const {
  return 1.0 / std::hypot(1.0, slope(ranges, beam));
}

/// Whether the surface is too dark or too slanted to be seen at its range.
bool LidarErrors::is_lost(std::span<const double> ranges, std::size_t beam) const {
  // Mostly the fourth powers of both sides, which need no roots, differ by more than their rounding errors.
  constexpr double kRounding = 1e-9;
  const double range = ranges[beam], range2 = range * range, tangent = slope(ranges, beam);
  const double seen2 = conditions_.full_range_m * conditions_.full_range_m * *conditions_.reflectivity;
  const double range4 = range2 * range2 * (1.0 + tangent * tangent), seen4 = seen2 * seen2;
  if (range4 < (1.0 - kRounding) * seen4) return false;
  if (range4 > (1.0 + kRounding) * seen4) return true;
  return range > conditions_.full_range_m * std::sqrt(*conditions_.reflectivity * cos_incidence(ranges, beam));
}

const std::vector<double>& LidarErrors::measure(std::uint64_t scan, std::span<const double> ranges) {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  measured_.assign(ranges.begin(), ranges.end());
  RandomStream draw(seed_, "lidar_errors", uav_, scan);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double drop = draw.uniform();
    if (drop < conditions_.clutter_p) {
      // The same draw gives the distance: given that it is less than `clutter_p`, it is uniform in [0, clutter_p).
      const double to_drop_m =
          lidar_.range_min_m - conditions_.clutter_mean_m * portable_log(1.0 - drop / conditions_.clutter_p);
      if (to_drop_m < std::min(ranges[i], lidar_.range_max_m)) {
        measured_[i] = to_drop_m;
        continue;
      }
    }
    if (!std::isfinite(ranges[i])) continue;
    if (conditions_.reflectivity && is_lost(ranges, i)) measured_[i] = kNothing;
    if (conditions_.sigma_per_m > 0.0) measured_[i] += conditions_.sigma_per_m * ranges[i] * draw.normal();
  }
  return measured_;
}

}  // namespace skein::sim
