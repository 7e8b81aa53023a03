// Which views a UAV leaves for later: those that it could not reach a moment ago, those on the way to which it stands
// still, and those where another UAV is or is about to be.
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

  /// The flight core found no way to this view.
  void refuse(const Vector3d& p_WB, Tick now);
  /// There was no way to a view: of the others, those to which there is none either are refused for a while.
  void refuse_shut_off(const std::vector<FlockView>& views, const VoxelGrid& grid, const PlannerInput& in);
  /// Once per exchange in which the UAV works.   @param to_W  the view that it flies to, if it is not there yet.
  /// @returns whether it came no nearer for so long that it should leave that view: it counts as out of reach from now.
  bool stalls(const PlannerInput& in, const std::optional<Vector3d>& to_W);
  /// Forgets what lapsed.
  void update(Tick now);
  bool out_of_reach(const Vector3d& p_WB, const PlannerInput& in) const;

 private:
  struct Refused {
    Vector3d p_W;
    Tick until;
  };

  const AgentConfig& agent_;
  const FlockTalk& talk_;
  std::vector<Refused> refused_;
  Vector3d gained_p_W_ = Vector3d::Zero();  ///< where it last got on
  Tick gained_at_ = 0;
  std::optional<std::size_t> in_the_way_;  ///< a UAV that held this one up
  Tick gives_way_until_ = 0;
};

}  // namespace skein::agent
