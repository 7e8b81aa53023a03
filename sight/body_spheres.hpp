// Finds the UAVs that a segment may hit: tests it against the bounding spheres of all bodies in a single sweep. In a
// large fleet most rays miss most bodies, and testing every body exactly would cost more than tracing the ray.
// Frame: W.   Units: m.   Threads: const calls from any thread, but not during set().
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::sim {

class BodySpheres {
 public:
  /// Sets a UAV's sphere. @param p_W  its centre. @param radius_m  its radius, large enough to contain the body.
  void set(UavIndex uav, const Vector3d& p_W, double radius_m);

  /// @param uavs  receives, in fleet order, every UAV whose sphere is within `margin_m` of the segment from `from_W` to
  ///   `to_W`, and maybe a few more (a conservative test). Previous content is lost.
  void about(const Vector3d& from_W, const Vector3d& to_W, double margin_m, std::vector<UavIndex>& uavs) const;

 private:
  static constexpr int kLanes = 16;
  using Lanes = Eigen::Array<float, kLanes, 1>;
  /// Single precision: about() adds a margin for rounding. Lanes without a UAV hold a sphere far away.
  struct Block {
    Lanes x = Lanes::Constant(1e18F), y = x, z = x, radius = Lanes::Zero();
  };
  std::vector<Block> blocks_;
};

}  // namespace skein::sim
