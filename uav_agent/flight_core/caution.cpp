#include "uav_agent/flight_core/caution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "uav_agent/flight/delivery_places.hpp"

namespace skein::agent {
namespace {

constexpr double kMostErrorM = 1.0;  ///< beyond that, the UAV could go nowhere
constexpr double kWindMemoryS = 20.0, kPowerMemoryS = 10.0;
constexpr double kCalmMps = 1.0;  ///< gusts below this are no reason to fly slower
constexpr double kLeastSpeedShare = 0.5;
constexpr double kLeastGroundMps = 1.0;
constexpr double kMarginS = 8.0, kDetours = 1.15;

}  // namespace

Caution::Caution(const FlightConfig& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      most_mps_(std::numeric_limits<double>::infinity()),
      charge_per_s_(agent.battery.on() ? 1.0 / (*agent.battery.endurance_missions * agent.duration_s) : 0.0) {}

void Caution::update(const PlannerInput& in) {
  if (!config_.reacts) return;
  watch_wind(in.wind_W);
  watch_battery(in);
  const double drift_m = config_.drift_sigmas * in.uncertainty.position_m.maxCoeff();
  const double pushed_m = mean_wind_W_ ? config_.wind_error_s * mean_wind_W_->norm() : 0.0;
  error_m_ = std::min(kMostErrorM, drift_m + pushed_m);
}

void Caution::watch_wind(const std::optional<Vector3d>& wind_W) {
  if (!wind_W) return;
  if (!mean_wind_W_) mean_wind_W_ = *wind_W;
  const double takes = agent_.exchange_period_s / kWindMemoryS;
  const Vector3d off_W = *wind_W - *mean_wind_W_;
  *mean_wind_W_ += takes * off_W;
  gusts2_ += takes * (off_W.squaredNorm() - gusts2_);
  const double gusts_mps = std::sqrt(gusts2_);
  const double share = std::clamp(1.0 - config_.gust_slows_s_m * (gusts_mps - kCalmMps), kLeastSpeedShare, 1.0);
  most_mps_ = share < 1.0 ? share * config_.approach_mps : std::numeric_limits<double>::infinity();
}

void Caution::watch_battery(const PlannerInput& in) {
  if (!in.battery) return;
  const double dt_s = seconds(in.tick - last_tick_);  // more than an exchange, if the program stood still
  const double spent = last_charge_ ? *last_charge_ - in.battery->charge : 0.0;
  last_charge_ = in.battery->charge;
  last_tick_ = in.tick;
  if (spent <= 0.0 || dt_s <= 0.0) return;  // its motors stand still
  charge_per_s_ += std::min(1.0, dt_s / kPowerMemoryS) * (spent / dt_s - charge_per_s_);
}

double Caution::way_down_s(const Vector3d& p_WB, const std::optional<Vector3d>& wind_W) const {
  const Vector3d start_W = agent_.me().p_WB_start;
  const Vector3d way_W(start_W.x() - p_WB.x(), start_W.y() - p_WB.y(), 0.0);
  const double head_mps = wind_W && way_W.norm() > 1.0 ? std::max(0.0, -wind_W->dot(way_W.normalized())) : 0.0;
  // A vehicle keeps its commanded speed over ground while it can lean into the wind; what that costs is in the power.
  // The commanded speed is what is at risk: count with less of it against strong wind.
  const double ground_mps = std::max(kLeastGroundMps, std::min(config_.approach_mps, most_mps_) - 0.1 * head_mps);
  const double across_s =
      way_W.norm() > 1.0 ? time_home_s(p_WB, {start_W.x(), start_W.y(), p_WB.z()}, ground_mps) : 0.0;
  return across_s + std::max(0.0, p_WB.z()) / config_.land_mps;
}

bool Caution::must_land(const PlannerInput& in) const {
  if (!config_.reacts || !in.battery) return false;
  const double needs_s = kDetours * way_down_s(in.state.p_WB, in.wind_W) + kMarginS;
  return in.battery->charge < agent_.battery.reserve + needs_s * charge_per_s_;
}

}  // namespace skein::agent
