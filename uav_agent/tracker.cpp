#include "uav_agent/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "core/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kBrakingShare = 0.8;  ///< of the acceleration limit; the rest keeps the UAV on the line
constexpr double kLookAheadS = 0.3;    ///< how far ahead on the path the point mass heads for
constexpr double kMinLookAheadM = 0.15;
constexpr double kTouchM = 0.1;  ///< a sharp corner counts as reached this close
constexpr double kSharpSpeedMps = 0.3;
constexpr double kSharpCosine = 0.5;   ///< turns of more than 60 degrees are sharp
constexpr double kMinLegM = 1e-3;      ///< shorter legs are no legs
constexpr double kSlowestPace = 0.1;   ///< of a set-point that waits for its UAV
constexpr double kNoPositionM = 0.02;  ///< the controller takes |p| < 0.01 for "no position"

Vector3d shortened(const Vector3d& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vector3d(v * (length / norm)) : v;
}

/// Greatest speed at which a turn cuts its corner by no more than `cut`: the circle that touches both legs.
double corner_speed(double cosine, double cut, double acceleration) {
  const double half = std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)));  // cosine of half the turn
  if (half > 1.0 - 1e-6) return std::numeric_limits<double>::infinity();
  return std::sqrt(acceleration * cut * half / (1.0 - half));
}

}  // namespace

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
  yaw_goal_ = setpoint.yaw;
}

void Tracker::start_from(const RigidBodyState& state) {
  ref_.p_WB = state.p_WB;
  ref_.v_WB = shortened(state.v_WB, config_.max_speed_mps);
  ref_.a_WB.setZero();
  if (!started_) ref_.yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
  started_ = true;
  if (mode_ == Mode::path && !corners_.empty()) {
    const std::size_t leg = std::min(leg_at(progress_), waypoints_.size());
    waypoints_.erase(waypoints_.begin(), waypoints_.begin() + static_cast<std::ptrdiff_t>(leg) - 1);
    corners_.clear();
    progress_ = 0.0;
  }
}

void Tracker::lay_out(const std::vector<Waypoint>& waypoints) {
  corners_.assign(1, Corner{.p_W = ref_.p_WB});
  for (const Waypoint& waypoint : waypoints) {
    const double length = (waypoint.p_WB - corners_.back().p_W).norm();
    const double speed = std::clamp(waypoint.speed_mps, 0.05, config_.max_speed_mps);
    // Every waypoint keeps its corner, so that legs can be told by number; an empty leg just has no length.
    corners_.push_back(Corner{.p_W = waypoint.p_WB, .s = corners_.back().s + length, .leg_speed = speed});
  }
  const double acceleration = kBrakingShare * config_.max_acceleration_mps2;
  for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
    const Vector3d in = corners_[i].p_W - corners_[i - 1].p_W;
    const Vector3d out = corners_[i + 1].p_W - corners_[i].p_W;
    const bool turns = in.norm() > kMinLegM && out.norm() > kMinLegM;
    const double cosine = turns ? in.dot(out) / (in.norm() * out.norm()) : 1.0;
    corners_[i].sharp = cosine < kSharpCosine;
    corners_[i].speed = corners_[i].sharp ? kSharpSpeedMps : corner_speed(cosine, config_.corner_m, acceleration);
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
  // The nearest point of the polyline, not far ahead and not beyond a sharp corner that was not touched yet.
  const double window = kMinLookAheadM + ref_.v_WB.norm() * kLookAheadS;
  double best = std::numeric_limits<double>::infinity(), best_s = progress_;
  for (std::size_t i = leg_at(progress_); i < corners_.size(); ++i) {
    const Vector3d a = corners_[i - 1].p_W, ab = corners_[i].p_W - a;
    const double length = ab.norm();
    const double from = std::max(progress_, corners_[i - 1].s) - corners_[i - 1].s;
    const double to = std::min(progress_ + window, corners_[i].s) - corners_[i - 1].s;
    if (from > to) break;
    const double along = length < kMinLegM ? from : std::clamp((ref_.p_WB - a).dot(ab) / length, from, to);
    const double s = corners_[i - 1].s + along;
    const double distance = (ref_.p_WB - (length < kMinLegM ? a : Vector3d(a + ab * (along / length)))).norm();
    if (distance < best - 1e-12) {
      best = distance;
      best_s = s;
    }
    if (!corners_[i].sharp) continue;
    if ((ref_.p_WB - corners_[i].p_W).norm() > kTouchM) break;
    best_s = corners_[i].s;
    best = std::numeric_limits<double>::infinity();
  }
  progress_ = std::max(progress_, best_s);
}

