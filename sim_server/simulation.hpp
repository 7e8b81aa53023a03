// The whole simulated world, one exchange at a time: vehicles, sensors, radio links, mission, referee.
// Pure: no middleware, no wall clock. The same scenario, scene, seed, faults and commands give the same result, bit for
// bit, however many threads share the work.
// Threads: one, which may share its work. Frames: W world (ENU), B body (FLU).  Units: SI, radians; times are ticks.
//
// The server hands in commands at a step boundary, between two calls of advance(), and reads the events of the exchange
// in events(). LiDARs run from the beginning, cameras while the mission's clock runs. At the mission's end all
// sensors and motors stop. fleet_start.hpp, lidar.hpp and referee.hpp say what the seed draws. With seed 0, starts,
// command latency and LiDARs are without random effects; the tokens and the scenario's conditions are drawn even so.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/for_each.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "core/types.hpp"
#include "sight/camera.hpp"
#include "sim_server/mission.hpp"
#include "sim_server/referee.hpp"
#include "sim_server/run_digest.hpp"
#include "sim_server/sensors/key_frames.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "sim_server/uav_view.hpp"
#include "sim_server/work_clock.hpp"

namespace skein::sim {

/// A scan; all its points are of the instant `scan.tick`, unless the scenario has `motion_distortion` (lidar.hpp).
struct LidarEvent {
  UavIndex uav = {};
  LidarScan scan;
};

/// Angle of a LiDAR's servo when a scan was due, whether or not the scan was computed.
struct ServoEvent {
  UavIndex uav = {};
  LidarServo servo;
};

/// A scan that became a key frame. It goes to its own UAV, and once to the UAVs linked to it at this step.
struct KeyFrameEvent {
  UavIndex uav = {};
  KeyFrame key_frame;
  std::vector<UavIndex> neighbours;  ///< UAVs that receive it, in fleet order
};

/// An exposure that saw at least one point.
struct CaptureEvent {
  UavIndex uav = {};
  Capture capture;
  std::optional<Isometry3d> X_told_W = {};  ///< from W to the frame `told` of the UAV's odometry; nullopt: W itself
  std::optional<CaptureReport> report;      ///< as in the ledger: the points whose quality rose; nullopt: none
};

/// A command that was ignored.
struct RejectionEvent {
  enum class Command { trajectory, gimbal };
  UavIndex uav = {};
  Command command = Command::trajectory;
  std::string reason;       ///< a sentence for the user
  std::uint64_t total = 0;  ///< of this UAV so far, this one included
};

/// A UAV that left the world, or whose state is no longer finite: it is dead, and its body stays where it last was.
struct Stray {
  Tick tick = 0;
  UavIndex uav = {};
  Vector3d p_W = Vector3d::Zero();  ///< its last position
};

/// The events of the exchange that led to this step.
struct StepEvents {
  std::vector<LidarEvent> scans;
  std::vector<ServoEvent> servos;
  std::vector<KeyFrameEvent> key_frames;
  std::vector<CaptureEvent> captures;
  std::vector<Collision> collisions;
  std::vector<Stray> strays;
  std::vector<RejectionEvent> rejections;
  std::uint64_t ledger_begin = 0, ledger_end = 0;  ///< new entries of the referee: [begin, end)
};

class RayScene;

class Simulation {
 public:
  /// The fleet at rest on the ground at tick 0, links traced, first scans in events().
  /// @param faults  the simulation applies those of vehicles, sensors, wind and commands, and the ranges and cuts of
  ///   links. The router and the server apply the others.
  /// @throws InputError if a UAV's start or the station lies in the structure or is enclosed by it.
  Simulation(const Scenario& scenario, Scene scene, std::uint64_t seed, const FaultPlan& faults = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// A setpoint for a UAV. If several arrive within one exchange, the last one that is not refused counts. A command
  /// is refused, and listed in the next events().rejections, if a number is not finite or, with
  /// rules.reject_commands_beyond_limits, if it exceeds the vehicle's speed, acceleration or yaw rate. Commands to a
  /// dead UAV, or after the mission's end, are ignored silently.
  /// @returns false when refused.
  bool command_trajectory(UavIndex uav, const TrajectoryCommand& command);
  /// A gimbal command; refused only if a number is not finite.
  bool command_gimbal(UavIndex uav, const GimbalCommand& command);
  /// Takes a picture as soon as the trigger interval allows. From the first call on, this camera no longer triggers by
  /// itself.
  void trigger_camera(UavIndex uav);
  /// Cuts the motors for good: the UAV falls.
  void stop(UavIndex uav);

  /// A fault that waited for a condition begins with the exchange at this tick, which must be the next one.
  void set_off(std::size_t fault, Tick tick);
  /// Sets the faults that a viewer has added by hand; they follow those of the plan.
  /// @param faults  all faults by hand so far. Their effect on exchanges that are over must not change.
  void set_faults_by_hand(const std::vector<Fault>& faults);

  /// Sets whether a program reads this UAV's scans (initially: yes). A scan without a reader that would not become a
  /// key frame is not computed, because the LiDAR is the most expensive sensor. Only events().scans depends on this.
  void want_scans(UavIndex uav, bool wanted);
  /// From now on `for_each` executes independent work: scans, exposures, links, and the forces of a large fleet.
  void share_work(ForEach for_each);
  /// Announces its work to a clock from now on. @param clock  must outlive the simulation; null: no clock.
  void watch(WorkClock* clock);

  /// Simulates one exchange period; afterwards all getters return values of the new step.
  void advance();

  std::uint64_t step() const;  ///< exchanges so far
  Tick tick() const;
  std::size_t size() const;  ///< UAVs
  const Mission& mission() const;
  const UavView& uav(UavIndex i) const;
  std::span<const UavView> uavs() const;
  /// Links with line of sight and in range; dead UAVs have none. Symmetric unless the scenario or a fault limits the
  /// range of links in one direction. The simulation checks the range, because only the server has the true positions;
  /// the router applies all other effects of links on messages.
  const Links& links() const;
  /// links() without those that blackouts, outages and partitions cut. UAVs get their neighbours' odometry and key
  /// frames over open links.
  const Links& open_links() const;
  /// The quality of an open link; nullopt: the link is closed, or the scenario has no path loss.
  std::optional<LinkQuality> link_quality(Node from, Node to) const;
  const StepEvents& events() const;
  const Referee& referee() const;
  const Camera& camera(UavIndex i) const;
  const Scene& scene() const;
  const RayScene& rays() const;  ///< of the scene
  /// Distance from a body's centre to the structure [m], kFarClearance_m at most.
  double clearance(UavIndex uav) const;
  /// links() as they would be if no fault limited their range.
  const Links& unfailed_links() const;
  /// The plan, with what set_off() and set_faults_by_hand() have changed; the faults by hand are at the end.
  const FaultPlan& faults() const;
  /// This step for the digest; radio and tally are the caller's to fill in.
  DigestInput digest_input() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::sim
