// Rebuilds all beams of a scan from what a UAV hears of its LiDAR: the points that returned, the angle of the servo,
// and its own odometry. What did not return is no point in the cloud, so each point is given to the beam in whose
// direction it lies, and what is left over returned nothing.
//
// A cloud is in the order of the beams and all its points lie on their lines, so one that does not shows that the
// odometry or the angle was wrong: then nothing is known of the whole scan. Points are placed from the pose at the end
// of the scan, so this holds with motion distortion, too; there each column gets the pose that it was fired from.
// Frames: W world, B body, L LiDAR.   Units: SI, radians.   Pure; threads: one.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/scenario.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/onboard/body_track.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"

namespace skein::agent {

class BeamReader {
 public:
  explicit BeamReader(const LidarConfig& config);

  /// The odometry of an exchange, and the servo at a scan: both up to the scan that is read next, in their order.
  void hear(Tick tick, const RigidBodyState& state) { track_.add(tick, state); }
  void hear(const LidarServo& servo);

  /// @param others  bodies of the other UAVs, as far as this one knows of them. What a beam met there is no structure,
  ///                and one that met nothing there may have missed structure that the body hid.
  BeamScan read(const Scan& scan, std::span<const KnownBody> others);

  /// Scans read so far, by what was wrong with them.
  std::uint64_t scans(ScanDoubt doubt) const { return scans_[static_cast<std::size_t>(doubt)]; }

 private:
  const LidarServo* servo_at(Tick tick) const;
  std::optional<double> servo_angle(Tick scan, Tick tick) const;
  ScanDoubt place(BeamScan& scan, BodyTrack::Pose& end) const;
  bool assign(const Scan& scan, const BodyTrack::Pose& end, BeamScan& beams) const;
  std::optional<std::size_t> beam_of(const Vector3d& direction_L) const;
  struct Window {
    int first_ring = 0, last_ring = 0;
    int column = 0, columns_aside = 0;
  };
  Window window_about(const Vector3d& p_L, double radius_m) const;
  void mark(std::size_t beam, const Isometry3d& X_WL, const KnownBody& body, BeamScan::Beam& marked) const;
  void mark(std::span<const KnownBody> others, BeamScan& beams) const;

  LidarConfig config_;
  Tick period_;
  double column_step_, ring_step_;  ///< between neighbouring beams; no ring_step_: all in one plane
  double most_off_;                 ///< a point that is farther from its beam's line belongs to none
  std::vector<Vector3d> directions_L_;
  BodyTrack track_;
  std::deque<LidarServo> servos_;
  std::array<std::uint64_t, 4> scans_ = {};
};

}  // namespace skein::agent
