// Cleans a LiDAR key frame before it enters the map: other UAVs' bodies, lone and absurd points are taken out,
// and what remains is thinned to one point a voxel. Frame W.   Units: metres.   Pure: same cloud, same result.
#pragma once

#include <vector>

#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// A UAV whose body the LiDAR may have hit.
struct KnownBody {
  Vector3d p_W = Vector3d::Zero();
  double radius_m = 0.0;  ///< points closer than this are its own
};

/// From west to east: a point is held against the few that may hold it, however large the fleet.
class KnownBodies {
 public:
  explicit KnownBodies(const std::vector<KnownBody>& bodies);
  /// Whether the point is of one of them.
  bool hold(const Vector3d& p_W) const;

 private:
  static double x_of(const KnownBody& body) { return body.p_W.x(); }

  std::vector<KnownBody> bodies_;
  double reach_ = 0.0;  ///< the largest radius, or a little more
};

class KeyFrameFilter {
 public:
  struct Config {
    double lowest_m = -1.0;  ///< points outside these heights are dropped
    double highest_m = 500.0;
    double voxel_m = 0.25;        ///< finer than the map's cells, or hits would wander between them
    double lone_radius_m = 2.0;   ///< a point with no other point this near is dropped...
    int lone_min_neighbours = 1;  ///< ...0 keeps all; thin members must survive, so this stays low
  };

  KeyFrameFilter() : KeyFrameFilter(Config()) {}
  explicit KeyFrameFilter(const Config& config) : config_(config) {}

  /// @param bodies own body and those of UAVs in line of sight.
  std::vector<Eigen::Vector3f> operator()(const std::vector<Eigen::Vector3f>& points_W,
                                          const std::vector<KnownBody>& bodies) const {
    return thinned(sound(points_W, KnownBodies(bodies)));
  }

  /// First part: without bodies and what is absurd.
  std::vector<Eigen::Vector3f> sound(const std::vector<Eigen::Vector3f>& points_W, const KnownBodies& bodies) const;
  /// Second part, which takes most of the time: thinned, without lone points.
  std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& sound_W) const;

 private:
  const Config config_;
};

}  // namespace skein::agent
