// Views that a UAV leaves out for a while: near a view that it recently could not reach, or was held up on the way to;
// near a UAV in line of sight, or near the next view of a UAV with a lower index; or in the direction of a UAV that
// recently held this one up.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/flock/talk.hpp"
#include "uav_agent/planners/flock/views.hpp"

namespace skein::agent {

class FlockReach {
 public:
  /// @param agent, talk  must outlive this.
  FlockReach(const AgentConfig& agent, const FlockTalk& talk) : agent_(agent), talk_(talk) {}

  /// The flight core found no path to this view: it and those near it are out of reach for a while.
  void refuse(const Vector3d& p_WB, Tick now);
  /// Call it after a view had no path: also refuses, for a while, those of `views` that the known free space shuts off.
  void refuse_shut_off(const std::vector<FlockView>& views, const VoxelGrid& grid, const PlannerInput& in);
  /// Call it in each exchange in which the UAV works.   @param to_W  the view that it flies to; nullopt: it is there.
  /// @returns whether the UAV has hardly moved for so long that it should leave this view, now out of reach.
  bool stalls(const PlannerInput& in, const std::optional<Vector3d>& to_W);
  /// Forgets refusals that have expired.
  void update(Tick now);
  bool out_of_reach(const Vector3d& p_WB, const PlannerInput& in) const;
  /// Whether another UAV is at the place, flies to it, or is in the way. If so, the place is out of reach, too.
  bool taken(const Vector3d& p_WB, const PlannerInput& in) const;
  /// Places of the first `most` of these views that are not taken.
  std::vector<Vector3d> not_taken(const std::vector<FlockView>& views, std::size_t most, const PlannerInput& in) const;
  /// The first of these views that is in reach.
  std::optional<FlockView> first(const std::vector<FlockView>& views, const PlannerInput& in) const;

 private:
  struct Refused {
    Vector3d p_W;
    Tick until;
  };

  const AgentConfig& agent_;
  const FlockTalk& talk_;
  std::vector<Refused> refused_;
  Vector3d gained_p_W_ = Vector3d::Zero();  ///< the place from which it has hardly moved since gained_at_
  Tick gained_at_ = 0;
  std::optional<std::size_t> in_the_way_;  ///< index of the UAV that last held this one up
  Tick gives_way_until_ = 0;
};

}  // namespace skein::agent
