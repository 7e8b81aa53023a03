// Landing of a UAV whose battery is nearly empty: the flight to a place to land, and the descent. The UAV tries, in
// this order, its landing place (landing_place.hpp), its start, and places around the landing place. If a UAV without a
// LiDAR finds no path through proved space, it treats unknown space as free, since it would fall otherwise. A UAV that
// finds no path to any of these places, or whose charge is only just enough to land right here, sinks where it is.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <vector>

#include "uav_agent/flight_core/navigator.hpp"

namespace skein::agent {

class Landing {
 public:
  static constexpr double kFromM = 5.0;  ///< height above a site from which the UAV sinks slowly; chosen
  /// Time to sink from a height to the ground [s]: with climb_mps down to kFromM, then with land_mps.
  static double descent_s(double height_m, const FlightConfig& config);

  /// @param config, agent, filter, navigator  must outlive this.
  Landing(const FlightConfig& config, const AgentConfig& agent, SafetyFilter& filter, Navigator& navigator)
      : config_(config), agent_(agent), filter_(filter), navigator_(navigator) {}

  /// Stops the UAV, and computes its landing place. Call it once, before step().
  void begin(Steering& steering);
  /// Runs one exchange.   @param must_sink  the charge is only just enough to land right here.
  void step(const PlannerInput& in, bool must_sink, Steering& steering);
  /// Whether the UAV stands on the ground after step().
  static bool landed(const PlannerInput& in) { return in.tracking.setpoint.p_WB.z() < 0.0; }
  /// Path from the setpoint to a place on the ground; from above kFromM, its last kFromM lead straight down.
  Path down_at(const Vector3d& place_W, const PlannerInput& in) const;

 private:
  void find_sites(const PlannerInput& in);
  bool was_held_above(const Vector3d& site_W) const;
  void fly_to_site(const PlannerInput& in, bool must_sink, Steering& steering);
  void sink(const PlannerInput& in, bool must_sink, Steering& steering);
  void begin_descent(const Vector3d& place_W, const PlannerInput& in, Steering& steering);

  const FlightConfig& config_;
  const AgentConfig& agent_;
  SafetyFilter& filter_;
  Navigator& navigator_;
  Vector3d place_W_ = Vector3d::Zero();  ///< its landing place, on the ground
  std::vector<Vector3d> sites_W_;        ///< on the ground; index is -1 - Goal::id
  std::vector<Vector3d> held_above_W_;   ///< sites above which the safety filter held the UAV
  std::optional<Vector3d> descends_at_W_;
  double lowest_m_ = 0.0;  ///< least height of the setpoint in this descent, reached at sank_at_
  Tick sank_at_ = 0;
};

}  // namespace skein::agent
