// LiDAR points of one UAV for the page: the hits of its scans since the points were last taken, thinned out.
// Frame W.   Units: metres.   Not thread-safe.   Bounded: `most_kept` points.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace skein::view {

class ScanPoints {
 public:
  /// add() leaves out points below this height: the ground is level and known, and most hits are on it.
  static constexpr double kGround_m = 0.3;
  /// add() keeps at most one point in each cube of this edge.
  static constexpr double kCell_m = 0.5;
  static constexpr std::size_t kMostKept = 8'000;

  explicit ScanPoints(std::size_t most_kept = kMostKept) : most_kept_(most_kept) {}

  /// Also leaves out points that packed_points() would leave out: they must not take the place of others.
  void add(std::span<const Eigen::Vector3f> points_W);
  bool empty() const { return points_W_.empty(); }
  /// Returns at most `most` points, picked evenly, and removes all. Later points in the same cubes count again.
  std::vector<Eigen::Vector3f> take(std::size_t most);
  /// Returns and removes all points. add() leaves out later points in the same cubes.
  std::vector<Eigen::Vector3f> take_new() { return std::exchange(points_W_, {}); }

 private:
  std::size_t most_kept_;
  std::vector<Eigen::Vector3f> points_W_;
  std::unordered_set<std::uint64_t> cells_;
};

/// Encodes each point as three 16-bit integers [dm], all in base64, which web/src/packed.js decodes. Leaves out points
/// that are not finite, or that have a coordinate outside the integers' range (3.2 km).
std::string packed_points(std::span<const Eigen::Vector3f> points_W);

struct PointsStep {
  double time_s = 0.0;  ///< time of the newest scan
  std::vector<Eigen::Vector3f> points_W = {};
};

/// The JSON text of the points for Feed::set_cloud(). @param steps  in order of time.
std::string lidar_text(const std::string& uav, std::span<const PointsStep> steps);

}  // namespace skein::view
