#include "sim_server/sensors/lost_returns.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"

namespace skein::sim {

LostReturns::LostReturns(const LidarConfig& config, UavIndex uav, std::uint64_t seed)
    : config_(config), uav_(uav), seed_(seed), dropped_(static_cast<std::size_t>(config.columns)) {}

/// The share implies a fractional number of sectors. It is rounded up or down at random, so that the mean is exact.
/// The order of the sectors and of the columns between them, and the first column, are random, so that all columns are
/// dropped equally often.
void LostReturns::draw_sectors(std::uint64_t hold) {
  RandomStream random(seed_, "lidar_dropped_sectors", uav_, hold);
  const int width = std::clamp(
      static_cast<int>(std::lround(config_.dropped_sectors->width_deg / 360.0 * config_.columns)), 1, config_.columns);
  const double mean = config_.dropped_sectors->share * config_.columns / width;
  int sectors = static_cast<int>(mean);
  if (random.uniform() < mean - sectors) ++sectors;
  int column = static_cast<int>(random.uniform() * config_.columns);
  dropped_.assign(dropped_.size(), false);
  for (int left = config_.columns - sectors * (width - 1); left > 0; --left) {  // sectors, and columns between them
    const bool sector = random.uniform() * left < sectors;
    if (sector) --sectors;
    for (int i = 0; i < (sector ? width : 1); ++i, ++column) {
      dropped_[static_cast<std::size_t>(column % config_.columns)] = sector;
    }
  }
}

const std::vector<bool>& LostReturns::of(Tick tick) {
  lost_.assign(static_cast<std::size_t>(config_.rings * config_.columns), false);
  if (!any()) return lost_;
  if (config_.dropped_sectors) {
    const auto hold = static_cast<std::uint64_t>(tick / std::max<Tick>(1, ticks(config_.dropped_sectors->hold_s)));
    if (hold_ != hold) draw_sectors(hold);
    hold_ = hold;
  }
  RandomStream random(seed_, "lidar_no_return", uav_, static_cast<std::uint64_t>(tick / lidar_period(config_)));
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    lost_[i] = random.uniform() < config_.no_return_p || dropped_[i % dropped_.size()];
  }
  return lost_;
}

}  // namespace skein::sim
