// What a capture is worth: the records of the referee, and the one rule that turns captures into a score.
// The referee counts what was earned with it, the station what was delivered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scenario.hpp"

namespace skein {

/// One interest point in a capture; q = q_blur * q_res, in (0, 1].
struct CapturePoint {
  std::uint32_t index = 0;
  float q_blur = 0.0F, q_res = 0.0F, q = 0.0F;
  float q_distance = 0.0F;  ///< what q_res would be of a surface that faces the camera at this depth
  bool operator==(const CapturePoint&) const = default;
};

/// The points of one capture that this UAV had not seen as well before.
struct CaptureReport {
  UavIndex uav = {};
  std::uint64_t capture = 0;  ///< 0, 1, ... without gaps for this UAV
  Tick tick = 0;
  std::uint64_t token = 0;  ///< known only to the camera and the ledger
  std::vector<CapturePoint> points;
  bool operator==(const CaptureReport&) const = default;
};

/// A report that is not acknowledged is sent again after so many exchanges.
inline constexpr std::uint64_t kResendSteps = 10;

/// What the referee wrote down.
struct LedgerEntry {
  std::uint64_t index = 0;  ///< 0, 1, ... without gaps
  Tick tick = 0;
  UavIndex uav = {};
  bool collision = false;  ///< this UAV collided at `tick`; `capture` is empty
  CaptureReport capture;
  bool operator==(const LedgerEntry&) const = default;
};

/// Whose capture of a point counts at present.
struct PointTally {
  float q = 0.0F;  ///< 0: nobody's
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

/// A point is detected from this quality on, whatever less the rules let count.
inline constexpr float kDetectedQuality = 0.2F;

/// Score of a fleet. For each interest point counts the best capture among the UAVs without a collision (of all UAVs
/// when `rules.collision_voids_score` is off); ties go to the earlier capture, then to the UAV that stands first in the
/// fleet. The result does not depend on the order in which captures and collisions come in, nor on repetitions.
class ScoreTable {
 public:
  ScoreTable(std::size_t uavs, std::size_t points, const RulesConfig& rules);

  /// Counts a capture. Points below `rules.min_point_score` are passed over.
  /// @returns what changed, in the order of the report.
  /// @throws std::out_of_range when the UAV or a point does not exist; then nothing was counted.
  std::vector<TallyChange> add(const CaptureReport& report);

  /// Takes all points from a UAV that collided, those to come too, if the rules say so.
  /// @returns what changed, by point.   @throws std::out_of_range when the UAV does not exist.
  std::vector<TallyChange> collide(UavIndex uav);

  const std::vector<PointTally>& points() const { return standing_; }
  double score() const;                      ///< sum over all points
  std::vector<double> score_by_uav() const;  ///< in fleet order; sums to score()
  std::size_t points_detected() const;       ///< points with a capture that counts, of kDetectedQuality or better

 private:
  PointTally best_of_fleet(std::uint32_t point) const;

  float min_score_;
  bool collision_voids_;
  std::vector<bool> void_;                       ///< by UAV
  std::vector<std::vector<PointTally>> of_uav_;  ///< best of each UAV, by point
  std::vector<PointTally> standing_;             ///< best of the fleet, by point
};

}  // namespace skein
