// LiDAR points of one UAV as a page is told them: what its scans have met since it was told last, thinned out.
// Frame W.   Units: metres.   Not thread-safe.   Bounded: so many points as its maker says.
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
  /// Points of the ground are left out: it is level and known, and would be most of what is told.
  static constexpr double kGround_m = 0.3;
  /// One point in each cube of this edge.
  static constexpr double kCell_m = 0.5;
  static constexpr std::size_t kMostKept = 8'000;

  explicit ScanPoints(std::size_t most_kept = kMostKept) : most_kept_(most_kept) {}

  void add(std::span<const Eigen::Vector3f> points_W);
  bool empty() const { return points_W_.empty(); }
  /// @param most  of what there is, evenly chosen. It is forgotten then.
  std::vector<Eigen::Vector3f> take(std::size_t most);
  /// All that there is. What lies in the same cubes comes no more.
  std::vector<Eigen::Vector3f> take_for_good() { return std::exchange(points_W_, {}); }

 private:
  std::size_t most_kept_;
  std::vector<Eigen::Vector3f> points_W_;
  std::unordered_set<std::uint64_t> cells_;
};

/// Three whole numbers of 16 bits a point, in dm, as base64; what lies farther away than these reach is left out.
/// web/src/packed.js reads it.
std::string packed_points(std::span<const Eigen::Vector3f> points_W);

struct PointsStep {
  double time_s = 0.0;  ///< of the newest
  std::vector<Eigen::Vector3f> points_W = {};
};

/// What a browser is told (Feed::set_cloud()). @param steps  by time.
std::string lidar_text(const std::string& uav, std::span<const PointsStep> steps);

}  // namespace skein::view
