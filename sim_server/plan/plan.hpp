// Plans the flight of a fleet that knows the whole scene. Its score is a lower bound, found by search, of the score
// that is attainable in the mission's time. The plan selects views and their order for each UAV. Straight legs are
// clear of the structure, UAVs keep apart, and only pictures that are delivered in time count. A simulated flight
// verifies it. Frames: W world, ground z = 0; B body.   Units: SI, radians.
// Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scene.hpp"
#include "sim_server/plan/team.hpp"
#include "sim_server/plan/views.hpp"

namespace skein::sim {

/// A flight from rest to rest along a straight line, then rest until the next move begins. Times count from the first
/// command to the fleet, a moment before the mission's clock starts.
struct PlanMove {
  double from_s = 0.0, until_s = 0.0;
  Vector3d from_W = Vector3d::Zero(), to_W = Vector3d::Zero();  ///< of Bo
  double yaw = 0.0, pitch = 0.0;                                ///< of the camera at the end; yaw also of the body
  bool picture = false;                                         ///< a picture is taken during the rest at the end
};

/// The plan of one UAV.
struct PlanUav {
  std::string name;
  std::vector<PlanMove> moves;  ///< the first is the takeoff; empty: it stays on the ground
  double time_s = 0.0;          ///< when its last picture has been delivered
  double distance_m = 0.0;
  std::size_t views = 0;
};

/// Result of a flight of the plan in the simulation.
struct PlanFlight {
  double score = 0.0;  ///< of the pictures whose UAV was linked to the station afterwards
  std::size_t points = 0, collisions = 0;
  double astray_m = 0.0;  ///< maximum distance of any UAV from its planned position
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

/// Makes a plan; does not fly it (`flown` stays empty). Depends on nothing but its arguments.
Plan make_plan(const Scenario& scenario, const Scene& scene, const PlanConfig& config);

/// Flies a plan in the simulation with seed 0: each UAV follows its moves and reacts to nothing else.
PlanFlight fly_plan(const Scenario& scenario, const Scene& scene, const PlanConfig& config, const Plan& plan);

}  // namespace skein::sim
