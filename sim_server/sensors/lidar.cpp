#include "sim_server/sensors/lidar.hpp"

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

Lidar::Lidar(const LidarConfig& config, UavIndex uav, std::uint64_t seed)
    : config_(config),
      uav_(uav),
      seed_(seed),
      period_(std::max<Tick>(1, ticks(1.0 / config.rate_hz))),
      directions_L_(beam_directions(config)),
      ranges_(static_cast<std::size_t>(directions_L_.cols())) {
  if (seed != 0) {
    phase_ = ticks(config.servo_period_s * RandomStream(seed, "lidar_phase", uav, 0).uniform());
  }
}

void Lidar::move(Tick tick, const Isometry3d& X_WB) {
  if (!config_.motion_distortion) return;
  if (past_.empty()) past_.assign(static_cast<std::size_t>(period_), X_WB);
  past_[static_cast<std::size_t>(tick % period_)] = X_WB;
}

Isometry3d Lidar::pose(Tick tick, const Isometry3d& X_WB) const {
  const Eigen::AngleAxisd R_BS(servo_angle(config_, seconds(tick + phase_)), Vector3d::UnitX());
  return X_WB * Eigen::Translation3d(kLidarServo_p_BS) * R_BS * Eigen::Translation3d(0.0, 0.0, kLidarCentreAboveServo);
}

/// Fires some neighbouring columns from one pose.
void Lidar::trace(const Isometry3d& X_WL, int first_column, int columns, const RayScene& world) {
  const Eigen::Matrix3f R_WL = X_WL.linear().cast<float>();
  const auto beams = static_cast<std::size_t>(config_.rings * columns);
  directions_W_.resize(beams);
  distances_.resize(beams);
  const auto beam = [&](int ring, int column) { return ring * config_.columns + first_column + column; };
  for (int ring = 0; ring < config_.rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      directions_W_[static_cast<std::size_t>(ring * columns + column)] = R_WL * directions_L_.col(beam(ring, column));
    }
  }
  RayFilter filter;
  filter.except_uav = uav_;
  world.scan(X_WL.translation(), directions_W_, static_cast<std::size_t>(columns), config_.range_max_m, filter,
             distances_);
  for (int ring = 0; ring < config_.rings; ++ring) {
    std::copy_n(distances_.begin() + ring * columns, columns, ranges_.begin() + beam(ring, 0));
  }
}

LidarScan Lidar::scan(Tick tick, const Isometry3d& X_WB, const RayScene& world) {
  LidarScan scan;
  scan.tick = tick;
  scan.number = static_cast<std::uint64_t>(tick / period_);
  scan.servo_angle = servo_angle(config_, seconds(tick + phase_));
  scan.X_WL = pose(tick, X_WB);
  const bool instant = !config_.motion_distortion || tick < period_;
  if (instant) {
    trace(scan.X_WL, 0, config_.columns, world);
  } else {
    const auto period = static_cast<int>(period_);
    for (int part = 0; part < period; ++part) {
      const int first = part * config_.columns / period, end = (part + 1) * config_.columns / period;
      const Tick fired = tick - period_ + 1 + part;
      const Isometry3d& X_WB_then = past_.empty() ? X_WB : past_[static_cast<std::size_t>(fired % period_)];
      if (first < end) trace(pose(fired, X_WB_then), first, end - first, world);
    }
  }
  const Eigen::Matrix3f R_WL = scan.X_WL.linear().cast<float>();

  const bool noisy = seed_ != 0 && config_.sigma_m > 0.0;
  RandomStream noise(seed_, "lidar_noise", uav_, scan.number);
  scan.points_W.reserve(ranges_.size());
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (ranges_[i] < config_.range_min_m || ranges_[i] > config_.range_max_m) {
      continue;
    }
    const double range = noisy ? ranges_[i] + config_.sigma_m * noise.normal() : ranges_[i];
    const Eigen::Vector3f direction_W =
        instant ? directions_W_[i] : Eigen::Vector3f(R_WL * directions_L_.col(static_cast<Eigen::Index>(i)));
    scan.points_W.push_back((scan.X_WL.translation() + range * direction_W.cast<double>()).cast<float>());
  }
  return scan;
}

}  // namespace skein::sim
