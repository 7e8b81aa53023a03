// The whole simulated world, one exchange at a time: vehicles, sensors, radio links, mission, referee.
// Pure: no middleware, no wall clock. The same scenario, scene, seed and commands give the same bits, whoever helps.
// Threads: one, which may share its work. Frames: W world (ENU), B body (FLU).  Units: SI, radians; times are ticks.
//
// Commands are handed in at a step boundary, between two calls of advance(); what happened in the exchange is in
// events(). LiDARs run from the beginning, cameras while the clock runs, nothing after the mission's end: motors stop
// then. What the seed draws is said in fleet_start.hpp, lidar.hpp and referee.hpp; seed 0 draws nothing.
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
#include "core/scenario.hpp"
#include "core/scene.hpp"
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

/// Clearances beyond this are told as this.
inline constexpr double kFarClearance_m = 100.0;

/// A scan; all its points are of the instant `scan.tick`.
struct LidarEvent {
  UavIndex uav = {};
  LidarScan scan;
};

/// Where a LiDAR's servo stood when a scan was due, computed or not.
struct ServoEvent {
  UavIndex uav = {};
  LidarServo servo;
};

/// A scan that became a key frame. It goes to its own UAV, and once to the UAVs linked to it at this step.
struct KeyFrameEvent {
  UavIndex uav = {};
  KeyFrame key_frame;
  std::vector<UavIndex> neighbours;  ///< UAVs that hear it, in fleet order
};

/// An exposure that saw at least one point.
struct CaptureEvent {
  UavIndex uav = {};
  Capture capture;
  std::optional<Isometry3d> X_told_W = {};  ///< takes what is in W to where the UAV sees it; nullopt: where it is
  std::optional<CaptureReport> report;      ///< what the ledger holds of it: the points not seen as well before
};

/// A command that was ignored.
struct RejectionEvent {
  enum class Command { trajectory, gimbal };
  UavIndex uav = {};
  Command command = Command::trajectory;
  std::string reason;       ///< a sentence for the user
  std::uint64_t total = 0;  ///< of this UAV so far, this one included
};

/// A UAV that left the world, or whose motion no number describes any more: it is out, and its body stays where it was.
struct Stray {
  Tick tick = 0;
  UavIndex uav = {};
  Vector3d p_W = Vector3d::Zero();  ///< where it last was
};

/// What happened since the step before.
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
  /// @param faults  of which sensors, rotors, commands and what neighbours hear of each other are its business.
  /// @throws InputError if a UAV's start or the station lies in the structure or is enclosed by it.
  Simulation(const Scenario& scenario, Scene scene, std::uint64_t seed, const FaultPlan& faults = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// A set-point for a UAV. Of several within one exchange the last acceptable one counts. Refused, and told in
  /// events().rejections, if a number is not finite or, with rules.reject_commands_beyond_limits, if it is
  /// beyond the vehicle's speed, acceleration or yaw rate. Dead UAVs and an ended mission ignore it silently.
  /// @returns false when refused.
  bool command_trajectory(UavIndex uav, const TrajectoryCommand& command);
  /// A gimbal command; refused only if a number is not finite.
  bool command_gimbal(UavIndex uav, const GimbalCommand& command);
  /// Take a picture as soon as the trigger interval allows. From the first call on, this camera no longer triggers
  /// by itself.
  void trigger_camera(UavIndex uav);
  /// Cut the motors, for good: the UAV falls.
  void stop(UavIndex uav);

  /// A fault that waited begins with the exchange at this tick, which is the next one.
  void set_off(std::size_t fault, Tick tick);
  /// Somebody who watches adds faults, which stand behind those of the plan.
  /// @param faults  all of them; what they were in exchanges that are over stays as it was.
  void set_faults_by_hand(const std::vector<Fault>& faults);

  /// Whether anybody reads this UAV's scans (they do, until told otherwise). Those that nobody reads and that would
  /// not become key frames are not computed: the LiDAR is the most expensive sensor. Nothing else depends on it.
  void want_scans(UavIndex uav, bool wanted);
  /// What does not depend on one another is done so from now on: scans, exposures, links, and forces of a large fleet.
  void share_work(ForEach for_each);
  /// Announces work to a clock from now on. @param clock  must outlive the simulation; null: nobody.
  void watch(WorkClock* clock);

  /// One exchange period; afterwards all getters speak of the new step.
  void advance();

  std::uint64_t step() const;  ///< exchanges so far
  Tick tick() const;
  std::size_t size() const;  ///< UAVs
  const Mission& mission() const;
  const UavView& uav(UavIndex i) const;
  std::span<const UavView> uavs() const;
  /// Line of sight and range; the dead have no links. Symmetric unless the scenario limits the range of some links.
  /// Range is judged here, with the positions that only the server has; what else links do to messages, in the router.
  const Links& links() const;
  /// links() less those that blackouts, outages and partitions cut: who gets whose odometry and key frames.
  const Links& open_links() const;
  const StepEvents& events() const;
  const Referee& referee() const;
  /// By interest point: whether it was ever in a picture and in sight, whatever its quality.
  std::vector<bool> points_seen() const;
  const Scene& scene() const;
  const RayScene& rays() const;  ///< of the scene
  /// Distance from a body's centre to the structure, kFarClearance_m at most.
  double clearance(UavIndex uav) const;
  /// What links() would be if no fault limited their range.
  const Links& unfailed_links() const;
  /// Those that wait for a condition begin by set_off(); those by hand stand at the end.
  const FaultPlan& faults() const;
  /// This step for the digest; radio and tally are the caller's to fill in.
  DigestInput digest_input() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::sim
