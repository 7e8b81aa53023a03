#include "sim_server/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/euler.hpp"
#include "core/random_stream.hpp"

namespace skein::sim {
namespace {

/// Unit vectors of all beams in L: ring by ring upwards, in each by azimuth from -pi (backwards), evenly round.
Eigen::Matrix3Xf beam_directions(const LidarConfig& config) {
  Eigen::Matrix3Xf directions(3, config.rings * config.columns);
  const double half_fov = 0.5 * config.vertical_fov_deg * kRadPerDeg;
  for (int ring = 0; ring < config.rings; ++ring) {
    const double elevation = config.rings > 1 ? half_fov * (2.0 * ring / (config.rings - 1) - 1.0) : 0.0;
    for (int column = 0; column < config.columns; ++column) {
      const double azimuth = std::numbers::pi * (2.0 * column / config.columns - 1.0);
      directions.col(ring * config.columns + column) =
          Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation))
              .cast<float>();
    }
  }
  return directions;
}

}  // namespace

double servo_angle(const LidarConfig& config, double t_s) {
  const double rate = config.servo_rate_deg_s * kRadPerDeg;
  const double limit = config.servo_limit_deg * kRadPerDeg;
  const double half_s = 0.5 * config.servo_period_s;
  const double cycle_s = t_s - config.servo_period_s * std::floor(t_s / config.servo_period_s);
  // After the first half period, and whenever it has turned upwards since then, it stands at `top`.
  const double top = std::min(rate * half_s, limit);
  const double bottom = std::max(top - rate * half_s, -limit);
  if (cycle_s < half_s) {
    const double start = t_s < config.servo_period_s ? 0.0 : bottom;
    return std::min(start + rate * cycle_s, limit);
  }
  return std::max(top - rate * (cycle_s - half_s), -limit);
}

Lidar::Lidar(const LidarConfig& config, std::size_t uav, std::uint64_t seed)
    : config_(config),
      uav_(uav),
      seed_(seed),
      period_(std::max<Tick>(1, ticks(1.0 / config.rate_hz))),
      directions_L_(beam_directions(config)),
      directions_W_(static_cast<std::size_t>(directions_L_.cols())),
      ranges_(directions_W_.size()) {
  if (seed != 0) {
    phase_ = ticks(config.servo_period_s * RandomStream(seed, "lidar_phase", uav, 0).uniform());
  }
}

LidarScan Lidar::scan(Tick tick, const Isometry3d& X_WB, const RayScene& world) {
  LidarScan scan;
  scan.tick = tick;
  scan.number = static_cast<std::uint64_t>(tick / period_);
  scan.servo_angle = servo_angle(config_, seconds(tick + phase_));
  const Eigen::AngleAxisd R_BS(scan.servo_angle, Vector3d::UnitX());
  scan.X_WL =
      X_WB * Eigen::Translation3d(kLidarServo_p_BS) * R_BS * Eigen::Translation3d(0.0, 0.0, kLidarCentreAboveServo);

  const Eigen::Matrix3f R_WL = scan.X_WL.linear().cast<float>();
  for (std::size_t i = 0; i < directions_W_.size(); ++i) {
    directions_W_[i] = R_WL * directions_L_.col(static_cast<Eigen::Index>(i));
  }
  RayFilter filter;
  filter.except_uav = uav_;
  world.scan(scan.X_WL.translation(), directions_W_, config_.range_max_m, filter, ranges_);

  const bool noisy = seed_ != 0 && config_.sigma_m > 0.0;
  RandomStream noise(seed_, "lidar_noise", uav_, scan.number);
  scan.points_W.reserve(ranges_.size());
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (ranges_[i] < config_.range_min_m || ranges_[i] > config_.range_max_m) {
      continue;
    }
    const double range = noisy ? ranges_[i] + config_.sigma_m * noise.normal() : ranges_[i];
    scan.points_W.push_back((scan.X_WL.translation() + range * directions_W_[i].cast<double>()).cast<float>());
  }
  return scan;
}

}  // namespace skein::sim
