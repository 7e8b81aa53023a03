#include "tests/sensing/sensed_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "sim_server/sensors/lost_returns.hpp"

namespace skein::sensing {
namespace {

using std::numbers::pi;

Isometry3d at(double x, double y, double z, double yaw = 0.0, double pitch = 0.0) {
  return Eigen::Translation3d(x, y, kHeightM + z) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Vector3d::UnitY());
}

/// Time since departure [s]: at first the UAV stays at its start for 8 s, for a sweep of its servo.
double moving_s(double t) { return std::max(0.0, t - 8.0); }

/// Distance of the point p from the segment a b.
double distance(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d ab = b - a;
  const double part = ab.squaredNorm() > 0.0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + part * ab - p).norm();
}

}  // namespace

std::vector<Flight> flights() {
  return {
      {"Still", 8.0, [](double) { return at(0, 0, 0); }},
      {"HoveringInWind", 60.0,
       [](double t) {
         return at(0.04 * std::sin(0.7 * t), 0.04 * std::sin(1.1 * t), 0.03 * std::sin(0.9 * t),
                   0.01 * std::sin(0.3 * t), 0.006 * std::sin(2.1 * t));
       }},
      {"Turning", 24.0, [](double t) { return at(0, 0, 0, 0.2 * t); }},
      {"Creeping", 60.0, [](double t) { return at(0.1 * t, 0, 0); }},
      {"AlongALine", 28.0, [](double t) { return at(2.0 * moving_s(t), 0, 0, 0, 0.03 * std::sin(t)); }},
      {"InACircle", 48.0,
       [](double t) {
         const double a = 2.0 * moving_s(t) / 15.0;
         return at(15.0 * std::cos(a), 15.0 * std::sin(a), 5.0 * std::sin(0.7 * a), a + 0.5 * pi,
                   0.05 * std::sin(3.0 * t));
       }},
  };
}

agent::WorldMapper::Config exact_map() {
  agent::WorldMapper::Config config;
  config.map.to_m = {50.0};
  config.every = 1;
  config.bundle_rad = 0.0;
  return config;
}

SensedSpace::SensedSpace(const Flight& flight, double servo_phase_s, const agent::WorldMapper::Config& config,
                         const LidarConfig& lidar, const LidarConfig& told)
    : lidar_(lidar), mapper_(told, config) {
  for (int ring = 0; ring < lidar_.rings; ++ring) {
    for (int column = 0; column < lidar_.columns; ++column) {
      beams_L_.push_back(lidar_direction_L(lidar_, ring, column));
    }
  }
  agent::BeamScan scan{.columns = lidar_.columns};
  scan.beams.assign(beams_L_.size(), {agent::BeamState::none, 0.0F});
  for (Tick tick = 0; seconds(tick) < flight.duration_s; tick += lidar_period(lidar_)) {
    const double t = seconds(tick);
    const Isometry3d X_WL = lidar_pose(flight.X_WB(t), servo_angle(lidar_, t + servo_phase_s));
    scans_.push_back(X_WL);
    inverse_.push_back(X_WL.inverse());
    scan.tick = tick;
    scan.fired = {{.first_column = 0, .tick = tick, .X_WL = X_WL}};
    mapper_.insert(scan);
  }
  lose(1);
}

void SensedSpace::lose(std::uint64_t seed) {
  sim::LostReturns lost(lidar_, UavIndex{0}, seed);
  lost_.clear();
  for (std::size_t scan = 0; scan < scans_.size(); ++scan) {
    lost_.push_back(lost.of(static_cast<Tick>(scan) * lidar_period(lidar_)));
  }
}

double SensedSpace::distance_to_route_m(const Vector3d& p_W) const {
  double nearest = std::numeric_limits<double>::max();
  for (const Isometry3d& X_WL : scans_) nearest = std::min(nearest, (X_WL.translation() - p_W).norm());
  return nearest;
}

