#include "uav_agent/flight_core/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "core/math/vectors.hpp"

namespace skein::agent {
namespace {

constexpr double kBrakingShare = 0.8;  ///< of the acceleration limit; chosen: the rest keeps the UAV on the line
/// The mass heads for the point on the path that it reaches after kLookAheadS at its present speed, at least
/// kMinLookAheadM ahead. Chosen.
constexpr double kLookAheadS = 0.3, kMinLookAheadM = 0.15;
constexpr double kTouchM = 0.1;         ///< a sharp corner counts as reached within this distance; chosen
constexpr double kSharpSpeedMps = 0.3;  ///< speed in a sharp corner; chosen
constexpr double kSharpCosine = 0.5;    ///< turns of more than 60 degrees are sharp; chosen
constexpr double kBendM = 8.0;          ///< corners farther apart are separate turns; chosen
constexpr double kMinLegM = 1e-3;       ///< shorter legs count as empty; numeric
constexpr double kSlowestPace = 0.1;    ///< least share of the speed of a mass that waits for its UAV; chosen
constexpr double kSlowestMps = 0.05;    ///< least speed along a leg; chosen: with 0, the UAV would never arrive
constexpr double kLongestStepS = 0.05;  ///< of the point mass; chosen: the usual exchange; a longer one takes several
/// Formula: 20 s at exchanges of 0.05 s. No UAV takes so long to stop.
constexpr std::size_t kMostStoppingSteps = 400;
constexpr double kNoPositionM = 0.02;       ///< vehicle: its controller takes |p| < 0.01 for "no position"
constexpr double kAccelerationShare = 0.7;  ///< of the vehicle's limit; chosen: the controller corrects with the rest
constexpr double kTiny = 1e-9;              ///< numeric: shares, lengths [m] and speeds [m/s] below it are 0
constexpr double kNearerPointM = 1e-12;     ///< numeric: a point of the path is nearer by more than this
constexpr double kStraight = 1.0 - 1e-6;    ///< numeric: cosine of half a turn; with more, there is no turn

/// Cosine of the turn between two legs; 1 if either of them is empty.
double cosine_between(const Vector3d& in, const Vector3d& out) {
  const bool turns = in.norm() > kMinLegM && out.norm() > kMinLegM;
  return turns ? in.dot(out) / (in.norm() * out.norm()) : 1.0;
}

/// Greatest speed at which a turn cuts its corner by no more than `cut`: the circle that touches both legs.
/// @param bend_m  length of the path from the first corner of the turn to the last: it widens the circle.
double corner_speed(double cosine, double cut, double acceleration, double bend_m) {
  const double half = std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)));  // cosine of half the turn
  if (half > kStraight) return std::numeric_limits<double>::infinity();
  return std::sqrt(acceleration * (cut * half / (1.0 - half) + bend_m / (2.0 * std::acos(half))));
}

}  // namespace

Tracker::Config tracker_config(const VehicleConfig& vehicle) {
  Tracker::Config config;
  config.max_speed_mps = vehicle.max_speed_mps;
  config.max_acceleration_mps2 = kAccelerationShare * vehicle.max_acceleration_mps2;
  config.max_yaw_rate = std::min(config.max_yaw_rate, vehicle.max_yaw_rate_deg_s * kRadPerDeg);
  return config;
}

void Tracker::follow(const Path& path) {
  waypoints_ = path.waypoints;
  corners_.clear();
  progress_ = 0.0;
  done_ = waypoints_.empty();
  mode_ = done_ ? Mode::hold : Mode::path;
}

void Tracker::hold() {
  mode_ = Mode::hold;
  done_ = true;
}

void Tracker::fly_to(const Setpoint& setpoint) {
  mode_ = Mode::setpoint;
  started_ = true;
  done_ = true;
  ref_ = setpoint;
  ref_.v_WB = shortened(setpoint.v_WB, config_.max_speed_mps);
  ref_.a_WB = shortened(setpoint.a_WB, config_.max_acceleration_mps2);
  mass_ = ref_;
  track_.clear();
  yaw_goal_ = setpoint.yaw;
}

void Tracker::stand_by(const RigidBodyState& state) {
  mode_ = Mode::stand_by;
  started_ = true;
  done_ = true;
  ref_ = Setpoint{.p_WB = state.p_WB, .yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw, .v_WB = state.v_WB};
  mass_ = ref_;
  track_.clear();
  yaw_goal_.reset();
  waypoints_.clear();
  corners_.clear();
  progress_ = 0.0;
}

