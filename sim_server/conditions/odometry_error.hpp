// The error of one UAV's odometry.
//
// The errors of position and yaw are first-order Gauss-Markov processes; the position has a constant offset, too. With
// `known_start`, the position's process stays at 0 until the UAV takes off, because its start is known.
// While the position fix is lost, the position error is a random walk from its last value, and the yaw error continues
// as before. When the fix returns, the position error jumps to the value of its own process.
// The flight controller, the LiDAR's clouds and the camera's detections all use the erroneous pose, so all data that a
// UAV gets are consistent. Messages have white noise in addition, the same in all samples of an exchange.
// Frames: W world, B body.  Units: SI, radians.  Threads: one.  The same seed gives the same bits.
#pragma once

#include "core/math/random_stream.hpp"
#include "core/messages/uav_status.hpp"
#include "core/scenario/conditions.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// dx = -x / tau dt + noise, with a stationary deviation of 1.
class GaussMarkov {
 public:
  /// Begins at 0.
  GaussMarkov() = default;
  /// Begins in the stationary state.
  explicit GaussMarkov(RandomStream& draw) : value_(draw.normal()), variance_(1.0) {}
  /// @param keeps  exp(-step / tau).
  void step(double keeps, RandomStream& draw);
  double value() const { return value_; }
  /// Variance of value() over all draws. If the process began at 0, it is 1 - exp(-2 t / tau) after the time t.
  double variance() const { return variance_; }

 private:
  double value_ = 0.0, variance_ = 0.0;
};

class OdometryError {
 public:
  OdometryError(const OdometryConditions& config, std::uint64_t seed, UavIndex uav);

  /// The UAV takes off: from now on its position is no longer known (`known_start`).
  void leave_start() { at_start_ = false; }
  /// @param config  for the steps that follow. The constant offset stays, and so does the time of the next loss or
  ///   return of the fix.
  void change(const OdometryConditions& config);
  /// Jams the position fix, or ends the jamming. @param jammed  true: there is no fix from now on. false: if the fix
  ///   was jammed, it is back.
  void jam(bool jammed);
  /// Advances the error by one time step.
  void step(double step_s);
  /// Draws the noise of the messages of an exchange. Call it when the exchange begins.
  void draw_noise();

  /// The state that the flight controller uses: the true one with the odometry's error.
  RigidBodyState believed(const RigidBodyState& truth) const;
  /// The state in the messages of this exchange: believed(), with their noise.
  RigidBodyState told(const RigidBodyState& truth) const;
  /// Transform from W to the frame `told`: maps a true place to where the UAV's odometry makes it appear.
  Isometry3d X_told_W(const RigidBodyState& truth) const { return told(truth).X_WB() * truth.X_WB().inverse(); }
  /// Standard deviations of the error of told().
  PoseUncertainty uncertainty() const;

  /// For tests of the errors' statistics with and without a fix: no message tells whether there is a fix.
  bool has_fix() const { return !lost_; }
  Vector3d position_error_m() const;  ///< in W
  double yaw_error() const;           ///< [rad]

 private:
  GaussMarkov first_error() { return config_.known_start ? GaussMarkov() : GaussMarkov(draw_); }
  double draw_duration(double mean_s) { return -mean_s * portable_log(1.0 - draw_.uniform()); }
  Vector3d with_fix_m() const;
  void turn();
  void lose_fix();

  OdometryConditions config_;
  RandomStream draw_, noise_draw_;
  Vector3d bias_m_;
  GaussMarkov x_, y_, z_, yaw_;
  Quaterniond yaw_turn_;  ///< the rotation by yaw_error()
  bool at_start_;         ///< not yet taken off from a known start
  bool lost_ = false, jammed_ = false;
  double until_change_s_ = 0.0;  ///< time until the fix is lost or returns
  double lost_s_ = 0.0, variance_when_lost_ = 0.0;
  double horizontal_sigma_when_lost_m_ = 0.0, vertical_sigma_when_lost_m_ = 0.0;
  double walked_before_m2_ = 0.0;         ///< variance of the walk before `lost_s_`, with earlier `config_`
  Vector3d walked_m_ = Vector3d::Zero();  ///< the error while the fix is lost
  Vector3d noise_m_ = Vector3d::Zero(), velocity_noise_mps_ = Vector3d::Zero();
};

}  // namespace skein::sim
