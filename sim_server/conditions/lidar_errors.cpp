#include "sim_server/conditions/lidar_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random_stream.hpp"

namespace skein::sim {

double LidarErrors::cos_incidence(std::span<const double> ranges, std::size_t beam) const {
  const auto columns = static_cast<std::size_t>(lidar_.columns);
  const std::size_t ring = beam / columns * columns, column = beam % columns;
  const double before = ranges[ring + (column + columns - 1) % columns], after = ranges[ring + (column + 1) % columns];
  const double range = ranges[beam], step = 2.0 * std::numbers::pi / static_cast<double>(columns);
  // Uses the side with the smaller slope: at an edge, the other side's beam hits another surface.
  double slope = std::numeric_limits<double>::infinity();
  for (const double beside : {before, after}) {
    if (std::isfinite(beside)) slope = std::min(slope, std::abs(beside - range) / (range * step));
  }
  return std::isfinite(slope) ? 1.0 / std::hypot(1.0, slope) : 1.0;
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
    if (conditions_.reflectivity) {
      const double seen_m = conditions_.full_range_m * std::sqrt(*conditions_.reflectivity * cos_incidence(ranges, i));
      if (ranges[i] > seen_m) measured_[i] = kNothing;
    }
    if (conditions_.sigma_per_m > 0.0) measured_[i] += conditions_.sigma_per_m * ranges[i] * draw.normal();
  }
  return measured_;
}

}  // namespace skein::sim
