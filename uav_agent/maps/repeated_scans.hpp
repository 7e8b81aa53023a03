// Beams that repeat each other: of a UAV that hovers, the servo's period is a whole number of scans, so that each
// period fires the same beams, and so do both ways of the servo. They prove no more than once.
//
// Two scans are alike if their LiDARs stood within kTurnRad of the same attitude. Of two that are alike, beams with the
// same place in the scan are parallel; they are one if the line from the one LiDAR to the other, seen along them, is
// shorter than a member is thick. So a scan says nothing new near to one that is like it, and farther on all but
// beams about the direction of that line.
// Units: metres, radians.   Threads: one.   Deterministic.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

class RepeatedScans {
 public:
  static constexpr double kTurnRad = 0.02;  ///< turned by more, a beam 2.5 m away passes elsewhere
  static constexpr double kNearM = 0.25;    ///< what is nearer than this to one that is alike says nothing new

  /// @param member_width_m  beams this near to each other are one.
  /// @param half_rad        who asks about bundles: from the middle of one to its farthest beam.
  explicit RepeatedScans(double member_width_m, double half_rad = 0.0)
      : member_width_m_(member_width_m), half_rad_(half_rad) {}

  /// Which beams of a scan were fired before.
  struct Repeated {
    bool all = false;
    Vector3d about_W = Vector3d::UnitX();  ///< unit vector; those whose direction is within this angle of its line
    double cosine = 2.0;                   ///< of that angle; more than 1: none

    bool operator()(const Eigen::Vector3f& direction_W) const {
      return all || std::abs(direction_W.cast<double>().dot(about_W)) > cosine;
    }
  };
  /// Asks, and remembers the scan unless all of it was fired before.
  Repeated ask(const Isometry3d& X_WL);

 private:
  double member_width_m_, half_rad_;
  std::vector<std::pair<Quaterniond, Vector3d>> scans_;  ///< all that said something new
};

}  // namespace skein::agent