double Tracker::speed_limit(double dt_s) const {
  const double a = kBrakingShare * config_.max_acceleration_mps2;
  double limit = config_.max_speed_mps;
  for (std::size_t i = leg_at(progress_); i < corners_.size(); ++i) {
    const bool last = i + 1 == corners_.size();
    double ahead = std::max(0.0, corners_[i].s - progress_);
    // Beside the end there is still a way to go.
    if (last && ahead < kTouchM) ahead = std::max(ahead, (corners_[i].p_W - ref_.p_WB).norm());
    if (i == leg_at(progress_)) limit = std::min(limit, corners_[i].leg_speed);
    if (ahead > limit * limit / (2.0 * a) + limit * dt_s + 1.0) break;
    const double next_leg = last ? 0.0 : corners_[i + 1].leg_speed;
    const double at_corner = last ? 0.0 : std::min(corners_[i].speed, next_leg);
    // One step's travel is taken off, as the speed holds until the next step.
    const double braking = std::sqrt(at_corner * at_corner + 2.0 * a * ahead + 0.25 * a * a * dt_s * dt_s);
    limit = std::min(limit, std::max(at_corner, braking - 0.5 * a * dt_s));
  }
  return limit;
}

void Tracker::accelerate(const Vector3d& v_goal, double dt_s) {
  const Vector3d dv = shortened(v_goal - ref_.v_WB, config_.max_acceleration_mps2 * dt_s);
  const Vector3d v = shortened(ref_.v_WB + dv, config_.max_speed_mps);
  ref_.a_WB = shortened((v - ref_.v_WB) / dt_s, config_.max_acceleration_mps2);
  ref_.p_WB += 0.5 * (ref_.v_WB + v) * dt_s;
  ref_.v_WB = v;
}

void Tracker::advance_along_path(double pace, double dt_s) {
  if (corners_.empty()) lay_out(waypoints_);
  advance_progress();
  const Corner& end = corners_.back();
  const double to_end = (end.p_W - ref_.p_WB).norm();
  const double step_speed = config_.max_acceleration_mps2 * dt_s;
  if (end.s - progress_ < kTouchM && to_end <= step_speed * dt_s && ref_.v_WB.norm() <= step_speed) {
    ref_.a_WB = -ref_.v_WB / dt_s;
    ref_.v_WB.setZero();
    ref_.p_WB = end.p_W;
    progress_ = end.s;
    done_ = true;
    return;
  }
  double look = progress_ + std::max(kMinLookAheadM, kLookAheadS * ref_.v_WB.norm());
  for (std::size_t i = leg_at(progress_); i < corners_.size(); ++i) {
    if (!corners_[i].sharp || corners_[i].s <= progress_) continue;
    look = std::min(look, corners_[i].s);
    break;
  }
  const Vector3d target = point_at(std::min(look, end.s));
  const Vector3d ahead = target - ref_.p_WB;
  const double speed = std::min(pace * speed_limit(dt_s), ahead.norm() / dt_s);
  accelerate(ahead.norm() < 1e-9 ? Vector3d::Zero().eval() : Vector3d(ahead.normalized() * speed), dt_s);
}

void Tracker::advance_yaw(double dt_s) {
  if (!yaw_goal_) return;
  const double step = config_.max_yaw_rate * dt_s;
  ref_.yaw = wrap_angle(ref_.yaw + std::clamp(wrap_angle(*yaw_goal_ - ref_.yaw), -step, step));
}

std::optional<TrajectoryCommand> Tracker::step(const RigidBodyState& state, double dt_s) {
  if (mode_ == Mode::off) return std::nullopt;
  const double error = (ref_.p_WB - state.p_WB).norm();
  if (mode_ != Mode::setpoint) {
    if (!started_ || error > config_.lost_error_m) start_from(state);
    const double behind = (error - config_.slow_down_error_m) / config_.slow_down_error_m;
    const double pace = std::clamp(1.0 - behind, kSlowestPace, 1.0);
    if (mode_ == Mode::path && !done_) {
      advance_along_path(pace, dt_s);
    } else {
      accelerate(Vector3d::Zero(), dt_s);
    }
    advance_yaw(dt_s);
  }
  TrajectoryCommand command{ref_.p_WB, ref_.v_WB, ref_.a_WB, ref_.yaw};
  if (command.p_WB.norm() < kNoPositionM) command.p_WB = Vector3d(0.0, 0.0, kNoPositionM);
  return command;
}

TrackingState Tracker::tracking() const {
  TrackingState state;
  state.setpoint = ref_;
  state.done = done_;
  state.airborne = started_;
  state.leg = done_ ? waypoints_.size() : (corners_.empty() ? 0 : leg_at(progress_) - 1);
  return state;
}

}  // namespace skein::agent
