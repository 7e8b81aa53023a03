// Recovery of a UAV that can reach none of its goals. The flight core tries an ordered list of recovery behaviours, one
// after the other, until the UAV reaches a goal again: look around, so that the LiDAR proves more space free; approach
// the goal that it missed; fly elsewhere; climb; fly back along its own trail. If the UAV's position no longer counts
// as free, because of structure discovered meanwhile, the UAV flies back at once; if that does not move it, straight to
// where it has more room.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <deque>
#include <iterator>
#include <optional>

#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/navigator.hpp"

namespace skein::agent {

class Recovery {
 public:
  /// @param config, filter, navigator  must outlive this.
  Recovery(const FlightConfig& config, SafetyFilter& filter, Navigator& navigator);

  /// Adds the UAV's position to its trail. Call it once per exchange, before the other functions.
  void update(const PlannerInput& in);
  /// Call it when a goal of the planner to which there was a path has ended. If the UAV is away from where it last had
  /// to recover, the next recovery starts with the first behaviour: a goal right there is no progress.
  void progress(const PlannerInput& in);
  /// Starts the next behaviour that is possible here. @param held  what holds the UAV. If it is another UAV, begin()
  /// skips two behaviours that do not help: to look around, and to approach the goal behind that UAV.
  void begin(const PlannerInput& in, const Held& held);
  /// Runs one exchange. @returns whether the behaviour has ended, so that the planner's goals count again.
  bool step(const PlannerInput& in, const Held& held, Steering& steering);
  /// The present behaviour, for display.
  Doing::What doing() const;

 private:
  enum class Behaviour { look_around, approach, elsewhere, climb, back, aside };

  static constexpr Behaviour kOrder[] = {Behaviour::look_around, Behaviour::approach, Behaviour::elsewhere,
                                         Behaviour::climb, Behaviour::back};
  static constexpr int kBehaviours = std::size(kOrder);

  bool set_out(const PlannerInput& in);
  bool go_back(const Vector3d& here_W);
  bool go_aside(const PlannerInput& in);

  const FlightConfig& config_;
  SafetyFilter& filter_;
  Navigator& navigator_;
  Vector3d begun_W_ = Vector3d::Zero();  ///< where the UAV was at begin()
  int tries_ = 0;                        ///< behaviours tried since progress()
  int backs_ = 0;                        ///< flights back along the trail since progress()
  Behaviour behaviour_ = kOrder[0];
  Tick until_ = 0;                ///< when the behaviour ends at the latest
  std::deque<Vector3d> trail_W_;  ///< where the UAV came from, oldest first, without loops
};

}  // namespace skein::agent
