// The interest points that a fleet's cameras have seen so far, and the score lost to odometry errors and wind.
// Scores in [0, 1] of each point.   Pure.
#pragma once

#include <vector>

#include "sight/camera.hpp"

namespace skein::sim {

class Simulation;

/// All by interest point.
struct PointsShown {
  std::vector<bool> seen;  ///< whether a camera ever saw the point, in any quality
  /// Best score that pictures would have had if each UAV had been where it believed to be (if_exact), or without wind
  /// (if_calm), if that exceeds its best score; else 0. Empty: no camera has such a picture (Camera::best_if_exact()).
  std::vector<float> if_exact, if_calm;
};

/// The points of a simulation as of now.
PointsShown points_shown(const Simulation& simulation);

}  // namespace skein::sim
