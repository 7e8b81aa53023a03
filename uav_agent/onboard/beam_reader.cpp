#include "uav_agent/onboard/beam_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

constexpr double kPi = std::numbers::pi;
/// Largest angle between a point and its beam because directions have single precision. Numeric.
constexpr double kRoundingRad = 1e-4;
/// Largest error of a point, relative to its largest coordinate: coordinates have single precision. Numeric.
constexpr double kRoundingOfCoordinates = 4.0 * std::numeric_limits<float>::epsilon();
/// Range noise moves a point along its beam, even beyond the LiDAR's range, by at most this many standard deviations.
constexpr double kSigmas = 7.0;  ///< chosen: no draw of the normal distribution is farther off
constexpr Tick kLongestGap =
    kTicksPerSecond / 10;                  ///< in the odometry; chosen: the interpolation error grows with its square
constexpr Tick kMemory = kTicksPerSecond;  ///< the longest exchange period
constexpr double kServoRounding = 1e-6;    ///< [rad]; numeric

bool meets(const Vector3d& from_W, const Vector3d& direction_W, double reach_m, const KnownBody& body) {
  const Vector3d to_body = body.p_W - from_W;
  const double along = std::clamp(to_body.dot(direction_W), 0.0, reach_m);
  return (to_body - along * direction_W).squaredNorm() < body.radius_m * body.radius_m;
}

}  // namespace

BeamReader::BeamReader(const LidarConfig& config)
    : config_(config),
      period_(lidar_period(config)),
      column_step_(2.0 * kPi / config.columns),
      ring_step_(config.rings > 1 ? config.vertical_fov_deg * kRadPerDeg / (config.rings - 1) : 0.0),
      track_(kMemory + 2 * period_, kLongestGap) {
  for (int ring = 0; ring < config.rings; ++ring) {
    for (int column = 0; column < config.columns; ++column) {
      directions_L_.push_back(lidar_direction_L(config, ring, column));
    }
  }
  // The columns of the outermost rings are closest together, so these rings determine the tolerance.
  const double closest = column_step_ * std::cos(ring_elevation(config, 0));
  // Chosen: a quarter of the distance.
  most_off_ = 0.25 * (ring_step_ > 0.0 ? std::min(closest, ring_step_) : closest);
}

void BeamReader::hear(const LidarServo& servo) {
  servos_.push_back(servo);
  while (servos_.front().tick < servo.tick - kMemory - 2 * period_) servos_.pop_front();
}

const LidarServo* BeamReader::servo_at(Tick tick) const {
  const auto found = std::ranges::find(servos_, tick, &LidarServo::tick);
  return found == servos_.end() ? nullptr : &*found;
}

/// Angle of the servo at a tick, from its angles and rates at this scan and at the one before. Between two scans, the
/// servo turns at a constant rate, except that it may stop at its limit or turn back once.
std::optional<double> BeamReader::servo_angle(Tick scan, Tick tick) const {
  const LidarServo* now = servo_at(scan);
  if (now == nullptr) return std::nullopt;
  if (tick == scan) return now->angle;
  const LidarServo* then = servo_at(scan - period_);
  if (then == nullptr || ticks(0.5 * config_.servo_period_s) < period_) return std::nullopt;
  const double limit = config_.servo_limit_deg * kRadPerDeg;
  const auto angle = [&](Tick t) {
    const double onwards = then->angle + then->rate * seconds(t - then->tick);
    const double backwards = now->angle - now->rate * seconds(now->tick - t);
    if (then->rate > now->rate) return std::min({onwards, backwards, limit});
    if (then->rate < now->rate) return std::max({onwards, backwards, -limit});
    return then->angle +
           (now->angle - then->angle) * static_cast<double>(t - then->tick) / static_cast<double>(period_);
  };
  const bool fits = std::abs(angle(then->tick) - then->angle) < kServoRounding &&
                    std::abs(angle(now->tick) - now->angle) < kServoRounding;
  return fits ? std::optional(angle(tick)) : std::nullopt;
}

/// Stores in the scan the poses from which its columns were fired. @param end  becomes the LiDAR's pose at the end.
ScanDoubt BeamReader::place(BeamScan& scan, BodyTrack::Pose& end) const {
  const auto fire = [&](int first, Tick tick) {
    const std::optional<double> angle = servo_angle(scan.tick, tick);
    if (!angle) return ScanDoubt::no_servo;
    const std::optional<BodyTrack::Pose> body = track_.at(tick);
    if (!body) return ScanDoubt::no_pose;
    end = *body;
    end.X_WB = lidar_pose(body->X_WB, *angle);
    scan.fired.push_back({first, tick, end.X_WB, body->error_m, body->error_rad});
    return ScanDoubt::none;
  };
  if (fired_at_once(config_, scan.tick)) return fire(0, scan.tick);
  for (Tick part = 0; part < period_; ++part) {
    const int first = first_column(config_, part);
    if (first == first_column(config_, part + 1)) continue;
    if (const ScanDoubt doubt = fire(first, fired_at(config_, scan.tick, part)); doubt != ScanDoubt::none) return doubt;
  }
  return ScanDoubt::none;
}

std::optional<std::size_t> BeamReader::beam_of(const Vector3d& direction_L) const {
  const double elevation = std::asin(std::clamp(direction_L.z(), -1.0, 1.0));
  const double ring = ring_step_ > 0.0 ? std::round((elevation - ring_elevation(config_, 0)) / ring_step_) : 0.0;
  const double column = std::round((std::atan2(direction_L.y(), direction_L.x()) + kPi) / column_step_);
  if (!(ring >= 0.0 && ring < config_.rings) || !(column >= 0.0)) return std::nullopt;
  return static_cast<std::size_t>(ring) * static_cast<std::size_t>(config_.columns) +
         static_cast<std::size_t>(column) % static_cast<std::size_t>(config_.columns);
}

