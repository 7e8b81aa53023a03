// What the scenario's conditions do to one UAV: the air about it, what it believes of its own state, its battery.
// With all conditions off every function gives back what it was given, bit for bit.
// Frames: W world, B body.  Units: SI.  Threads: one.
#pragma once

#include <deque>
#include <optional>

#include "core/scenario.hpp"
#include "core/told_state.hpp"
#include "sight/camera.hpp"
#include "sim_server/conditions/battery.hpp"
#include "sim_server/conditions/odometry_error.hpp"
#include "sim_server/conditions/wind.hpp"
#include "sim_server/conditions/wind_push.hpp"
#include "sim_server/flight/vehicle.hpp"

namespace skein::sim {

/// A state as a UAV is told it, and when that was so.
struct ToldState {
  Tick tick = 0;
  RigidBodyState state;
};

/// What a battery has given.
struct BatteryUse {
  double capacity_wh = 0.0, given_wh = 0.0, mean_power_w = 0.0;
  std::optional<Tick> empty;             ///< since when
  std::optional<double> last_in_flight;  ///< share of the charge when the UAV was last airborne; nullopt: never
};

class Surroundings {
 public:
  /// @param scenario  must outlive this.
  Surroundings(const Scenario& scenario, std::uint64_t seed, UavIndex uav);

  /// @param conditions  as the constructor's but for what faults change: for the ticks that follow.
  void change(const ConditionsConfig& conditions);
  /// Before the first tick of an exchange.
  void begin_exchange();
  /// What faults do in an exchange. @param fix_lost  the UAV has no position fix. @param most_charge  share of the
  /// capacity that the battery can have.
  void suffer(bool fix_lost, double most_charge);
  /// Before each tick. @param gust_W  by which a fault makes the air faster.
  void begin_tick(Tick tick, const RigidBodyState& state, const Vector3d& gust_W);
  /// The wrench of a vehicle in this air, which is told what it believes.
  Wrench fly(Vehicle& vehicle, const RigidBodyState& state);
  /// What the vehicle takes out of its battery: after each tick.
  /// @returns true once: now it is empty.
  bool spend(Tick tick, const Vehicle& vehicle, const RigidBodyState& state);

  /// At the end of an exchange: the UAV is in the air.
  void note_flight();
  /// What the UAV's flight controller takes for true.
  RigidBodyState believed(const RigidBodyState& truth) const;
  /// Where a UAV would be that knows its position, and one without wind.
  OtherStates other_states(const RigidBodyState& truth) const;
  /// Takes what is in W to where the UAV sees it; nullopt: where it is.
  std::optional<Isometry3d> X_told_W(const RigidBodyState& truth) const;
  /// What its software is told at the end of an exchange, and how sure that is.
  ToldState tell(Tick tick, const RigidBodyState& truth);
  PoseUncertainty uncertainty() const { return odometry_ ? odometry_->uncertainty() : PoseUncertainty{}; }
  std::optional<BatteryStatus> battery() const { return battery_ ? std::optional(battery_->status()) : std::nullopt; }
  std::optional<Vector3d> wind_estimate_W() const { return wind_ ? std::optional(wind_->estimate_W()) : std::nullopt; }
  BatteryUse battery_use() const;

 private:
  ConditionsConfig conditions_;
  const VehicleConfig& vehicle_;
  std::optional<Wind> wind_;
  WindPush push_;  ///< of `wind_`
  std::optional<OdometryError> odometry_;
  std::optional<Battery> battery_;
  std::optional<Tick> empty_;
  std::optional<double> last_in_flight_;  ///< BatteryUse::last_in_flight
  Vector3d v_WA_ = Vector3d::Zero();      ///< of the air
  std::size_t latency_;                   ///< exchanges
  std::deque<ToldState> told_;            ///< that has yet to arrive, and the last that has
};

}  // namespace skein::sim
