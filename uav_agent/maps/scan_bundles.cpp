#include "uav_agent/maps/scan_bundles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Divides `count` indices into runs of `size`, of which the first has only `shift` (0: also `size`).
/// @returns where each run begins, and where the last one ends.
std::vector<int> edges(int count, int size, int shift) {
  std::vector<int> edges = {0};
  for (int edge = shift > 0 ? shift : size; edge < count; edge += size) edges.push_back(edge);
  edges.push_back(count);
  return edges;
}

}  // namespace

ScanBundler::Grid::Grid(const LidarConfig& lidar, int columns, int rings, int column_shift, int ring_shift)
    : column_edges(edges(lidar.columns, columns, column_shift)), ring_edges(edges(lidar.rings, rings, ring_shift)) {
  for (int level = 0; level < up(); ++level) {
    for (int side = 0; side < across(); ++side) {
      Vector3d middle_L = Vector3d::Zero();
      for (int ring = ring_edges[at(level)]; ring < ring_edges[at(level + 1)]; ++ring) {
        for (int column = column_edges[at(side)]; column < column_edges[at(side + 1)]; ++column) {
          middle_L += lidar_direction_L(lidar, ring, column);
        }
      }
      middles_L.push_back(middle_L.normalized());
    }
  }
}

ScanBundler::ScanBundler(const LidarConfig& lidar, double bundle_rad) : lidar_(lidar) {
  const double column_rad = 2.0 * std::numbers::pi / lidar.columns;
  const double ring_rad = lidar.rings > 1 ? ring_elevation(lidar, 1) - ring_elevation(lidar, 0) : 1.0;
  columns_ = std::clamp(static_cast<int>(bundle_rad / column_rad), 1, lidar.columns);
  rings_ = std::clamp(static_cast<int>(bundle_rad / ring_rad), 1, lidar.rings);
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      directions_L_.push_back(lidar_direction_L(lidar, ring, column).cast<float>());
    }
  }
  for (int ring_shift = 0; ring_shift < rings_; ++ring_shift) {
    for (int column_shift = 0; column_shift < columns_; ++column_shift) {
      grids_.emplace_back(lidar, columns_, rings_, column_shift, ring_shift);
    }
  }
  half_rad_ = 0.5 * std::hypot((columns_ - 1) * column_rad, (rings_ - 1) * ring_rad);
}

const ScanBundler::Grid& ScanBundler::grid_of(Tick tick) const {
  const auto scan = static_cast<int>(tick / lidar_period(lidar_) % (2 * columns_ * rings_));
  return grids_[static_cast<std::size_t>(scan / 2 % rings_ * columns_ + scan % columns_)];
}

void ScanBundler::find_free(const BeamScan& scan, const Grid& grid, const TubeFree& near_free,
                            const ClearWay& clear_way) {
  const double near_m = lidar_.range_min_m;
  const BeamScan::Firing* asked = nullptr;
  bool all_near_free = false;
  for (int side = 0; side < grid.across(); ++side) {
    const int first_column = grid.column_edges[at(side)], end_column = grid.column_edges[at(side + 1)];
    const BeamScan::Firing& firing = scan.firing((first_column + end_column) / 2);
    const Isometry3d& X_WL = firing.X_WL;
    if (&firing != asked) all_near_free = near_free(X_WL.translation(), X_WL.translation(), near_m);
    asked = &firing;
    for (int level = 0; level < grid.up(); ++level) {
      const std::size_t number = grid.number(level, side);
      auto free_m = static_cast<float>(lidar_.range_max_m);
      bool any_none = false;
      for (int ring = grid.ring_edges[at(level)]; ring < grid.ring_edges[at(level + 1)]; ++ring) {
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
        const Vector3d from_W = X_WL.translation(), to_W = X_WL * (near_m * grid.middles_L[number]);
        if (!near_free(from_W, to_W, near_m * half_rad_)) free_m = 0.0F;
      }
      if (any_none && clear_way && free_m > 0.0F) {
        const Vector3d direction_W = X_WL.linear() * grid.middles_L[number];
        free_m = static_cast<float>(clear_way(X_WL.translation(), direction_W, free_m));
      }
      free_m_[number] = free_m;
    }
  }
}

/// Sets around_m_ to the minimum of free_m_ over each bundle and its neighbours: first along the rings, which are
/// closed, then across the rings. Beyond the outermost rings there are no beams that could contradict.
void ScanBundler::look_around(const Grid& grid) {
  const int across = grid.across(), up = grid.up();
  for (int level = 0; level < up; ++level) {
    for (int side = 0; side < across; ++side) {
      float least = free_m_[grid.number(level, side)];
      for (int step = 1; step <= std::min(kAround, across / 2); ++step) {
        const float before = free_m_[grid.number(level, (side - step + across) % across)];
        const float after = free_m_[grid.number(level, (side + step) % across)];
        least = std::min({least, before, after});
      }
      row_[grid.number(level, side)] = least;
    }
  }
  for (int level = 0; level < up; ++level) {
    for (int side = 0; side < across; ++side) {
      float least = row_[grid.number(level, side)];
      for (int other = std::max(0, level - kAround); other <= std::min(up - 1, level + kAround); ++other) {
        least = std::min(least, row_[grid.number(other, side)]);
      }
      around_m_[grid.number(level, side)] = least;
    }
  }
}

const ScanBundler::Bundles& ScanBundler::bundle(const BeamScan& scan, const RepeatedScans::Repeated& repeated,
                                                const TubeFree& near_free, const ClearWay& clear_way) {
  bundles_.bundles.clear();
  bundles_.hits_W.clear();
  if (scan.doubt != ScanDoubt::none) return bundles_;
  const Grid& grid = grid_of(scan.tick);
  free_m_.resize(grid.middles_L.size());
  row_.resize(grid.middles_L.size());
  around_m_.resize(grid.middles_L.size());
  find_free(scan, grid, near_free, clear_way);
  look_around(grid);
  for (int level = 0; level < grid.up(); ++level) {
    const int rings = grid.ring_edges[at(level + 1)] - grid.ring_edges[at(level)];
    for (int side = 0; side < grid.across(); ++side) {
      const std::size_t number = grid.number(level, side);
      if (free_m_[number] <= 0.0F) continue;
      const int first_column = grid.column_edges[at(side)], columns = grid.column_edges[at(side + 1)] - first_column;
      const Isometry3d& X_WL = scan.firing(first_column + columns / 2).X_WL;
      const Eigen::Vector3f direction_W = (X_WL.linear() * grid.middles_L[number]).cast<float>();
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