/// Starts as if the UAV had come here at this velocity all along: the point mass is ahead by half of smoothing_s.
void Tracker::start_from(const Vector3d& p_W, const Vector3d& v_W, double dt_s) {
  const Vector3d v = shortened(v_W, config_.max_speed_mps);
  const int count = std::max(1, static_cast<int>(std::lround(config_.smoothing_s / dt_s)));
  track_.clear();
  for (int i = 0; i < count; ++i) {
    mass_ = Setpoint{.p_WB = p_W + (i - 0.5 * (count - 1)) * dt_s * v, .v_WB = v};
    track_.push_back(mass_);
  }
  started_ = true;
}

/// Whether a climb begins while the setpoint is below the ground, where it keeps a UAV that has landed in its place.
bool Tracker::begins_on_ground() const {
  return mode_ == Mode::path && !done_ && corners_.empty() && ref_.p_WB.z() < 0.0 && waypoints_.back().p_WB.z() > 0.0;
}

void Tracker::forget_flown_legs() {
  if (mode_ != Mode::path || corners_.empty()) return;
  const std::size_t leg = std::min(leg_at(progress_), waypoints_.size());
  waypoints_.erase(waypoints_.begin(), waypoints_.begin() + static_cast<std::ptrdiff_t>(leg) - 1);
  corners_.clear();
  progress_ = 0.0;
}

double Tracker::strength(const Vector3d& direction) const {
  const double length = direction.norm();
  const bool sinks = direction.z() < -kTiny * length;
  const double by_sinking =
      sinks ? config_.max_sink_acceleration_mps2 * length / -direction.z() : std::numeric_limits<double>::infinity();
  return std::min(config_.max_acceleration_mps2, by_sinking);
}

void Tracker::lay_out(const std::vector<Waypoint>& waypoints) {
  corners_.assign(1, Corner{.p_W = mass_.p_WB});
  for (const Waypoint& waypoint : waypoints) {
    const Vector3d leg = waypoint.p_WB - corners_.back().p_W;
    const double speed = std::clamp(waypoint.speed_mps, kSlowestMps, config_.max_speed_mps);
    // Each waypoint has a corner, even at the end of an empty leg, so that the indices of legs and waypoints agree.
    corners_.push_back(Corner{.p_W = waypoint.p_WB,
                              .s = corners_.back().s + leg.norm(),
                              .leg_speed = speed,
                              .braking = kBrakingShare * strength(-leg)});
  }
  for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
    const Vector3d in = corners_[i].p_W - corners_[i - 1].p_W;
    const Vector3d out = corners_[i + 1].p_W - corners_[i].p_W;
    corners_[i].sharp = cosine_between(in, out) < kSharpCosine;
    corners_[i].speed = corners_[i].sharp ? kSharpSpeedMps : turn_speed(in, out, 0.0);
  }
  slow_down_in_bends();
}

double Tracker::turn_speed(const Vector3d& in, const Vector3d& out, double bend_m) const {
  const double acceleration = kBrakingShare * strength(out.normalized() - in.normalized());
  return corner_speed(cosine_between(in, out), config_.corner_m, acceleration, bend_m);
}

/// Limits the speed at corners that are close together: each of them may be gentle, but all together a sharp turn.
void Tracker::slow_down_in_bends() {
  const auto leg = [&](std::size_t i) { return Vector3d(corners_[i].p_W - corners_[i - 1].p_W); };
  for (std::size_t i = 1; i + 2 < corners_.size(); ++i) {
    for (std::size_t j = i + 1; j + 1 < corners_.size() && corners_[j].s - corners_[i].s < kBendM; ++j) {
      const double speed = turn_speed(leg(i), leg(j + 1), corners_[j].s - corners_[i].s);
      for (std::size_t k = i; k <= j; ++k) corners_[k].speed = std::min(corners_[k].speed, speed);
    }
  }
}

std::size_t Tracker::leg_at(double s) const {
  std::size_t i = 1;
  while (i + 1 < corners_.size() && corners_[i].s <= s) ++i;
  return i;
}

