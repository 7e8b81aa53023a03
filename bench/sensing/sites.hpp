// The sites of the study: beside a mast in a box that is much too large for it, and between the legs of a gantry crane.
// Frame W.   Units: metres.
#pragma once

#include <string>

#include "core/scenario/scene.hpp"

namespace skein::bench {

struct Site {
  std::string name;          ///< "loose box"
  std::string stem;          ///< part of file names: "loose-box"
  std::string title, route;  ///< for captions
  Scene scene;
  Vector2d start = Vector2d::Zero();      ///< start of the UAV, on the ground
  Vector3d along_W = Vector3d::UnitZ();   ///< unit vector: direction of the flight after the hover
  Vector3d across_W = Vector3d::UnitX();  ///< unit vector, horizontal: points right in the vertical slice
  Vector3d middle_W = Vector3d::Zero();   ///< centre of the slices; both pass through the route
  double width_m = 72.0, depth_m = 60.0;  ///< size of the horizontal slice along x and y
  double top_m = 60.0;                    ///< height of the vertical slice above the ground
};

/// A mast of 150 m, 0.8 m thick, with guys of 5 cm, in one box of 85 m by 150 m by 153 m.
Site loose_box();
/// The scene `cranes`: lattice with members of 5 to 22 cm. @throws std::runtime_error if it has no girder.
Site lattice();

}  // namespace skein::bench