/// Assigns each point to its beam. @returns false if a point lies on no beam or is out of range, or if points are out
/// of order.
bool BeamReader::assign(const Scan& scan, const BodyTrack::Pose& end, BeamScan& beams) const {
  const Isometry3d X_LW = end.X_WB.inverse();
  const double slack = kSigmas * config_.sigma_m + end.error_m;
  std::size_t next = 0;
  for (const Eigen::Vector3f& p_W : scan.points_W) {
    const Vector3d p_L = X_LW * p_W.cast<double>();
    const double range = p_L.norm(), rounding = kRoundingOfCoordinates * p_W.cwiseAbs().maxCoeff();
    if (!(range > 0.0 && range >= config_.range_min_m - slack - rounding)) return false;
    if (!(range <= config_.range_max_m + slack + rounding)) return false;
    const Vector3d direction_L = p_L / range;
    const double allowed = kRoundingRad + (rounding + end.error_m) / range + end.error_rad;
    const double most_off = std::min(allowed, most_off_);
    const auto lies_on = [&](std::size_t beam) { return (direction_L - directions_L_[beam]).norm() <= most_off; };
    // Usually the point lies on the next beam. If so, no beam is nearer: the tolerance is at most a quarter of the
    // distance between beams.
    std::size_t beam = next;
    if (beam >= directions_L_.size() || !lies_on(beam)) {
      const std::optional<std::size_t> nearest = beam_of(direction_L);
      if (!nearest || *nearest < next || !lies_on(*nearest)) return false;
      beam = *nearest;
    }
    beams.beams[beam] = {BeamState::range, static_cast<float>(range)};
    next = beam + 1;
  }
  beams.points = scan.points_W.size();
  return true;
}

/// A window of beams that contains all beams that may meet a ball: a range of rings, and columns on both sides of one.
BeamReader::Window BeamReader::window_about(const Vector3d& p_L, double radius_m) const {
  constexpr double kMarginRad = 1e-3;  // numeric: more than kRoundingRad
  const Window all{0, config_.rings - 1, 0, config_.columns / 2};
  const double distance = p_L.norm();
  if (distance <= radius_m) return all;
  const double half = std::asin(radius_m / distance) + kMarginRad, elevation = std::asin(p_L.z() / distance);
  Window window = all;
  if (ring_step_ > 0.0) {
    const double lowest = ring_elevation(config_, 0);
    window.first_ring = std::max(0, static_cast<int>(std::ceil((elevation - half - lowest) / ring_step_)));
    window.last_ring = std::min(all.last_ring, static_cast<int>(std::floor((elevation + half - lowest) / ring_step_)));
  }
  if (std::abs(elevation) + half >= 0.5 * kPi - kMarginRad) return window;
  const double half_azimuth = std::asin(std::min(1.0, std::sin(half) / std::cos(elevation)));
  window.column = static_cast<int>(std::round((std::atan2(p_L.y(), p_L.x()) + kPi) / column_step_));
  window.columns_aside = std::min(all.columns_aside, static_cast<int>(half_azimuth / column_step_) + 1);
  return window;
}

/// Changes the state of a beam that ended in another UAV's body, or that passes it without a return.
void BeamReader::mark(std::size_t i, const Isometry3d& X_WL, const KnownBody& body, BeamScan::Beam& beam) const {
  const Vector3d direction_W = X_WL.linear() * directions_L_[i];
  const Vector3d p_W = X_WL.translation() + beam.range_m * direction_W;
  if (beam.state == BeamState::range && (p_W - body.p_W).norm() < body.radius_m) beam.state = BeamState::uav;
  if (beam.state == BeamState::none && meets(X_WL.translation(), direction_W, config_.range_max_m, body)) {
    beam.state = BeamState::unknown;
  }
}

void BeamReader::mark(std::span<const KnownBody> others, BeamScan& beams) const {
  for (std::size_t f = 0; f < beams.fired.size(); ++f) {
    const Isometry3d& X_WL = beams.fired[f].X_WL;
    const int first = beams.fired[f].first_column;
    const int end = f + 1 < beams.fired.size() ? beams.fired[f + 1].first_column : config_.columns;
    for (const KnownBody& body : others) {
      const Vector3d p_L = X_WL.inverse() * body.p_W;
      if (p_L.norm() > config_.range_max_m + body.radius_m) continue;
      const Window window = window_about(p_L, body.radius_m);
      for (int aside = -window.columns_aside; aside <= window.columns_aside; ++aside) {
        const int column = (window.column + aside + config_.columns) % config_.columns;
        if (column < first || column >= end) continue;
        for (int ring = window.first_ring; ring <= window.last_ring; ++ring) {
          const auto i = static_cast<std::size_t>(ring * config_.columns + column);
          mark(i, X_WL, body, beams.beams[i]);
        }
      }
    }
  }
}

BeamScan BeamReader::read(const Scan& scan, std::span<const KnownBody> others) {
  BeamScan beams;
  beams.tick = scan.tick;
  beams.columns = config_.columns;
  beams.beams.assign(directions_L_.size(), {BeamState::none, 0.0F});
  BodyTrack::Pose end;
  beams.doubt = place(beams, end);
  if (beams.doubt == ScanDoubt::none && !assign(scan, end, beams)) beams.doubt = ScanDoubt::misfit;
  ++scans_[static_cast<std::size_t>(beams.doubt)];
  if (beams.doubt == ScanDoubt::none) {
    mark(others, beams);
  } else {
    beams.fired.clear();
    beams.beams.assign(directions_L_.size(), {});
  }
  return beams;
}

}  // namespace skein::agent
