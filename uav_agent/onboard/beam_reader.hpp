// Reconstructs all beams of a LiDAR scan from the point cloud, the servo's angles and the UAV's odometry. The cloud has
// no points for beams without a return, so the reader assigns each point to the beam in whose direction it lies; beams
// that get no point returned nothing.
//
// The points of a cloud are in the order of the beams, and each lies on the line of its beam. If one does not, the
// odometry or servo angle was wrong, and the whole scan is rejected (ScanDoubt::misfit). The simulator computes the
// points of a scan in W from the pose at its end, so this holds with motion distortion, too; each column's Firing then
// has the pose from which it was fired.
// Frames: W world, B body, L LiDAR.   Units: SI, radians.   Pure; threads: one.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/onboard/body_track.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"

namespace skein::agent {

class BeamReader {
 public:
  explicit BeamReader(const LidarConfig& config);

  /// Enters the odometry of an exchange, or the servo's angle at a scan. Before read(), enter all of them up to at
  /// least the tick of the scan, in order of time.
  void hear(Tick tick, const RigidBodyState& state) { track_.add(tick, state); }
  void hear(const LidarServo& servo);

  /// Reconstructs the beams of a scan.
  /// @param others  bodies of other UAVs, as far as known. A beam that ended in a body hit no structure
  ///                (BeamState::uav); a beam without return that passes a body says nothing (BeamState::unknown).
  BeamScan read(const Scan& scan, std::span<const KnownBody> others);

  /// Number of scans read so far, by doubt.
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
  double column_step_, ring_step_;  ///< angle between neighbouring beams; ring_step_ 0: one ring
  double most_off_;                 ///< greatest angle between a point's direction and its beam [rad]
  std::vector<Vector3d> directions_L_;
  BodyTrack track_;
  std::deque<LidarServo> servos_;
  std::array<std::uint64_t, 4> scans_ = {};
};

}  // namespace skein::agent
