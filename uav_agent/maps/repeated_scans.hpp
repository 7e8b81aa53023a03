// Finds repeated beams, which are not new evidence. While a UAV hovers, its LiDAR fires the same beams again: the
// servo's period is a whole number of scans, and the servo passes the same angles on its way back.
//
// Two scans are alike if the attitudes of the LiDAR differ by less than kTurnRad. Then beams with the same index are
// parallel. Such a pair counts as one beam if the distance between the two lines is less than a member's width. If
// the LiDAR was less than kNearM away at an earlier scan that is alike, all beams count as repeated: the safe side. If
// it was farther away, only those beams repeat whose direction is close to the line between the two positions.
// Units: metres, radians.   Threads: one.   Deterministic.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

class RepeatedScans {
 public:
  static constexpr double kTurnRad = 0.02;  ///< formula: this turn moves a beam by 0.05 m at 2.5 m
  static constexpr double kNearM = 0.25;    ///< nearer than this to a scan that is alike, all beams repeat; chosen

  /// @param member_width_m  parallel beams nearer to each other than this count as one.
  /// @param half_rad        for bundles: angle from a bundle's middle to its farthest beam; 0 for single beams.
  explicit RepeatedScans(double member_width_m, double half_rad = 0.0)
      : member_width_m_(member_width_m), half_rad_(half_rad) {}

  /// The beams of a scan that repeat earlier ones: all, or those within an angle of the line along about_W.
  struct Repeated {
    bool all = false;
    Vector3d about_W = Vector3d::UnitX();  ///< unit vector; either sense
    double cosine = 2.0;                   ///< of that angle; numeric: more than 1 is none

    bool operator()(const Eigen::Vector3f& direction_W) const {
      return all || std::abs(direction_W.cast<double>().dot(about_W)) > cosine;
    }
  };
  /// Compares a scan with the nearest earlier one that is alike, and remembers it unless all its beams repeat.
  Repeated ask(const Isometry3d& X_WL);

 private:
  double member_width_m_, half_rad_;
  std::vector<std::pair<Quaterniond, Vector3d>> scans_;  ///< attitude and position of each scan that was not repeated
};

}  // namespace skein::agent
