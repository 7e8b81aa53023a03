#include "uav_agent/maps/scan_bundles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lidar_geometry.hpp"

namespace skein::agent {

ScanBundler::ScanBundler(const LidarConfig& lidar, double bundle_rad) : lidar_(lidar) {
  const double column_rad = 2.0 * std::numbers::pi / lidar.columns;
  const double ring_rad = lidar.rings > 1 ? ring_elevation(lidar, 1) - ring_elevation(lidar, 0) : 1.0;
  columns_ = std::clamp(static_cast<int>(bundle_rad / column_rad), 1, lidar.columns);
  rings_ = std::clamp(static_cast<int>(bundle_rad / ring_rad), 1, lidar.rings);
  across_ = (lidar.columns + columns_ - 1) / columns_;
  up_ = (lidar.rings + rings_ - 1) / rings_;
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      directions_L_.push_back(lidar_direction_L(lidar, ring, column).cast<float>());
    }
  }
  middles_L_.assign(static_cast<std::size_t>(across_ * up_), Vector3d::Zero());
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      middles_L_[static_cast<std::size_t>(ring / rings_ * across_ + column / columns_)] +=
          lidar_direction_L(lidar, ring, column);
    }
  }
  for (Vector3d& middle_L : middles_L_) middle_L.normalize();
  half_rad_ = 0.5 * std::hypot((columns_ - 1) * column_rad, (rings_ - 1) * ring_rad);
}

void ScanBundler::find_free(const BeamScan& scan, const TubeFree& near_free, const ClearWay& clear_way) {
  const double near_m = lidar_.range_min_m;
  const BeamScan::Firing* asked = nullptr;
  bool all_near_free = false;
  for (int side = 0; side < across_; ++side) {
    const int first_column = side * columns_, end_column = std::min(first_column + columns_, lidar_.columns);
    const BeamScan::Firing& firing = scan.firing((first_column + end_column) / 2);
    const Isometry3d& X_WL = firing.X_WL;
    if (&firing != asked) all_near_free = near_free(X_WL.translation(), X_WL.translation(), near_m);
    asked = &firing;
    for (int level = 0; level < up_; ++level) {
      const auto number = static_cast<std::size_t>(level * across_ + side);
      auto free_m = static_cast<float>(lidar_.range_max_m);
      bool any_none = false;
      for (int ring = level * rings_; ring < std::min((level + 1) * rings_, lidar_.rings); ++ring) {
        for (int column = first_column; column < end_column; ++column) {
          const BeamScan::Beam& beam = scan.beam(ring, column);
          any_none = any_none || beam.state == BeamState::none;
          if (beam.state != BeamState::none) {
            free_m = std::min(free_m, beam.state == BeamState::unknown ? 0.0F : beam.range_m);
          }
          if (beam.state != BeamState::range) continue;
          const auto place = static_cast<std::size_t>(ring * lidar_.columns + column);
          const Vector3d hit_L = (beam.range_m * directions_L_[place]).cast<double>();
          bundles_.hits_W.push_back((scan.firing(column).X_WL * hit_L).cast<float>());
        }
      }
      if (any_none && !all_near_free) {
        const Vector3d from_W = X_WL.translation(), to_W = X_WL * (near_m * middles_L_[number]);
        if (!near_free(from_W, to_W, near_m * half_rad_)) free_m = 0.0F;
      }
      if (any_none && clear_way && free_m > 0.0F) {
        const Vector3d direction_W = X_WL.linear() * middles_L_[number];
        free_m = static_cast<float>(clear_way(X_WL.translation(), direction_W, free_m));
      }
      free_m_[number] = free_m;
    }
  }
}

/// The least of the bundles about each: along the rings, which go round, and then up, where beyond the last there is
/// nothing to be seen, nor to be contradicted.
void ScanBundler::look_around() {
  const auto at = [&](int level, int side) {
    return static_cast<std::size_t>(level * across_ + (side + across_) % across_);
  };
  for (int level = 0; level < up_; ++level) {
    for (int side = 0; side < across_; ++side) {
      float least = free_m_[at(level, side)];
      for (int step = 1; step <= std::min(kAround, across_ / 2); ++step) {
        least = std::min({least, free_m_[at(level, side - step)], free_m_[at(level, side + step)]});
      }
      row_[at(level, side)] = least;
    }
  }
  for (int level = 0; level < up_; ++level) {
    for (int side = 0; side < across_; ++side) {
      float least = row_[at(level, side)];
      for (int other = std::max(0, level - kAround); other <= std::min(up_ - 1, level + kAround); ++other) {
        least = std::min(least, row_[at(other, side)]);
      }
      around_m_[at(level, side)] = least;
    }
  }
}

const ScanBundler::Bundles& ScanBundler::bundle(const BeamScan& scan, const RepeatedScans::Repeated& repeated,
                                                const TubeFree& near_free, const ClearWay& clear_way) {
  bundles_.bundles.clear();
  bundles_.hits_W.clear();
  if (scan.doubt != ScanDoubt::none) return bundles_;
  free_m_.resize(middles_L_.size());
  row_.resize(middles_L_.size());
  around_m_.resize(middles_L_.size());
  find_free(scan, near_free, clear_way);
  look_around();
  for (int level = 0; level < up_; ++level) {
    const int rings = std::min(rings_, lidar_.rings - level * rings_);
    for (int side = 0; side < across_; ++side) {
      const auto number = static_cast<std::size_t>(level * across_ + side);
      if (free_m_[number] <= 0.0F) continue;
      const int columns = std::min(columns_, lidar_.columns - side * columns_);
      const Isometry3d& X_WL = scan.firing(side * columns_ + columns / 2).X_WL;
      const Eigen::Vector3f direction_W = (X_WL.linear() * middles_L_[number]).cast<float>();
      if (repeated(direction_W)) continue;
      bundles_.bundles.push_back({.from_W = X_WL.translation(),
                                  .direction_W = direction_W,
                                  .free_m = free_m_[number],
                                  .around_free_m = around_m_[number],
                                  .beams = columns * rings});
    }
  }
  return bundles_;
}

}  // namespace skein::agent
