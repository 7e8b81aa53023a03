// A small world for tests of planners: solid boxes, UAVs that are exactly where they were told to be, and a
// LiDAR that sees all surface points in line of sight. Who asks for beams gets those of a LiDAR on its servo, too
// (test_lidar.hpp). No physics, no noise: what goes wrong here is the planner's fault.
// Frame W.   Units: SI and radians.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

struct TestScene {
  std::vector<OrientedBox> solids;  ///< what really stands there
  std::vector<OrientedBox> boxes;   ///< what the UAVs are told, at boxes_at_s
  Vector3d station = {-12.0, -12.0, 0.3};
  double boxes_at_s = 0.0;
  bool radio = true;  ///< false: nobody ever sees anybody
  bool talk = true;   ///< false: they see each other, but no planner hears another
};

OrientedBox make_box(const Vector3d& centre, const Vector3d& size, double yaw = 0.0);
/// Two towers in loose boxes, and a podium that is in no box.
TestScene two_towers();

struct TestUav {
  std::string name;
  Role role = Role::explorer;
  Vector2d start = Vector2d::Zero();
};
/// Alternating roles, in a row, 3 m apart.
std::vector<TestUav> test_fleet(std::size_t count);

class TestWorld {
 public:
  TestWorld(TestScene scene, const std::vector<TestUav>& fleet, const std::string& planner, double duration_s);
  ~TestWorld();

  void run(double seconds_to_run);
  /// The on-board software of one UAV begins anew, in flight, and knows nothing.
  void restart(std::size_t uav);

  /// Everything that the agents said, as one number: equal runs have equal ones.
  std::uint64_t fingerprint() const;
  /// Smallest distance of a UAV's centre to a solid, while it was above half a metre.
  double clearance() const;
  /// Smallest distance between two UAVs' centres, both off the ground.
  double separation() const;
  /// The same between their bodies (FleetMember::body_radius_m).
  double gap() const;
  /// Share of the solids' surface points outside the ground and other solids that a camera saw from a sharp
  /// distance.
  double coverage() const;
  std::size_t undelivered() const;
  /// Commands that were not finite, or beyond the vehicle's limits of speed and acceleration.
  std::size_t bad_commands() const;
  /// Scans whose beams an agent asked for and could not tell.
  std::uint64_t doubtful_scans() const;
  /// The longest text that a planner sent.
  std::size_t longest_message() const;
  double highest_m(std::size_t uav) const;
  Vector3d position(std::size_t uav) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
