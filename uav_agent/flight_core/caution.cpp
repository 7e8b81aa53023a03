#include "uav_agent/flight_core/caution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "uav_agent/flight/delivery_places.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight_core/landing.hpp"

namespace skein::agent {
namespace {

constexpr double kMostErrorM = 1.0;  ///< greatest error; chosen: with a larger one, the UAV would fit nowhere
/// Errors are rounded up to multiples of this, since a change of clearance discards the answers cached in BodyFit.
/// Chosen.
constexpr double kErrorStepM = 0.05;
constexpr double kRounding = 1e-9;                                ///< numeric: a multiple of kErrorStepM stays as it is
constexpr double kMostGroundErrorM = 2.0, kMostPeerErrorM = 2.0;  ///< greatest errors of a height and of a peer; chosen
constexpr double kWindMemoryS = 20.0, kPowerMemoryS = 10.0;       ///< time constants of the means; chosen
constexpr double kCalmMps = 1.0;          ///< gusts below this are no reason to fly slower; chosen
constexpr double kLeastSpeedShare = 0.5;  ///< of the planned speed, which gusts leave; chosen
constexpr double kLeastGroundMps = 1.0;   ///< assumed over ground against any wind; chosen
constexpr double kLostPerHeadwind = 0.1;  ///< assumed loss of speed over ground, as a share of the headwind; chosen
constexpr double kMarginS = 8.0;          ///< added to the estimated time of the way down; chosen
constexpr double kMostPower = 4.0;        ///< times that of hover; chosen: a faster fall of the charge is a single loss
constexpr double kSwapCharge = 0.01;      ///< least rise of the charge that is another battery; chosen

double square(double x) { return x * x; }
double in_steps_m(double error_m) { return kErrorStepM * std::ceil(error_m / kErrorStepM - kRounding); }

}  // namespace

Caution::Caution(const FlightConfig& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      most_mps_(std::numeric_limits<double>::infinity()),
      hover_per_s_(agent.battery.on() ? 1.0 / (*agent.battery.endurance_missions * agent.duration_s) : 0.0),
      charge_per_s_(hover_per_s_) {}

void Caution::update(const PlannerInput& in) {
  if (!config_.reacts) return;
  watch_wind(in.wind_W);
  watch_battery(in);
  const double pushed_m = mean_wind_W_ ? config_.wind_error_s * mean_wind_W_->norm() : 0.0;
  // Before takeoff, the UAV still knows its position well. But it must look for the room that it needs in flight, so
  // the deviation of flight counts from the beginning.
  PoseUncertainty own = in.uncertainty;
  if (!own.exact()) own.position_m = own.position_m.cwiseMax(deviation_in_flight_m(agent_.odometry));
  // The direction to structure is unknown: the root mean square of the deviations along the axes.
  const double any_way_m = own.position_m.norm() / std::numbers::sqrt3;
  const auto kept_off = [&](double deviation_m) {
    return std::min(kMostErrorM, in_steps_m(config_.drift_sigmas * deviation_m + pushed_m));
  };
  // The ground was seen with the error of that time, by this UAV or another one. Wind does not change its height.
  const double ground_m = in_steps_m(config_.drift_sigmas * std::sqrt(2.0) * own.position_m.z());
  errors_.seen_m = kept_off(drift_since_seen_m(any_way_m));
  errors_.told_m = kept_off(std::sqrt(2.0) * any_way_m);
  errors_.ground_m = std::min(kMostGroundErrorM, ground_m);
  watch_peers(own, in.peers, pushed_m);
}

/// The same wind pushes both UAVs the same way. Its effect counts only once, to allow for gusts.
void Caution::watch_peers(const PoseUncertainty& own, const Peers& peers, double pushed_m) {
  errors_.peers_m.clear();
  if (own.exact() && pushed_m == 0.0) return;
  errors_.peers_m.resize(agent_.fleet.size(), Vector3d::Zero());
  for (const Peer& peer : peers.all()) {
    const Vector3d deviation_m = relative_deviation_m(own, peer);
    for (int axis = 0; axis < 3; ++axis) {
      const double error_m = in_steps_m(config_.drift_sigmas * deviation_m[axis] + pushed_m);
      errors_.peers_m[peer.uav][axis] = std::min(kMostPeerErrorM, error_m);
    }
  }
}

/// Standard deviation of the drift since the LiDAR saw a place, at most one period of its servo ago (look_s). For a
/// Gauss-Markov error with time constant T, e(t + s) - e(t) has the variance 2 sigma^2 (1 - exp(-s/T)); a constant
/// offset cancels. The variance that the odometry reports beyond the usual one while the fix is lost counts, too;
/// after that, it decays with the time constant look_s.
double Caution::drift_since_seen_m(double told_m) {
  const OdometryConditions& odometry = agent_.odometry;
  const double told2 = square(told_m), noise2 = square(odometry.noise_sigma_m);
  // Geometry: the mean over three axes.
  const double drifts2 = (2.0 * square(odometry.horizontal_sigma_m) + square(odometry.vertical_sigma_m)) / 3.0;
  const double usual2 = deviation_in_flight_m(odometry).squaredNorm() / 3.0;  // geometry: as above
  lost2_ = std::max(told2 - usual2, lost2_ * std::exp(-agent_.exchange_period_s / config_.look_s));
  const double anew = -std::expm1(-config_.look_s / odometry.time_constant_s);
  return std::sqrt(2.0 * (std::min(told2, drifts2) * anew + noise2) + lost2_);
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
  const double dt_s = seconds(in.tick - last_tick_);  // longer than an exchange if the program was suspended
  const double spent = last_charge_ ? *last_charge_ - in.battery->charge : 0.0;
  last_charge_ = in.battery->charge;
  last_tick_ = in.tick;
  if (spent < -kSwapCharge) has_another_ = true;
  if (must_land(in)) has_another_ = false;
  if (spent <= 0.0 || dt_s <= 0.0) return;  // the motors are off
  if (spent > kMostPower * hover_per_s_ * dt_s) return;
  charge_per_s_ += std::min(1.0, dt_s / kPowerMemoryS) * (spent / dt_s - charge_per_s_);
}

double Caution::way_down_s(const Vector3d& p_WB, const std::optional<Vector3d>& wind_W) const {
  const Vector3d start_W = agent_.me().p_WB_start;
  const Vector3d way_W(start_W.x() - p_WB.x(), start_W.y() - p_WB.y(), 0.0);
  const double head_mps =
      wind_W && way_W.norm() > kBesideStartM ? std::max(0.0, -wind_W->dot(way_W.normalized())) : 0.0;
  // A UAV keeps its commanded speed over ground as long as it can lean into the wind; charge_per_s_ contains the cost
  // of that. Against strong wind, the UAV may not keep this speed, so the estimate assumes a lower one.
  const double ground_mps =
      std::max(kLeastGroundMps, std::min(config_.approach_mps, most_mps_) - kLostPerHeadwind * head_mps);
  // The UAV descends on the way to the start, and sinks slowly only above it.
  const double down_s = Landing::descent_s(p_WB.z(), config_);
  if (way_W.norm() <= kBesideStartM) return down_s;
  const Vector3d above_W(start_W.x(), start_W.y(), std::min(p_WB.z(), Landing::kFromM));
  return std::max(down_s, time_home_s(p_WB, above_W, ground_mps) + Landing::descent_s(above_W.z(), config_));
}

bool Caution::must_land(const PlannerInput& in) const {
  if (!config_.reacts || !in.battery) return false;
  const double needs_s = way_down_s(in.state.p_WB, in.wind_W) + kMarginS;
  return in.battery->charge < agent_.battery.reserve + needs_s * charge_per_s_;
}

bool Caution::has_full_battery(const PlannerInput& in) const {
  return in.battery && (in.battery->charge > BatteryStatus::kFullCharge || has_another_);
}

bool Caution::must_sink(const PlannerInput& in) const {
  if (!config_.reacts || !in.battery) return false;
  const double needs_s = Landing::descent_s(in.state.p_WB.z(), config_) + kMarginS;
  return in.battery->charge < needs_s * charge_per_s_;
}

}  // namespace skein::agent
