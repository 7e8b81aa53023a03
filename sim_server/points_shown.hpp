// What the cameras of a fleet have shown of each interest point so far. Pure.
#pragma once

#include <vector>

#include "sight/camera.hpp"

namespace skein::sim {

class Simulation;

/// By interest point.
struct PointsShown {
  std::vector<bool> seen;  ///< it was ever in a picture and in sight, whatever its quality
  /// The best score that pictures would have had if each UAV had been where it believed to be, and without wind, where
  /// that is more than its best score; else 0. Empty: no camera has taken such a picture (Camera::best_if_exact).
  std::vector<float> if_exact, if_calm;
};

PointsShown points_shown(const Simulation& simulation);

}  // namespace skein::sim
