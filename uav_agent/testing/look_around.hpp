// For tests: key frames of a LiDAR whose servo turns it about x, of which nothing near by was hit.
#pragma once

#include <cmath>

#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

inline void look_around(OccupancyMap& map, const Vector3d& p_WS, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    const double turn = 2.4 * frame;  // no two alike
    map.look_from(p_WS, {0.0, std::sin(turn), std::cos(turn)});
  }
}

}  // namespace skein::agent
