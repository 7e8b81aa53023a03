// How far one UAV's idea of where it is lies off the truth.
//
// Position and yaw: first-order Gauss-Markov processes, and a constant offset. Before takeoff, the place where a UAV
// stands is known (`known_start`): the position's process begins at 0 when the UAV takes off.
// While the fix is lost, the position walks off at random from where it was, and the yaw goes on as before; afterwards
// the error jumps back to what it would have been.
// The flight controller flies by this, the LiDAR's clouds and what the camera finds are placed by it: all that a UAV is
// told agrees. The messages have white noise on top, the same in all samples of an exchange.
// Frames: W world, B body.  Units: SI, radians.  Threads: one.  The same seed gives the same bits.
#pragma once

#include "core/conditions.hpp"
#include "core/random_stream.hpp"
#include "core/told_state.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// dx = -x / tau dt + noise, with a stationary deviation of 1.
class GaussMarkov {
 public:
  /// Begins at 0.
  GaussMarkov() = default;
  /// Begins as if it had gone on for ever.
  explicit GaussMarkov(RandomStream& draw) : value_(draw.normal()), variance_(1.0) {}
  /// @param keeps  exp(-step / tau).
  void step(double keeps, RandomStream& draw);
  double value() const { return value_; }
  /// Of value(), over all draws: 1 - exp(-2 t / tau) after t from 0.
  double variance() const { return variance_; }

 private:
  double value_ = 0.0, variance_ = 0.0;
};

class OdometryError {
 public:
  OdometryError(const OdometryConditions& config, std::uint64_t seed, UavIndex uav);

  /// The UAV takes off: where it is, is known no more.
  void leave_start() { at_start_ = false; }
  /// @param config  for the steps that follow. The constant offset stays, and so does the time of the next loss or
  ///   return of the fix.
  void change(const OdometryConditions& config);
  /// @param jammed  true: there is no fix from now on. false: if there was none for that reason, it is back.
  void jam(bool jammed);
  /// A time step later.
  void step(double step_s);
  /// Another exchange begins: its noise.
  void draw_noise();

  /// Where the UAV's flight controller takes the UAV to be.
  RigidBodyState believed(const RigidBodyState& truth) const;
  /// The same with the noise of the messages of this exchange.
  RigidBodyState told(const RigidBodyState& truth) const;
  /// Takes what is in W to where the UAV that is truly at X_WB takes it to be.
  Isometry3d X_told_W(const RigidBodyState& truth) const { return told(truth).X_WB() * truth.X_WB().inverse(); }
  /// Of told().
  PoseUncertainty uncertainty() const;

  bool has_fix() const { return !lost_; }
  Vector3d position_error_m() const;
  double yaw_error() const;

 private:
  GaussMarkov first_error() { return config_.known_start ? GaussMarkov() : GaussMarkov(draw_); }
  double draw_duration(double mean_s) { return -mean_s * portable_log(1.0 - draw_.uniform()); }
  Vector3d with_fix_m() const;
  void lose_fix();

  OdometryConditions config_;
  RandomStream draw_, noise_draw_;
  Vector3d bias_m_;
  GaussMarkov x_, y_, z_, yaw_;
  bool at_start_;  ///< whose place is known
  bool lost_ = false, jammed_ = false;
  double until_change_s_ = 0.0;  ///< of the fix
  double lost_s_ = 0.0, variance_when_lost_ = 0.0;
  double horizontal_sigma_when_lost_m_ = 0.0, vertical_sigma_when_lost_m_ = 0.0;
  double walked_before_m2_ = 0.0;         ///< variance of the walk before `lost_s_`, at other values of `config_`
  Vector3d walked_m_ = Vector3d::Zero();  ///< the error while the fix is lost
  Vector3d noise_m_ = Vector3d::Zero(), velocity_noise_mps_ = Vector3d::Zero();
};

}  // namespace skein::sim
