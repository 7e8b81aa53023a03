// A UAV's stay at a view: until the camera has taken the picture, or has not turned to the view in time.
// Frame W.   Units: SI and radians.   Threads: one.   Deterministic.
#pragma once

#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/flock/views.hpp"

namespace skein::agent {

class FlockStay {
 public:
  /// Call it in each exchange on the way to a view and there.   @returns whether the UAV is done with the view.
  bool done(const FlockView& view, const PlannerInput& in, const VehicleConfig& vehicle);
  bool arrived() const { return there_since_.has_value(); }
  bool aimed() const { return aimed_since_.has_value(); }  ///< the camera looks as the view wants
  void leave_place() { there_since_.reset(); }             ///< the UAV sets out to another view
  void end();

 private:
  std::optional<Tick> there_since_, aimed_since_;
};

}  // namespace skein::agent
