// LiDAR points of one UAV for the page: the hits of its scans since the page was last sent some, thinned out.
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
  /// Points below this height are left out: the ground is level and known, and would be most of the points.
  static constexpr double kGround_m = 0.3;
  /// At most one point is kept in each cube of this edge.
  static constexpr double kCell_m = 0.5;
  static constexpr std::size_t kMostKept = 8'000;

  explicit ScanPoints(std::size_t most_kept = kMostKept) : most_kept_(most_kept) {}

  /// Points that packed_points() would leave out are left out here, too: they must not take the place of others.
  void add(std::span<const Eigen::Vector3f> points_W);
  bool empty() const { return points_W_.empty(); }
  /// Returns at most `most` of the points, evenly picked, and clears all: later points in the same cubes count again.
  std::vector<Eigen::Vector3f> take(std::size_t most);
  /// Returns and removes all points. Their cubes stay taken: later points in them are dropped.
  std::vector<Eigen::Vector3f> take_for_good() { return std::exchange(points_W_, {}); }

 private:
  std::size_t most_kept_;
  std::vector<Eigen::Vector3f> points_W_;
  std::unordered_set<std::uint64_t> cells_;
};

/// Encodes each point as three 16-bit integers [dm], all in base64. Points outside their range (3.2 km), or without a
/// finite place, are left out.
/// web/src/packed.js decodes the text.
std::string packed_points(std::span<const Eigen::Vector3f> points_W);

struct PointsStep {
  double time_s = 0.0;  ///< time of the newest scan
  std::vector<Eigen::Vector3f> points_W = {};
};

/// The text of the points for Feed::set_cloud(). @param steps  in order of time.
std::string lidar_text(const std::string& uav, std::span<const PointsStep> steps);

}  // namespace skein::view