Vector3d Tracker::point_at(double s) const {
  const std::size_t i = leg_at(s);
  const double length = corners_[i].s - corners_[i - 1].s;
  if (length < kMinLegM) return corners_[i].p_W;
  const double t = std::clamp((s - corners_[i - 1].s) / length, 0.0, 1.0);
  return corners_[i - 1].p_W + t * (corners_[i].p_W - corners_[i - 1].p_W);
}

void Tracker::advance_progress() {
  // To the nearest point of the polyline that is at most `window` ahead, and not beyond an unreached sharp corner.
  const double window = kMinLookAheadM + mass_.v_WB.norm() * kLookAheadS;
  double best = std::numeric_limits<double>::infinity(), best_s = progress_;
  for (std::size_t i = leg_at(progress_); i < corners_.size(); ++i) {
    const Vector3d a = corners_[i - 1].p_W, ab = corners_[i].p_W - a;
    const double length = ab.norm();
    const double from = std::max(progress_, corners_[i - 1].s) - corners_[i - 1].s;
    const double to = std::min(progress_ + window, corners_[i].s) - corners_[i - 1].s;
    if (from > to) break;
    const double along = length < kMinLegM ? from : std::clamp((mass_.p_WB - a).dot(ab) / length, from, to);
    const double s = corners_[i - 1].s + along;
    const double distance = (mass_.p_WB - (length < kMinLegM ? a : Vector3d(a + ab * (along / length)))).norm();
    if (distance < best - kNearerPointM) {
      best = distance;
      best_s = s;
    }
    if (!corners_[i].sharp) continue;
    if ((mass_.p_WB - corners_[i].p_W).norm() > kTouchM) break;
    best_s = corners_[i].s;
    best = std::numeric_limits<double>::infinity();
  }
  progress_ = std::max(progress_, best_s);
}

double Tracker::speed_limit(double dt_s) const {
  const std::size_t leg = leg_at(progress_);
  double limit = std::min(config_.max_speed_mps, corners_[leg].leg_speed);
  double a = std::numeric_limits<double>::infinity();
  for (std::size_t i = leg; i < corners_.size(); ++i) {
    const bool last = i + 1 == corners_.size();
    double ahead = std::max(0.0, corners_[i].s - progress_);
    // A mass beside the end of the path still has some way to go.
    if (last && ahead < kTouchM) ahead = std::max(ahead, (corners_[i].p_W - mass_.p_WB).norm());
    a = std::min(a, corners_[i].braking);
    const double weakest = kBrakingShare * config_.max_sink_acceleration_mps2;
    if (ahead > limit * limit / (2.0 * std::min(a, weakest)) + limit * dt_s + 1.0) break;
    const double next_leg = last ? 0.0 : corners_[i + 1].leg_speed;
    const double at_corner = last ? 0.0 : std::min(corners_[i].speed, next_leg);
    // The speed holds until the next step, so the distance flown in one step is subtracted. Formula: v that solves
    // v^2 = at_corner^2 + 2 a (ahead - v dt / 2).
    const double braking = std::sqrt(at_corner * at_corner + 2.0 * a * ahead + 0.25 * a * a * dt_s * dt_s);
    limit = std::min(limit, std::max(at_corner, braking - 0.5 * a * dt_s));
  }
  return limit;
}

void Tracker::accelerate(const Vector3d& v_goal, double dt_s) {
  const Vector3d dv = v_goal - mass_.v_WB;
  const Vector3d v = mass_.v_WB + shortened(dv, strength(dv) * dt_s);
  mass_.a_WB = (v - mass_.v_WB) / dt_s;
  mass_.p_WB += 0.5 * (mass_.v_WB + v) * dt_s;
  mass_.v_WB = v;
}

void Tracker::smooth() {
  track_.pop_front();
  track_.push_back(mass_);
  Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), a = Vector3d::Zero();
  for (const Setpoint& at : track_) {
    p += at.p_WB - mass_.p_WB;
    v += at.v_WB;
    a += at.a_WB;
  }
  const auto count = static_cast<double>(track_.size());
  ref_.p_WB = mass_.p_WB + p / count;
  ref_.v_WB = v / count;
  ref_.a_WB = a / count;
}

