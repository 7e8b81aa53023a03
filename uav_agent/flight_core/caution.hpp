// The flight core's reactions to the uncertainty of the odometry, to wind and to the battery.
//   Clearance grows by drift_sigmas standard deviations of the position, and by what the mean wind pushes a UAV off its
//   setpoint. Structure that the UAV's own LiDAR has seen is off by the drift of its odometry since then; structure on
//   maps of other UAVs is off by the errors of both UAVs, and so are the other UAVs.
//   Speed is lower in gusts.
//   A UAV lands in time: it considers the remaining charge, the charge used per second so far, and the present wind.
// In a scenario without these conditions, nothing changes.   Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

class Caution {
 public:
  /// @param config, agent  must outlive this.
  Caution(const FlightConfig& config, const AgentConfig& agent);

  /// Call it once per exchange, before the other functions.
  void update(const PlannerInput& in);
  /// Position errors that the safety filter must add to its tracking errors.
  const ExpectedErrors& errors() const { return errors_; }
  /// Maximum speed in these gusts [m/s]; infinite while they are below 1 m/s.
  double most_mps() const { return most_mps_; }
  /// Whether the charge is only just enough to fly to the start and land there with the reserve left.
  bool must_land(const PlannerInput& in) const;
  /// Whether the charge is only just enough to land right here, and not to fly anywhere else.
  bool must_sink(const PlannerInput& in) const;
  /// Whether the UAV has a full battery, as before its first flight, or another one since it last had to land.
  bool has_full_battery(const PlannerInput& in) const;
  /// Time to fly from p_WB to above the start against the wind, and down to the ground [s].
  double way_down_s(const Vector3d& p_WB, const std::optional<Vector3d>& wind_W) const;

 private:
  double drift_since_seen_m(double told_m);
  void watch_peers(const PoseUncertainty& own, const Peers& peers, double pushed_m);
  void watch_wind(const std::optional<Vector3d>& wind_W);
  void watch_battery(const PlannerInput& in);

  const FlightConfig& config_;
  const AgentConfig& agent_;
  ExpectedErrors errors_;
  double most_mps_;
  double lost2_ = 0.0;  ///< position variance beyond the usual one, while and after the fix is lost [m^2]
  std::optional<Vector3d> mean_wind_W_;  ///< over the last 20 s or so
  double gusts2_ = 0.0;                  ///< mean square deviation from mean_wind_W_ [m^2/s^2]
  const double hover_per_s_;             ///< share of the capacity that hover in still air uses per second [1/s]
  double charge_per_s_;                  ///< share of the capacity used per second of flight [1/s]
  std::optional<double> last_charge_;
  Tick last_tick_ = 0;        ///< time of last_charge_
  bool has_another_ = false;  ///< another battery, since the UAV last had to land
};

}  // namespace skein::agent
