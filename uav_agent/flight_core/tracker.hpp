// The tracker turns a requested motion (a setpoint, a path, a hold) into one full setpoint per exchange. Position,
// velocity and acceleration of the setpoints are consistent and stay within the vehicle's limits, as the simulator
// demands. On a path, a simulated point mass flies towards a point a little ahead on the polyline. The path may be
// replaced at any time without a jump. The mass cuts a corner by about `corner_m`, in the worst zigzag by twice that.
//
// The commanded setpoint is the mean of the mass's states over the last `smoothing_s`. The mean keeps every limit that
// the mass keeps, and stays inside the bends of the mass's track: a stop ends where the mass stops, without overshoot.
// The mean acceleration changes by at most twice the limit in `smoothing_s`. This matters because a multirotor must
// tilt before it accelerates: if the demand flips from step to step, it swings instead of following.
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
    double max_speed_mps = 6.0;               ///< vehicle; see tracker_config()
    double max_acceleration_mps2 = 3.0;       ///< vehicle; see tracker_config()
    double max_sink_acceleration_mps2 = 2.5;  ///< downward part; chosen: attitude control needs the remaining thrust
    double smoothing_s = 0.4;                 ///< time over which the commanded setpoint is the mean; chosen
    double max_yaw_rate = 0.8;                ///< [rad/s]; chosen; less if the vehicle turns slower
    double corner_m = 0.25;                   ///< distance by which the UAV may cut a corner; chosen
    /// With more tracking error, the mass slows down, to 10 % at twice as much. Chosen.
    double slow_down_error_m = 0.6;
    double lost_error_m = 3.0;  ///< with more tracking error, the setpoint restarts at the UAV; chosen
  };

  explicit Tracker(const Config& config) : config_(config) {}

  /// Follows the path from the present setpoint on, or from the ground if that is below it. An empty path means hold().
  void follow(const Path& path);
  void hold();  ///< Brakes to rest and stays there.
  /// From now on commands this setpoint, with velocity and acceleration clamped to the limits.
  void fly_to(const Setpoint& setpoint);
  /// Turns to a yaw [rad] at max_yaw_rate, while it holds or follows a path.
  void turn_to(double yaw) { yaw_goal_ = yaw; }
  /// Ends the present motion, because the planner sends commands of its own. The next motion begins at `state`. As long
  /// as stands_by(), call it again in each exchange with the UAV's new state.
  void stand_by(const RigidBodyState& state);
  bool stands_by() const { return mode_ == Mode::stand_by; }
  /// Limits the speed along a path from now on; 0: the UAV brakes and stays where it comes to rest.
  void limit_speed(double speed_mps) { speed_limit_mps_ = speed_mps; }

  /// Advances by one exchange.
  /// @returns nullopt before the first motion, and while stands_by().
  std::optional<TrajectoryCommand> step(const RigidBodyState& state, double dt_s);

  TrackingState tracking() const;

  /// The last commanded setpoint.
  const Setpoint& commanded() const { return ref_; }
  /// Whether the tracker holds or follows a path.
  bool moves() const { return mode_ == Mode::hold || mode_ == Mode::path; }
  /// The braking trajectory: positions (p_WB) that the tracker would command in the exchanges after hold(), from the
  /// present one until rest. Exact as long as the tracking error stays below lost_error_m.
  std::vector<Vector3d> stopping_places(double dt_s) const;

 private:
  enum class Mode { off, hold, path, setpoint, stand_by };

  void start_from(const Vector3d& p_W, const Vector3d& v_W, double dt_s);
  bool begins_on_ground() const;
  void forget_flown_legs();
  void lay_out(const std::vector<Waypoint>& waypoints);
  void advance_along_path(double pace, double dt_s);
  void advance_progress();
  void advance_yaw(double dt_s);
  /// Changes the velocity of the point mass towards `v_goal` as far as the limits allow, and moves it.
  void accelerate(const Vector3d& v_goal, double dt_s);
  void smooth();
  /// Maximum acceleration in a direction [m/s^2].
  double strength(const Vector3d& direction) const;
  double speed_limit(double dt_s) const;
  /// Maximum speed in the turn from the leg `in` to the leg `out`, which takes bend_m of the path [m/s].
  double turn_speed(const Vector3d& in, const Vector3d& out, double bend_m) const;
  void slow_down_in_bends();
  std::size_t leg_at(double s) const;
  Vector3d point_at(double s) const;

  /// One corner of the polyline. The first one is the position of the point mass when the path began.
  struct Corner {
    Vector3d p_W;
    double s = 0.0;          ///< arc length from the first corner [m]
    double leg_speed = 0.0;  ///< maximum speed on the leg that ends here [m/s]
    double braking = 0.0;    ///< deceleration on that leg [m/s^2]
    double speed = 0.0;      ///< maximum speed at this corner [m/s]; 0 at the last one
    bool sharp = false;      ///< the mass must come within 0.1 m before the next leg begins
  };

  Config config_;
  Mode mode_ = Mode::off;
  bool started_ = false;
  Setpoint ref_;                ///< the last commanded setpoint
  Setpoint mass_;               ///< the point mass; its yaw is not used
  std::deque<Setpoint> track_;  ///< states of the mass over smoothing_s; empty: starts again at ref_
  std::optional<double> yaw_goal_;
  std::vector<Waypoint> waypoints_;  ///< of the requested path
  std::vector<Corner> corners_;      ///< made from waypoints_ in the first step of a path
  double progress_ = 0.0;            ///< arc length that the mass has reached [m]
  double speed_limit_mps_ = std::numeric_limits<double>::infinity();
  bool done_ = true;  ///< the mass has reached the end of the path, or there is none
};

/// Limits for setpoints of a vehicle: 0.7 of its acceleration, because the flight controller needs the rest for
/// corrections.
Tracker::Config tracker_config(const VehicleConfig& vehicle);

}  // namespace skein::agent
