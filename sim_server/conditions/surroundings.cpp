#include "sim_server/conditions/surroundings.hpp"

#include <cmath>

namespace skein::sim {
namespace {

constexpr Tick kErrorTicks = kControlTicks;  ///< between two steps of the odometry's error, as of the controller
constexpr Tick kPowerTicks = 4;              ///< between two draws of power from the battery

}  // namespace

Surroundings::Surroundings(const Scenario& scenario, std::uint64_t seed, UavIndex uav)
    : conditions_(scenario.conditions),
      vehicle_(scenario.fleet[uav].vehicle),
      station_W_(scenario.station_position),
      push_(vehicle_),
      latency_(static_cast<std::size_t>(std::lround(conditions_.odometry.latency_s / scenario.exchange_period_s))) {
  if (conditions_.wind.on()) wind_.emplace(conditions_.wind, seed, uav);
  if (conditions_.odometry.on()) odometry_.emplace(conditions_.odometry, seed, uav);
  if (conditions_.battery.on()) battery_.emplace(conditions_.battery, vehicle_, scenario.duration_s);
}

void Surroundings::change(const ConditionsConfig& conditions) {
  conditions_ = conditions;
  if (wind_) wind_->change(conditions.wind);
  if (odometry_) odometry_->change(conditions.odometry);
}

void Surroundings::suffer(bool fix_lost, double most_charge, Tick charge_lost) {
  if (odometry_) odometry_->jam(fix_lost);
  const bool is_new = most_charge != most_charge_ || charge_lost != charge_lost_;
  if (battery_ && is_new) battery_->limit(most_charge);
  most_charge_ = most_charge;
  charge_lost_ = charge_lost;
}

void Surroundings::begin_exchange() {
  if (odometry_) odometry_->draw_noise();
}

void Surroundings::begin_tick(Tick tick, const RigidBodyState& state, const Vector3d& gust_W) {
  if (odometry_ && tick % kErrorTicks == 0) odometry_->step(seconds(kErrorTicks));
  v_WA_ = gust_W;
  if (!wind_) return;
  wind_->step(state.p_WB, state.v_WB, kTickS, gust_W);
  v_WA_ = wind_->velocity_W();
}

Wrench Surroundings::fly(Vehicle& vehicle, const RigidBodyState& state) {
  if (odometry_ && vehicle.mode() != ControlMode::idle) odometry_->leave_start();
  vehicle.control_attitude(believed(state));
  Wrench wrench = vehicle.fly(state, v_WA_);
  const bool flies = vehicle.mode() != ControlMode::idle, still = v_WA_.isZero(0.0);
  if (was_pushed_ && flies && still) push_.step(Vector3d::Zero(), kTickS);
  // No body drag on a UAV that has not begun to fly, so that it stays in place; nor in still air, as in the reference.
  if (still || !flies) return wrench;
  was_pushed_ = true;
  const Vector3d body_W = body_drag(conditions_.wind.body_drag_area_m2, state.v_WB - v_WA_);
  wrench.force_B += state.q_WB.conjugate() * body_W;
  push_.step(body_W + state.q_WB * vehicle.rotors_pushed_B(state.q_WB.conjugate() * v_WA_), kTickS);
  return wrench;
}

bool Surroundings::spend(Tick tick, const Vehicle& vehicle, const RigidBodyState& state) {
  if (!battery_ || empty_ || tick % kPowerTicks != 0 || vehicle.mode() == ControlMode::idle) return false;
  const Vector3d v_AB_B = state.q_WB.conjugate() * (state.v_WB - v_WA_);
  battery_->draw(electric_power(conditions_.battery, vehicle_, vehicle.rotor_thrusts_n(), v_AB_B),
                 seconds(kPowerTicks));
  if (!battery_->empty()) return false;
  empty_ = tick;
  return true;
}

void Surroundings::note_place(Tick tick, const Vector3d& p_WB, bool airborne) {
  if (!battery_) return;
  if (airborne) {
    last_in_flight_ = battery_->charge();
    stands_since_.reset();
    return;
  }
  const BatteryConditions& config = conditions_.battery;
  const bool near = (p_WB - station_W_).head<2>().norm() <= config.swap_within_m;
  const bool full = battery_->charge() > BatteryStatus::kFullCharge;
  if (!config.swaps() || !near || !last_in_flight_ || full || empty_) return stands_since_.reset();
  if (!stands_since_) stands_since_ = tick;
  if (tick - *stands_since_ < ticks(*config.swap_s)) return;
  battery_->swap();
  ++swaps_;
}

RigidBodyState Surroundings::believed(const RigidBodyState& truth) const {
  return odometry_ ? odometry_->believed(truth) : truth;
}

OtherStates Surroundings::other_states(const RigidBodyState& truth) const {
  OtherStates other;
  if (odometry_) other.exact = odometry_->believed(truth);
  if (wind_ || was_pushed_) {
    other.calm = truth;
    other.calm->p_WB -= push_.offset_W();
    other.calm->v_WB -= push_.velocity_W();
  }
  return other;
}

std::optional<Isometry3d> Surroundings::X_told_W(const RigidBodyState& truth) const {
  return odometry_ ? std::optional(odometry_->X_told_W(truth)) : std::nullopt;
}

ToldState Surroundings::tell(Tick tick, const RigidBodyState& truth) {
  told_.push_back({tick, odometry_ ? odometry_->told(truth) : truth});
  while (told_.size() > latency_ + 1) told_.pop_front();
  return told_.front();
}

BatteryUse Surroundings::battery_use() const {
  constexpr double kJoulesPerWh = 3600.0;
  if (!battery_) return {};
  const double time_s = battery_->time_s();
  return {battery_->capacity_wh(),
          battery_->given_j() / kJoulesPerWh,
          time_s > 0.0 ? battery_->given_j() / time_s : 0.0,
          empty_,
          last_in_flight_,
          conditions_.battery.swaps() ? std::optional(swaps_) : std::nullopt};
}

}  // namespace skein::sim
