// Which UAVs a straight line may meet at all: their bodies as spheres, against one segment in a single sweep. In a
// large fleet most lines pass most bodies by, and to ask each body costs more than the ray.
// Frame: W.   Units: m.   Threads: const calls from any, not beside set().
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::sim {

class BodySpheres {
 public:
  /// @param radius_m  of a sphere about `p_W` that holds the body.
  void set(UavIndex uav, const Vector3d& p_W, double radius_m);

  /// @param uavs  receives, in the order of the fleet, all whose sphere is met by any segment with ends within
  ///   `margin_m` of these ones, and maybe a few more.
  void about(const Vector3d& from_W, const Vector3d& to_W, double margin_m, std::vector<UavIndex>& uavs) const;

 private:
  static constexpr int kLanes = 16;
  using Lanes = Eigen::Array<float, kLanes, 1>;
  /// In single precision, which about() allows for. Lanes without a UAV are far away.
  struct Block {
    Lanes x = Lanes::Constant(1e18F), y = x, z = x, radius = Lanes::Zero();
  };
  std::vector<Block> blocks_;
};

}  // namespace skein::sim
