// Flies an explorer along its lanes in the first stage of KIOS, straight from one end of a lane to the other. A corner
// that the explorer cannot reach is tried again, and then skipped.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <deque>
#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class KiosMapping {
 public:
  explicit KiosMapping(double speed_mps) : speed_mps_(speed_mps) {}

  /// @param corners_W  two for each lane, in the order of flight.
  void begin(std::vector<Vector3d> corners_W) { left_W_.assign(corners_W.begin(), corners_W.end()); }
  bool done() const { return left_W_.empty(); }
  const std::deque<Vector3d>& left_W() const { return left_W_; }

  /// Call it once per exchange in which FlightState::working.
  /// @param id  of the last goal; raised by one for a new goal.
  void step(const PlannerInput& in, std::int64_t& id, PlannerOutput& out);

 private:
  void handle_outcome(const Outcome& outcome, Tick now);

  double speed_mps_;
  std::deque<Vector3d> left_W_;  ///< corners that are left, in order
  std::size_t asked_ = 0;        ///< number of corners in the current goal; 0: no goal
  std::int64_t goal_ = 0;
  int failures_ = 0;  ///< failures at the next corner
  Tick not_before_ = 0;
};

}  // namespace skein::agent
