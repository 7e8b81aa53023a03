#include "uav_agent/onboard/body_track.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

/// Cubic Hermite curve over h seconds, from values and derivatives at both ends, at the share s of that time.
Vector3d hermite(double s, double h, const Vector3d& x0, const Vector3d& v0, const Vector3d& x1, const Vector3d& v1) {
  const double s2 = s * s, s3 = s2 * s;
  // Formula: the base functions of these curves.
  return (2.0 * s3 - 3.0 * s2 + 1.0) * x0 + (s3 - 2.0 * s2 + s) * h * v0 + (3.0 * s2 - 2.0 * s3) * x1 +
         (s3 - s2) * h * v1;
}

Vector3d rotation_vector(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

Quaterniond turned_by(const Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0.0) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

}  // namespace

void BodyTrack::add(Tick tick, const RigidBodyState& state) {
  if (!samples_.empty() && samples_.back().tick >= tick) samples_.clear();
  samples_.push_back({tick, state});
  // One sample older than the memory stays: at() may have to interpolate between it and the next one.
  while (samples_.size() > 1 && samples_[1].tick <= tick - memory_) samples_.pop_front();
}

std::optional<BodyTrack::Pose> BodyTrack::at(Tick tick) const {
  const auto after = std::ranges::lower_bound(samples_, tick, {}, &Sample::tick);
  if (after == samples_.end()) return std::nullopt;
  if (after->tick == tick) return Pose{after->state.X_WB()};
  if (after == samples_.begin()) return std::nullopt;
  const Sample& before = *std::prev(after);
  if (after->tick - before.tick > longest_gap_) return std::nullopt;
  const double h = seconds(after->tick - before.tick), s = seconds(tick - before.tick) / h;
  const RigidBodyState &a = before.state, &b = after->state;
  const Vector3d p_WB = hermite(s, h, a.p_WB, a.v_WB, b.p_WB, b.v_WB);
  const Vector3d turn = rotation_vector(a.q_WB.conjugate() * b.q_WB);
  // The rate of the rotation vector, from that of the body: the first terms of a series in `turn` (formula).
  const Vector3d& w = b.w_WB_B;
  const Vector3d turn_rate = w + 0.5 * turn.cross(w) + turn.cross(turn.cross(w)) / 12.0;  // formula: as above
  const Quaterniond q_WB = a.q_WB * turned_by(hermite(s, h, Vector3d::Zero(), a.w_WB_B, turn, turn_rate));
  const double part = h * h / 16.0;  // formula: largest error per unit of acceleration, half-way
  return Pose{Eigen::Translation3d(p_WB) * q_WB, part * kMostAcceleration, part * kMostAngularAcceleration};
}

}  // namespace skein::agent