void Tracker::advance_along_path(double pace, double dt_s) {
  if (corners_.empty()) lay_out(waypoints_);
  advance_progress();
  const Corner& end = corners_.back();
  const double to_end = (end.p_W - mass_.p_WB).norm();
  const double step_speed = strength(-mass_.v_WB) * dt_s;
  if (end.s - progress_ < kTouchM && to_end <= step_speed * dt_s && mass_.v_WB.norm() <= step_speed) {
    mass_.a_WB = -mass_.v_WB / dt_s;
    mass_.v_WB.setZero();
    mass_.p_WB = end.p_W;
    progress_ = end.s;
    done_ = true;
    return;
  }
  double look = progress_ + std::max(kMinLookAheadM, kLookAheadS * mass_.v_WB.norm());
  for (std::size_t i = leg_at(progress_); i < corners_.size(); ++i) {
    if (!corners_[i].sharp || corners_[i].s <= progress_) continue;
    look = std::min(look, corners_[i].s);
    break;
  }
  const Vector3d target = point_at(std::min(look, end.s));
  const Vector3d ahead = target - mass_.p_WB;
  const double speed = std::min({pace * speed_limit(dt_s), ahead.norm() / dt_s, speed_limit_mps_});
  accelerate(ahead.norm() < kTiny ? Vector3d::Zero().eval() : Vector3d(ahead.normalized() * speed), dt_s);
}

void Tracker::advance_yaw(double dt_s) {
  if (!yaw_goal_) return;
  const double step = config_.max_yaw_rate * dt_s;
  ref_.yaw = wrap_angle(ref_.yaw + std::clamp(wrap_angle(*yaw_goal_ - ref_.yaw), -step, step));
}

std::optional<TrajectoryCommand> Tracker::step(const RigidBodyState& state, double dt_s) {
  if (mode_ == Mode::off || mode_ == Mode::stand_by) return std::nullopt;
  if (mode_ != Mode::setpoint) {
    const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kLongestStepS - kTiny)));
    const double step_s = dt_s / steps;
    if (!started_) ref_.yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
    double error = (ref_.p_WB - state.p_WB).norm();
    const bool on_ground = begins_on_ground();
    if (!started_ || error > config_.lost_error_m || on_ground) {
      forget_flown_legs();
      start_from(state.p_WB, on_ground ? Vector3d::Zero() : state.v_WB, step_s);
      error = 0.0;
    } else if (track_.empty()) {
      start_from(ref_.p_WB, ref_.v_WB, step_s);
    }
    const double behind = (error - config_.slow_down_error_m) / config_.slow_down_error_m;
    const double pace = std::clamp(1.0 - behind, kSlowestPace, 1.0);
    for (int i = 0; i < steps; ++i) {
      if (mode_ == Mode::path && !done_) {
        advance_along_path(pace, step_s);
      } else {
        accelerate(Vector3d::Zero(), step_s);
      }
      smooth();
    }
    advance_yaw(dt_s);
  }
  TrajectoryCommand command{ref_.p_WB, ref_.v_WB, ref_.a_WB, ref_.yaw};
  if (command.p_WB.norm() < kNoPositionM) command.p_WB = Vector3d(0.0, 0.0, kNoPositionM);
  return command;
}

std::vector<Vector3d> Tracker::stopping_places(double dt_s) const {
  std::vector<Vector3d> places = {ref_.p_WB};
  if (!moves() || track_.empty()) return places;
  Tracker stops = *this;
  stops.hold();
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kLongestStepS - kTiny)));
  while (!stops.ref_.v_WB.isZero(kTiny) || stops.ref_.p_WB != stops.mass_.p_WB) {
    for (int i = 0; i < steps; ++i) {
      stops.accelerate(Vector3d::Zero(), dt_s / steps);
      stops.smooth();
    }
    places.push_back(stops.ref_.p_WB);
    if (places.size() > kMostStoppingSteps) break;
  }
  return places;
}

TrackingState Tracker::tracking() const {
  TrackingState state;
  state.setpoint = mass_;
  state.setpoint.yaw = ref_.yaw;
  const bool at_rest = ref_.p_WB == mass_.p_WB && ref_.v_WB.isZero(0.0);
  state.done = done_ && (at_rest || mode_ != Mode::path);
  state.airborne = started_;
  state.leg = done_ ? waypoints_.size() : (corners_.empty() ? 0 : leg_at(progress_) - 1);
  return state;
}

}  // namespace skein::agent
