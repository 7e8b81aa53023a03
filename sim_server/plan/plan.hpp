// What a fleet scores in the mission's time that knows the whole scene: a lower bound found by search. Views are chosen
// and put in order for all UAVs, each straight leg is clear of the structure, UAVs keep apart, and what is counted has
// been delivered in time. The plan is flown once with the true scene, to show that it can be.
// Frames: W world, ground z = 0; B body.   Units: SI, radians.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"
#include "sim_server/plan/team.hpp"
#include "sim_server/plan/views.hpp"

namespace skein::sim {

/// From rest to rest along a straight line, then at rest until the next move begins. Times count from the first
/// command to the fleet, a moment before the mission's clock starts.
struct PlanMove {
  double from_s = 0.0, until_s = 0.0;
  Vector3d from_W = Vector3d::Zero(), to_W = Vector3d::Zero();  ///< of Bo
  double yaw = 0.0, pitch = 0.0;                                ///< of the camera at its end; yaw is the body's, too
  bool picture = false;                                         ///< the rest at its end is for one
};

/// What one UAV does.
struct PlanUav {
  std::string name;
  std::vector<PlanMove> moves;  ///< the first is the take-off; empty: it stays on the ground
  double time_s = 0.0;          ///< when it has delivered its last picture
  double distance_m = 0.0;
  std::size_t views = 0;
};

/// What the same plan scored in the simulation.
struct PlanFlight {
  double score = 0.0;  ///< of what was linked to the station after it was taken
  std::size_t points = 0, collisions = 0;
  double astray_m = 0.0;  ///< the farthest that any UAV was from where the plan had it
  bool operator==(const PlanFlight&) const = default;
};

struct Plan {
  double score = 0.0;  ///< sum over all points of the best quality at the plan's views
  std::size_t points = 0;
  std::size_t views = 0;
  double margin_m = 0.0;
  std::vector<PlanUav> uavs;  ///< in fleet order
  PlanFlight flown;
};

/// Without the flight. Depends on nothing but its arguments.
Plan make_plan(const Scenario& scenario, const Scene& scene, const PlanConfig& config);

/// Flies a plan in the simulation, without draws of a seed: each UAV follows its moves, whatever happens.
PlanFlight fly_plan(const Scenario& scenario, const Scene& scene, const PlanConfig& config, const Plan& plan);

}  // namespace skein::sim
