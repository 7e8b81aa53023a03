// Rigid bodies, gravity and contacts (Bullet, double precision, one thread): the same calls give the same bits.
// Frames: W world (ENU), B body (FLU).  Units: SI.  States and wrenches are about Bo, the origin of the body frame;
// this class accounts for a centre of mass elsewhere (core/vehicle/airframe.hpp).  A tick is kTickS = 2.5 ms and,
// unless a test sets another step, one step of the integration.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "core/types.hpp"
#include "sim_server/flight/contacts.hpp"

namespace skein::sim {

inline constexpr double kWorldGravity = 9.8;  ///< [m/s^2]

/// Ground plane z = 0, one static mesh, and the fleet. Not thread-safe.
class PhysicsWorld {
 public:
  /// @param mesh  double-sided, in W; must outlive the world. Triangles within 1 cm of z = 0 count as ground.
  /// @param step_s  integration step of tick(), to study its effect on results; usually kTickS.
  explicit PhysicsWorld(const TriangleMesh& mesh, double step_s = kTickS);
  ~PhysicsWorld();
  PhysicsWorld(const PhysicsWorld&) = delete;
  PhysicsWorld& operator=(const PhysicsWorld&) = delete;

  /// Adds a UAV at rest; UAVs are numbered 0, 1, ... in the order of these calls.
  void add_uav(const VehicleConfig& vehicle, const Isometry3d& X_WB);

  /// Whether a vehicle at this pose would touch the structure. Does not change the world.
  bool touches_structure(const VehicleConfig& vehicle, const Isometry3d& X_WB) const;

  /// Applies a force at Bo and a torque to a UAV during the next tick, both expressed in W. Calls add up.
  void apply_wrench(UavIndex uav, const Vector3d& force_W, const Vector3d& torque_W);

  /// Simulates one tick with gravity and with the wrenches applied since the last tick.
  void tick();

  const RigidBodyState& state(UavIndex uav) const { return states_[uav]; }
  const std::vector<RigidBodyState>& states() const { return states_; }
  /// Sets the radius of the world about the origin. tick() removes bodies that leave it. Without this call, tick()
  /// removes only bodies whose motion is no longer finite, which happens when the integration diverges. A removed body
  /// stays at its last pose, at rest, and touches nothing.
  void keep_within(double radius_m) { reach_m_ = radius_m; }
  /// UAVs that the last tick has removed, ascending.
  const std::vector<UavIndex>& strays() const { return strays_; }
  /// Contacts of the last tick, one per pair, sorted by UAV, then by ground, structure and other UAVs. A UAV that has
  /// been at rest without thrust for half a second sleeps until it is pushed or hit; meanwhile it keeps its contacts.
  const std::vector<Contact>& contacts() const { return contacts_; }

  /// Sets pose and velocity of a UAV. For tests and set-up.
  void set_state(UavIndex uav, const RigidBodyState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool sane(const RigidBodyState& state) const;
  void take_out(UavIndex uav);

  std::vector<RigidBodyState> states_;
  std::vector<Contact> contacts_;
  std::vector<UavIndex> strays_;
  double reach_m_ = std::numeric_limits<double>::max();
};

}  // namespace skein::sim
