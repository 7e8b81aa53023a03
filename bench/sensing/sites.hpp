// Where the explorer is shown: beside a mast in a box that is far too large for it, and between the legs of a gantry
// crane.
// Frame W.   Units: metres.
#pragma once

#include <string>

#include "core/scene.hpp"

namespace skein::bench {

struct Site {
  std::string name;          ///< "loose box"
  std::string stem;          ///< of its files' names: "loose-box"
  std::string title, route;  ///< in words, for a caption
  Scene scene;
  Vector2d start = Vector2d::Zero();      ///< of the UAV, on the ground
  Vector3d along_W = Vector3d::UnitZ();   ///< unit vector: where it flies after it has hovered
  Vector3d across_W = Vector3d::UnitX();  ///< unit vector, horizontal: to the right in the vertical slice
  Vector3d middle_W = Vector3d::Zero();   ///< of the slices; both pass through the route
  double width_m = 72.0, depth_m = 60.0;  ///< of the horizontal slice, along x and y
  double top_m = 60.0;                    ///< of the vertical slice, which begins at the ground
};

/// A mast of 150 m, 0.8 m thick, with guys of 5 cm, in one box of 85 m by 150 m by 153 m.
Site loose_box();
/// The scene `cranes`: lattice with members of 5 to 22 cm.
Site lattice();

}  // namespace skein::bench