/// Goes along the member in steps of a quarter of the beam spacing, and tests the beams near each step.
bool SensedSpace::meets(std::size_t scan, const Vector3d& from_W, const Vector3d& to_W, double width_m) const {
  const Vector3d a = inverse_[scan] * from_W, b = inverse_[scan] * to_W;
  const double length = (b - a).norm();
  const Vector3d u = (b - a) / length;
  const double half_fov = 0.5 * lidar_.vertical_fov_deg * kRadPerDeg;
  for (double s = 0.0; s <= length;) {
    const Vector3d p = a + s * u;
    const double r = p.norm(), elevation = std::asin(p.z() / r), above = std::abs(elevation) - half_fov;
    if (above > width_m / r) {  // outside the vertical field of view: skips to where a ring may hit again
      s += std::max(0.01, 0.9 * r * above);
      continue;
    }
    const int ring = std::clamp(static_cast<int>(std::lround(0.5 * (lidar_.rings - 1) * (elevation / half_fov + 1.0))),
                                0, lidar_.rings - 1);
    const auto nearest = static_cast<int>(std::lround(0.5 * lidar_.columns * (std::atan2(p.y(), p.x()) / pi + 1.0)));
    for (const int step : {0, -1, 1}) {
      const int column = (nearest + step + lidar_.columns) % lidar_.columns;
      const auto number = static_cast<std::size_t>(ring * lidar_.columns + column);
      if (lost_[scan][number]) continue;
      const Vector3d& beam = beams_L_[number];
      // The points of member and beam that are nearest to each other.
      const double along = beam.dot(u), apart = 1.0 - along * along;
      const double on_member = apart < 1e-12 ? 0.0 : std::clamp((along * a.dot(beam) - a.dot(u)) / apart, 0.0, length);
      const Vector3d q = a + on_member * u;
      const double on_beam = std::clamp(q.dot(beam), 0.0, lidar_.range_max_m);
      if ((on_beam * beam - q).norm() < 0.5 * width_m) return true;
    }
    s += std::max(0.01, 0.0035 * r);
  }
  return false;
}

bool SensedSpace::saw(const Member& member, const Vector3d& a_W, const Vector3d& b_W, double reach_m) const {
  double low = member.length_m, high = -member.length_m;
  constexpr int kParts = 80;
  for (int part = 0; part <= kParts; ++part) {
    const double s = (static_cast<double>(part) / kParts - 0.5) * member.length_m;
    if (distance(a_W, b_W, member.p_W + s * member.direction_W) > reach_m) continue;
    low = std::min(low, s);
    high = std::max(high, s);
  }
  if (high <= low) return false;
  const Vector3d from_W = member.p_W + low * member.direction_W, to_W = member.p_W + high * member.direction_W;
  // In an order in which successive scans are far apart, so that one of the first already sees most members.
  const std::size_t count = scans_.size(), stride = 37;
  for (std::size_t i = 0, scan = 0; i < count; ++i, scan += stride) {
    const std::size_t one = count % stride == 0 ? i : scan % count;
    if ((scans_[one].translation() - member.p_W).norm() > lidar_.range_max_m + member.length_m) continue;
    if (meets(one, from_W, to_W, member.width_m)) return true;
  }
  return false;
}

Vector3d drawn_direction(RandomStream& random) {
  for (;;) {
    const Vector3d v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (const double norm = v.norm(); norm > 0.01 && norm <= 1.0) return v / norm;
  }
}

Member drawn_member(RandomStream& random, const Vector3d& a_W, const Vector3d& b_W) {
  Member member;
  const double reach = 0.5 * member.length_m + kBodyRadiusM;
  const Vector3d low = a_W.cwiseMin(b_W) - Vector3d::Constant(reach),
                 high = a_W.cwiseMax(b_W) + Vector3d::Constant(reach);
  for (;;) {
    member.direction_W = drawn_direction(random);
    for (int axis = 0; axis < 3; ++axis) member.p_W[axis] = random.uniform(low[axis], high[axis]);
    constexpr int kParts = 40;
    for (int part = 0; part <= kParts; ++part) {
      const double s = (static_cast<double>(part) / kParts - 0.5) * member.length_m;
      if (distance(a_W, b_W, member.p_W + s * member.direction_W) < kBodyRadiusM) return member;
    }
  }
}

}  // namespace skein::sensing
