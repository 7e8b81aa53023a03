// The referee's records of captures, and the rule that turns captures into a score. The referee applies the rule to all
// captures (score earned), the station to the delivered ones (score).
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/scenario/scenario.hpp"

namespace skein {

/// One interest point in a capture; q = q_blur * q_res, in (0, 1].
struct CapturePoint {
  std::uint32_t index = 0;
  float q_blur = 0.0F, q_res = 0.0F, q = 0.0F;
  float q_distance = 0.0F;  ///< q_res of a surface at this depth that is parallel to the image plane
  bool operator==(const CapturePoint&) const = default;
};

/// One capture, with the points that it shows better than all earlier captures of this UAV.
struct CaptureReport {
  UavIndex uav = {};
  std::uint64_t capture = 0;  ///< 0, 1, ... without gaps for this UAV
  Tick tick = 0;
  std::uint64_t token = 0;  ///< proof of origin: only the camera and the ledger know it
  std::vector<CapturePoint> points;
  bool operator==(const CaptureReport&) const = default;
};

/// Number of exchanges after which a report that was not acknowledged is sent again.
inline constexpr std::uint64_t kResendSteps = 10;

/// An entry of the referee's ledger: a capture or a collision.
struct LedgerEntry {
  std::uint64_t index = 0;  ///< 0, 1, ... without gaps
  Tick tick = 0;
  UavIndex uav = {};
  bool collision = false;  ///< this UAV collided at `tick`; `capture` is empty
  CaptureReport capture;
  bool operator==(const LedgerEntry&) const = default;
};

/// The capture of a point that counts at present.
struct PointTally {
  float q = 0.0F;  ///< its quality; 0: there is no such capture
  UavIndex uav = {};
  std::uint64_t capture = 0;
  Tick tick = 0;
  bool operator==(const PointTally&) const = default;
};

/// A point whose PointTally changed.
struct TallyChange {
  std::uint32_t point = 0;
  PointTally now;
  bool operator==(const TallyChange&) const = default;
};

/// A point is detected if its quality is at least this, even if the rules let smaller qualities score.
inline constexpr float kDetectedQuality = 0.2F;

/// Score of a fleet. For each interest point, the best capture of the UAVs without a collision counts (of all UAVs if
/// `rules.collision_voids_score` is off). Ties go to the earlier capture, then to the UAV that is first in the fleet.
/// The result does not depend on the order in which captures and collisions come in, nor on repetitions.
class ScoreTable {
 public:
  ScoreTable(std::size_t uavs, std::size_t points, const RulesConfig& rules);

  /// Counts a capture. Points below `rules.min_point_score` are ignored.
  /// @returns the changes, in the order of the report.
  /// @throws std::out_of_range if the UAV or a point does not exist; then the table does not change.
  std::vector<TallyChange> add(const CaptureReport& report);

  /// If the rules say so, a UAV that collided loses all its points, including those of later captures.
  /// @returns the changes, by point.   @throws std::out_of_range if the UAV does not exist.
  std::vector<TallyChange> collide(UavIndex uav);

  const std::vector<PointTally>& points() const { return standing_; }
  double score() const;                      ///< sum over all points
  std::vector<double> score_by_uav() const;  ///< in fleet order; sums to score()
  std::size_t points_detected() const;       ///< points with a capture that counts, of kDetectedQuality or better

 private:
  PointTally best_of_fleet(std::uint32_t point) const;

  float min_score_;
  bool collision_voids_;
  std::vector<bool> void_;  ///< by UAV
  /// Best of each UAV, by point; only of points that the UAV has captured, because in a large fleet most UAVs see a
  /// small part of the site.
  std::vector<std::unordered_map<std::uint32_t, PointTally>> of_uav_;
  std::vector<PointTally> standing_;  ///< best of the fleet, by point
};

}  // namespace skein
