#include "sim_server/sensors/lidar.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"

namespace skein::sim {
namespace {

/// Unit vectors of all beams in L, in the order of the cloud.
Eigen::Matrix3Xf beam_directions(const LidarConfig& config) {
  Eigen::Matrix3Xf directions(3, config.rings * config.columns);
  for (int ring = 0; ring < config.rings; ++ring) {
    for (int column = 0; column < config.columns; ++column) {
      directions.col(ring * config.columns + column) = lidar_direction_L(config, ring, column).cast<float>();
    }
  }
  return directions;
}

}  // namespace

Lidar::Lidar(const LidarConfig& config, UavIndex uav, std::uint64_t seed, const LidarConditions& conditions)
    : config_(config),
      uav_(uav),
      seed_(seed),
      period_(lidar_period(config)),
      lost_(config, uav, seed),
      errors_(conditions, config, seed, uav),
      directions_L_(beam_directions(config)),
      ranges_(static_cast<std::size_t>(directions_L_.cols())) {
  if (seed != 0) {
    phase_ = ticks(config.servo_period_s * RandomStream(seed, "lidar_phase", uav, 0).uniform());
  }
}

LidarServo Lidar::servo(Tick tick) const {
  const double t_s = seconds(tick + phase_);
  return {tick, servo_angle(config_, t_s), servo_rate(config_, t_s)};
}

void Lidar::move(Tick tick, const Isometry3d& X_WB) {
  if (!config_.motion_distortion) return;
  if (past_.empty()) past_.assign(static_cast<std::size_t>(period_), X_WB);
  past_[static_cast<std::size_t>(tick % period_)] = X_WB;
}

Isometry3d Lidar::pose(Tick tick, const Isometry3d& X_WB) const {
  return lidar_pose(X_WB, servo_angle(config_, seconds(tick + phase_)));
}

/// Traces the beams of some adjacent columns from one pose.
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
  const bool instant = fired_at_once(config_, tick);
  if (instant) {
    trace(scan.X_WL, 0, config_.columns, world);
  } else {
    for (Tick part = 0; part < period_; ++part) {
      const int first = first_column(config_, part), end = first_column(config_, part + 1);
      const Tick fired = fired_at(config_, tick, part);
      const Isometry3d& X_WB_then = past_.empty() ? X_WB : past_[static_cast<std::size_t>(fired % period_)];
      if (first < end) trace(pose(fired, X_WB_then), first, end - first, world);
    }
  }
  const Eigen::Matrix3f R_WL = scan.X_WL.linear().cast<float>();

  const bool noisy = seed_ != 0 && config_.sigma_m > 0.0;
  RandomStream noise(seed_, "lidar_noise", uav_, scan.number);
  const std::vector<bool>* const lost = lost_.any() ? &lost_.of(tick) : nullptr;
  const std::vector<double>& ranges = errors_.any() ? errors_.measure(scan.number, ranges_) : ranges_;
  scan.points_W.reserve(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] < config_.range_min_m || ranges[i] > config_.range_max_m) {
      continue;
    }
    const double range = noisy ? ranges[i] + config_.sigma_m * noise.normal() : ranges[i];
    if (lost != nullptr && (*lost)[i]) continue;
    const Eigen::Vector3f direction_W =
        instant ? directions_W_[i] : Eigen::Vector3f(R_WL * directions_L_.col(static_cast<Eigen::Index>(i)));
    scan.points_W.push_back((scan.X_WL.translation() + range * direction_W.cast<double>()).cast<float>());
  }
  return scan;
}

}  // namespace skein::sim
