// A small world for tests of planners: solid boxes, UAVs that are exactly where they were commanded to be, and key
// frames with all sampled surface points in line of sight within 40 m. Agents that ask for beams also get the scans of
// a LiDAR on its servo (test_lidar.hpp). No physics, no noise: each failure here is the planner's fault.
// Frame W.   Units: SI and radians.   Threads: one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/work_parts.hpp"

namespace skein::agent {

struct TestScene {
  std::vector<OrientedBox> solids;  ///< the structure
  std::vector<OrientedBox> boxes;   ///< boxes that the UAVs receive, from boxes_at_s on
  Vector3d station = {-12.0, -12.0, 0.3};
  double boxes_at_s = 0.0;
  bool radio = true;  ///< false: no links at all
  bool talk = true;   ///< false: UAVs see each other's odometry, but receive no radio messages
};

OrientedBox make_box(const Vector3d& centre, const Vector3d& size, double yaw = 0.0);
/// Two towers in loose boxes, and a podium that is in no box.
TestScene two_towers();
/// Columns in rows of five, each in a box of its own.
TestScene many_boxes(int count);

struct TestUav {
  std::string name;
  Role role = Role::explorer;
  Vector2d start = Vector2d::Zero();
};
/// Radii of the bodies that test worlds give UAVs [m].
constexpr double kExplorerRadiusM = 0.63, kPhotographerRadiusM = 0.32;
/// UAVs in a row, 3 m apart, with alternating roles; the first is an explorer.
std::vector<TestUav> test_fleet(std::size_t count);

class TestWorld {
 public:
  TestWorld(TestScene scene, const std::vector<TestUav>& fleet, const std::string& planner, double duration_s);
  ~TestWorld();

  void run(double seconds_to_run);
  /// Times the parts of the work of all UAVs' on-board software, by this clock. A restarted UAV is no longer timed.
  void time_parts(const WorkParts::Clock& clock);
  /// The times of one UAV. Only after time_parts().
  const WorkParts& parts(std::size_t uav) const;
  /// Restarts the on-board software of one UAV in flight: it has lost all its knowledge.
  void restart(std::size_t uav);

  /// Hash of all UAVs' positions and gimbal yaws in all steps: equal runs have equal fingerprints.
  std::uint64_t fingerprint() const;
  /// Smallest distance of a UAV's centre to a solid, while the UAV was higher than 0.5 m.
  double clearance() const;
  /// Smallest distance between two UAVs' centres, while both were higher than 0.5 m.
  double separation() const;
  /// The same between their bodies (FleetMember::body_radius_m).
  double gap() const;
  /// Share of surface points that a camera has seen from a sharp distance. It counts points in the scene's boxes,
  /// higher than 5 m and not covered by another solid.
  double coverage() const;
  /// Captures of all UAVs that the station has not acknowledged.
  std::size_t undelivered() const;
  /// Commands that were not finite, or beyond the vehicle's limits of speed and acceleration.
  std::size_t bad_commands() const;
  /// Number of scans whose beams an agent could not reconstruct.
  std::uint64_t doubtful_scans() const;
  /// Length of the longest radio message that an agent sent [bytes].
  std::size_t longest_message() const;
  double highest_m(std::size_t uav) const;
  Vector3d position(std::size_t uav) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
