// What the flight core makes of what it is told beside its state: how sure its odometry is, the wind, the battery.
//   Clearance: so many deviations of the told position, and what wind of that strength pushes a UAV off its setpoint.
//   What a UAV's own LiDAR has seen is off by what its odometry has drifted since; what others have told of, by the
//   errors of both.
//   Speed: less in gusts.
//   Way home: by the charge that is left and what a second has cost so far, against the wind that blows.
// In a world that tells nothing of this, nothing changes.   Frame W.   Units: SI.   Threads: one.
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

  /// Once per exchange, before anything else.
  void update(const PlannerInput& in);
  const ExpectedErrors& errors() const { return errors_; }
  /// How fast it may fly in these gusts [m/s]; infinite in still air.
  double most_mps() const { return most_mps_; }
  /// Whether the charge is only just enough for the way to its start and down, with the reserve left.
  bool must_land(const PlannerInput& in) const;
  /// Time from a place to its start against the wind, and down to the ground [s].
  double way_down_s(const Vector3d& p_WB, const std::optional<Vector3d>& wind_W) const;

 private:
  double drift_since_seen_m(double told_m);
  void watch_wind(const std::optional<Vector3d>& wind_W);
  void watch_battery(const PlannerInput& in);

  const FlightConfig& config_;
  const AgentConfig& agent_;
  ExpectedErrors errors_;
  double most_mps_;
  double lost2_ = 0.0;                   ///< variance beyond the usual one: the fix is lost, or was until now [m^2]
  std::optional<Vector3d> mean_wind_W_;  ///< over the last 20 s or so
  double gusts2_ = 0.0;                  ///< mean square about it [m^2/s^2]
  double charge_per_s_;                  ///< what a second costs
  std::optional<double> last_charge_;
  Tick last_tick_ = 0;  ///< of last_charge_
};

}  // namespace skein::agent
