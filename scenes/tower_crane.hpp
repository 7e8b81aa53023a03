// One tower crane with a hammerhead jib.   Frame: W.   Units: m, rad.   Threads: any.
#pragma once

#include <string>
#include <vector>

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {

struct TowerCranePlan {
  std::string name;
  Isometry3d X_WC = Isometry3d::Identity();  ///< origin on the ground in the middle of the mast, x across it
  double height = 0.0;                       ///< of the apex
  double jib_length = 0.0;
  double jib_heading = 0.0;  ///< in W
  double trolley = 0.0;      ///< its position, as a share of the jib's length
};

/// Appends a crane: foundation, mast with a climbing collar, turntable, cabin, tower head, jib with its trolley,
/// counter-jib with ballast, tie bars, ropes and hook. Everything that the plan does not specify is random.
/// @returns boxes around the mast, the head, the jib, the counter-jib and the hook.
std::vector<OrientedBox> add_tower_crane(MeshBuilder& builder, const TowerCranePlan& plan, RandomStream& random);

}  // namespace skein::sim
