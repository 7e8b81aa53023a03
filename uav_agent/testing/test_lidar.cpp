#include "uav_agent/testing/test_lidar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Distance along a ray to a box; kNever if the ray misses the box or begins inside it.
double way_to_box(const Vector3d& half, const Vector3d& from_O, const Vector3d& direction_O) {
  double enter = 0.0, leave = kNever;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction_O[i]) < 1e-12) {
      if (std::abs(from_O[i]) > half[i]) return kNever;
      continue;
    }
    const double a = (-half[i] - from_O[i]) / direction_O[i], b = (half[i] - from_O[i]) / direction_O[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter > 0.0 && enter < leave ? enter : kNever;
}

}  // namespace

TestLidar::TestLidar(const LidarConfig& config) : config_(config) {
  for (int ring = 0; ring < config.rings; ++ring) {
    for (int column = 0; column < config.columns; ++column) {
      directions_L_.push_back(lidar_direction_L(config, ring, column));
    }
  }
}

bool TestLidar::due(Tick tick) const { return tick % lidar_period(config_) == 0; }

LidarServo TestLidar::servo(Tick tick) const {
  return {tick, servo_angle(config_, seconds(tick)), servo_rate(config_, seconds(tick))};
}

Scan TestLidar::scan(Tick tick, const Isometry3d& X_WB, const std::vector<OrientedBox>& solids) const {
  const Isometry3d X_WL = lidar_pose(X_WB, servo(tick).angle);
  const Matrix3d R_WL = X_WL.linear();
  const Vector3d p_WL = X_WL.translation(), down_L = -R_WL.row(2);
  std::vector<double> ranges(directions_L_.size(), kNever);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double down = down_L.dot(directions_L_[i]);  // the ground is at z = 0
    if (down > 0.0) ranges[i] = p_WL.z() / down;
  }
  for (const OrientedBox& solid : solids) {
    const double radius_m = 0.5 * solid.size.norm();
    const Vector3d centre_L = X_WL.inverse() * solid.center;
    const double off_m = centre_L.norm();
    if (off_m > config_.range_max_m + radius_m) continue;
    // Beams that miss the bounding sphere of the box miss the box.
    const double least_along_m = off_m > radius_m ? std::sqrt(off_m * off_m - radius_m * radius_m) : -kNever;
    const Matrix3d R_OL = solid.R_WO.transpose() * R_WL;
    const Vector3d from_O = solid.R_WO.transpose() * (p_WL - solid.center);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (centre_L.dot(directions_L_[i]) < least_along_m) continue;
      ranges[i] = std::min(ranges[i], way_to_box(0.5 * solid.size, from_O, R_OL * directions_L_[i]));
    }
  }
  Scan scan{.tick = tick};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] < config_.range_min_m || ranges[i] > config_.range_max_m) continue;
    scan.points_W.push_back((p_WL + ranges[i] * (R_WL * directions_L_[i])).cast<float>());
  }
  return scan;
}

}  // namespace skein::agent
