// Cleans a LiDAR key frame before it enters the map: removes points on UAVs' bodies, isolated points and impossible
// points, and thins the rest to one point per voxel. Frame W.   Units: metres.   Pure: same cloud, same result.
#pragma once

#include <vector>

#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// A UAV whose body the LiDAR may have hit.
struct KnownBody {
  Vector3d p_W = Vector3d::Zero();
  double radius_m = 0.0;  ///< points within this distance of p_W lie on the body
};

/// Bodies sorted by x: a point is compared only with the few bodies near it, however large the fleet.
class KnownBodies {
 public:
  explicit KnownBodies(const std::vector<KnownBody>& bodies);
  /// Whether the point lies on one of the bodies.
  bool hold(const Vector3d& p_W) const;

 private:
  static double x_of(const KnownBody& body) { return body.p_W.x(); }

  std::vector<KnownBody> bodies_;
  double reach_ = 0.0;  ///< the largest radius, or a little more
};

class KeyFrameFilter {
 public:
  struct Config {
    double lowest_m = -1.0;    ///< points outside these heights are dropped; chosen
    double highest_m = 500.0;  ///< chosen
    /// Chosen: finer than the map's cells, or averaging would move hits into neighbouring cells.
    double voxel_m = 0.25;
    double lone_radius_m = 2.0;   ///< a point with fewer than lone_min_neighbours within this is dropped; chosen
    int lone_min_neighbours = 1;  ///< 0 keeps all points; low, since points on thin members must survive
  };

  KeyFrameFilter() : KeyFrameFilter(Config()) {}
  explicit KeyFrameFilter(const Config& config) : config_(config) {}

  /// @param bodies own body and those of other UAVs, as far as known.
  std::vector<Eigen::Vector3f> operator()(const std::vector<Eigen::Vector3f>& points_W,
                                          const std::vector<KnownBody>& bodies) const {
    return thinned(sound(points_W, KnownBodies(bodies)));
  }

  /// First part: removes points on bodies, points that are not finite, and points outside of plausible limits.
  std::vector<Eigen::Vector3f> sound(const std::vector<Eigen::Vector3f>& points_W, const KnownBodies& bodies) const;
  /// Second part, which takes most of the time: thins the points, then removes isolated ones.
  std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& sound_W) const;

 private:
  const Config config_;
};

}  // namespace skein::agent
