// The effects of the scenario's conditions on one UAV: the wind around it, the error of its odometry, its battery.
// With all conditions off, every function returns its input unchanged, bit for bit.
// Frames: W world, B body.  Units: SI.  Threads: one.
#pragma once

#include <deque>
#include <optional>

#include "core/messages/uav_status.hpp"
#include "core/scenario/scenario.hpp"
#include "sight/camera.hpp"
#include "sim_server/conditions/battery.hpp"
#include "sim_server/conditions/odometry_error.hpp"
#include "sim_server/conditions/wind.hpp"
#include "sim_server/conditions/wind_push.hpp"
#include "sim_server/flight/vehicle.hpp"

namespace skein::sim {

/// A state as reported to a UAV.
struct ToldState {
  Tick tick = 0;  ///< time to which the state belongs; earlier than the report by the latency
  RigidBodyState state;
};

/// Energy that a battery has delivered.
struct BatteryUse {
  double capacity_wh = 0.0, given_wh = 0.0, mean_power_w = 0.0;
  std::optional<Tick> empty;             ///< when it became empty; nullopt: it is not empty
  std::optional<double> last_in_flight;  ///< share of the charge when the UAV was last airborne; nullopt: never
  std::optional<std::uint64_t> swaps;    ///< number of swaps; nullopt: batteries are not swapped
};

class Surroundings {
 public:
  /// @param scenario  must outlive this.
  Surroundings(const Scenario& scenario, std::uint64_t seed, UavIndex uav);

  /// Conditions for the ticks that follow. @param conditions  the scenario's, except for values that faults change.
  void change(const ConditionsConfig& conditions);
  /// Call it before the first tick of an exchange.
  void begin_exchange();
  /// Applies the faults of an exchange. @param fix_lost  the UAV has no position fix. @param most_charge  upper limit
  /// of the battery's charge, as a share of its capacity. @param charge_lost  when the fault with this limit began:
  /// each such fault takes charge once, from the battery that the UAV then has.
  void suffer(bool fix_lost, double most_charge, Tick charge_lost);
  /// Call it before each tick. @param gust_W  velocity that a fault adds to the wind [m/s].
  void begin_tick(Tick tick, const RigidBodyState& state, const Vector3d& gust_W);
  /// Steps the attitude loop, with the believed state, and the motors. @param state  the true one.
  /// @returns the wrench on the vehicle in the present wind, in B.
  Wrench fly(Vehicle& vehicle, const RigidBodyState& state);
  /// Draws the vehicle's power from the battery. Call it after fly() in each tick.
  /// @returns true once, when the battery becomes empty.
  bool spend(Tick tick, const Vehicle& vehicle, const RigidBodyState& state);

  /// Swaps the battery of a UAV that has stood near the station for long enough after a flight. A UAV whose battery is
  /// empty has stopped for good. Call it at the end of each exchange of a UAV that has not collided.
  void note_place(Tick tick, const Vector3d& p_WB, bool airborne);
  /// The state that the UAV's flight controller uses.
  RigidBodyState believed(const RigidBodyState& truth) const;
  /// The states that the UAV would have if it knew its position exactly, and if there were neither wind nor gusts by
  /// faults.
  OtherStates other_states(const RigidBodyState& truth) const;
  /// Transform from W to the frame `told` of the UAV's odometry; nullopt: W itself.
  std::optional<Isometry3d> X_told_W(const RigidBodyState& truth) const;
  /// The state that the UAV's software gets at the end of an exchange. Call it once per exchange.
  ToldState tell(Tick tick, const RigidBodyState& truth);
  PoseUncertainty uncertainty() const { return odometry_ ? odometry_->uncertainty() : PoseUncertainty{}; }
  std::optional<BatteryStatus> battery() const { return battery_ ? std::optional(battery_->status()) : std::nullopt; }
  std::optional<Vector3d> wind_estimate_W() const { return wind_ ? std::optional(wind_->estimate_W()) : std::nullopt; }
  BatteryUse battery_use() const;

 private:
  ConditionsConfig conditions_;
  const VehicleConfig& vehicle_;
  Vector3d station_W_;
  std::optional<Wind> wind_;
  WindPush push_;            ///< of `wind_` and of gusts by faults
  bool was_pushed_ = false;  ///< it has flown in moving air
  std::optional<OdometryError> odometry_;
  std::optional<Battery> battery_;
  std::optional<Tick> empty_;
  std::optional<double> last_in_flight_;  ///< BatteryUse::last_in_flight
  std::optional<Tick> stands_since_;      ///< when it came to stand near the station, with a battery to be swapped
  std::uint64_t swaps_ = 0;
  double most_charge_ = 1.0;          ///< as in the last suffer()
  Tick charge_lost_ = 0;              ///< likewise
  Vector3d v_WA_ = Vector3d::Zero();  ///< velocity of the air
  std::size_t latency_;               ///< exchanges
  std::deque<ToldState> told_;        ///< the last state that arrived, and those that are still on their way
};

}  // namespace skein::sim
