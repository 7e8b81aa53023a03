// Turns what a planner wants (a set-point, a path, a stop) into one full-state set-point per exchange whose
// position, velocity and acceleration belong together and stay within the vehicle's limits, as the simulator
// demands. A path is followed by a point mass that heads for a spot a little ahead on the polyline: it may be
// replaced at any time without a jump, and rounds a corner by about `corner_m`, in the
// worst zigzag by twice that.
//
// What is commanded is the mean of the last `smoothing_s` of that point mass. A mean keeps every limit that the
// mass keeps, stays within the bends of its track (a stop ends where the mass stops, without overshoot), and its
// acceleration changes by no more than twice the limit in `smoothing_s`: a multirotor has to tilt before it
// accelerates, and one whose demand flips from step to step swings instead of following.
// Frame W.   Units: SI and radians.   Pure; threads: one.
#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class Tracker {
 public:
  struct Config {
    double max_speed_mps = 6.0;
    double max_acceleration_mps2 = 3.0;
    double max_sink_acceleration_mps2 = 2.5;  ///< downwards: with little thrust left there is no attitude control
    double smoothing_s = 0.4;
    double max_yaw_rate = 0.8;       ///< [rad/s]
    double corner_m = 0.25;          ///< how far a corner may be cut
    double slow_down_error_m = 0.6;  ///< the point mass waits for a UAV that lags this much behind its set-point
    double lost_error_m = 3.0;       ///< farther apart, the set-point starts again from where the UAV is
  };

  explicit Tracker(const Config& config) : config_(config) {}

  void follow(const Path& path);
  void hold();
  void fly_to(const Setpoint& setpoint);
  void turn_to(double yaw) { yaw_goal_ = yaw; }
  /// Commands come from elsewhere: what it was told is over, and what it is told next begins at this state. To be
  /// called again in each exchange, with the new state, as long as stands_by().
  void stand_by(const RigidBodyState& state);
  bool stands_by() const { return mode_ == Mode::stand_by; }
  /// From now on no faster than that along a path; 0: it brakes, and stays where it comes to rest.
  void limit_speed(double speed_mps) { speed_limit_mps_ = speed_mps; }

  /// Advances by one exchange.
  /// @returns nullopt as long as no motion was asked for, and while it stands by.
  std::optional<TrajectoryCommand> step(const RigidBodyState& state, double dt_s);

  TrackingState tracking() const;

  /// What it commanded last.
  const Setpoint& commanded() const { return ref_; }
  bool moves() const { return mode_ == Mode::hold || mode_ == Mode::path; }
  /// Where it would be commanded from now on, exchange by exchange, if it were told to hold: up to rest, and at least
  /// the present place. As hold() and step() do it, as long as the UAV follows.
  std::vector<Vector3d> stopping_places(double dt_s) const;

 private:
  enum class Mode { off, hold, path, setpoint, stand_by };

  void start_from(const Vector3d& p_W, const Vector3d& v_W, double dt_s);
  void forget_flown_legs();
  void lay_out(const std::vector<Waypoint>& waypoints);
  void advance_along_path(double pace, double dt_s);
  void advance_progress();
  void advance_yaw(double dt_s);
  /// Changes the velocity of the point mass towards `v_goal` as far as the limits allow, and moves it.
  void accelerate(const Vector3d& v_goal, double dt_s);
  void smooth();
  /// The greatest acceleration in a direction.
  double strength(const Vector3d& direction) const;
  double speed_limit(double dt_s) const;
  /// From one leg into another, over so much way.
  double turn_speed(const Vector3d& in, const Vector3d& out, double bend_m) const;
  void slow_down_in_bends();
  std::size_t leg_at(double s) const;
  Vector3d point_at(double s) const;

  /// One corner of the polyline. The first is where the point mass was when the path came.
  struct Corner {
    Vector3d p_W;
    double s = 0.0;          ///< arc length from the start
    double leg_speed = 0.0;  ///< of the leg that ends here
    double braking = 0.0;    ///< on that leg
    double speed = 0.0;      ///< at most, when passing here; 0 at the end
    bool sharp = false;      ///< must be touched before the next leg begins
  };

  Config config_;
  Mode mode_ = Mode::off;
  bool started_ = false;
  Setpoint ref_;                ///< what was commanded last
  Setpoint mass_;               ///< the point mass; its yaw is not used
  std::deque<Setpoint> track_;  ///< of the point mass, as much as is smoothed; empty: begins anew from ref_
  std::optional<double> yaw_goal_;
  std::vector<Waypoint> waypoints_;  ///< as asked for
  std::vector<Corner> corners_;      ///< laid out at the first step with a new path
  double progress_ = 0.0;            ///< arc length reached
  double speed_limit_mps_ = std::numeric_limits<double>::infinity();
  bool done_ = true;  ///< the point mass is
};

/// What a vehicle may be told to fly: its flight controller corrects with what is left of its limits.
Tracker::Config tracker_config(const VehicleConfig& vehicle);

}  // namespace skein::agent
