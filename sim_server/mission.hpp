// The mission's clock, and which UAVs still take part: takeoff, flight, landing, collision, end.
// Units: SI, ticks; positions in W.  Rules: docs/rules.md.
#pragma once

#include <optional>
#include <vector>

#include "core/run/run_state.hpp"
#include "core/scenario/scenario.hpp"
#include "core/types.hpp"
#include "sim_server/flight/physics_world.hpp"

namespace skein::sim {

/// The reason why a mission ended.
enum class MissionEnd { none, duration, no_uav_flies, takeoff_timeout };

/// The death of one UAV by collision. If two UAVs die in one collision, there are two of these.
struct Collision {
  Tick tick = 0;
  UavIndex uav = {};
  BodyId with;                      ///< structure or another UAV; for a UAV that falls without power also the ground
  Vector3d p_W = Vector3d::Zero();  ///< point of contact [m]
  bool battery_empty = false;       ///< the cause: the UAV fell because its battery was empty
};

/// Watches the fleet tick by tick. Not thread-safe.
///
/// A UAV becomes airborne when it is more than `takeoff_height_m` above its rest height and faster than
/// `takeoff_speed_mps`. It is grounded again when it is slower and either lower or in contact with the ground. The
/// clock starts when the first UAV becomes airborne.
/// An airborne UAV dies when it touches structure or a UAV; if it falls without power, also when it touches the ground.
/// When two UAVs touch, a grounded one survives, unless `rules.collision_kills_both` is on and the other is airborne.
/// The mission ends when the time is up, when every UAV is dead or has landed after a flight, or when no UAV took off
/// in time. Where batteries are swapped, a UAV that has landed may fly again.
class Mission {
 public:
  /// @param rest_heights  z of each UAV's centre at rest on the ground, in fleet order [m].
  Mission(const Scenario& scenario, std::vector<double> rest_heights);

  /// Takes in the state after a tick: updates the clock, which UAVs are airborne, and which have collided.
  /// @param states  of all UAVs in fleet order.    @param contacts  of this tick.
  /// @returns the collisions of this tick; these UAVs are dead from now on. Empty once the mission has ended.
  std::vector<Collision> update(Tick tick, const std::vector<RigidBodyState>& states,
                                const std::vector<Contact>& contacts);

  /// The UAV has left the world: it is dead from now on, without a collision.
  void take_out(UavIndex uav) { uavs_[uav].alive = uavs_[uav].airborne = false; }

  /// The UAV's battery is empty: if it is airborne, it falls, and then contact with the ground kills it, too.
  void lose_power(UavIndex uav) { uavs_[uav].falls = uavs_[uav].airborne; }

  Phase phase() const { return phase_; }
  MissionEnd end() const { return end_; }
  /// First takeoff; nullopt while waiting and after a run without one.
  std::optional<Tick> start_tick() const { return start_tick_; }
  /// When the mission ended.
  std::optional<Tick> end_tick() const { return end_tick_; }
  /// Mission time left at a tick [s]: all of it while waiting, none after the end.
  double remaining_s(Tick tick) const;

  bool alive(UavIndex uav) const { return uavs_[uav].alive; }
  bool airborne(UavIndex uav) const { return uavs_[uav].airborne; }

 private:
  struct Member {
    double rest_height = 0.0;
    bool alive = true, airborne = false, has_flown = false;
    bool falls = false;  ///< airborne without power
  };

  void update_airborne(Tick tick, const std::vector<RigidBodyState>& states, const std::vector<Contact>& contacts);
  std::vector<Collision> find_collisions(Tick tick, const std::vector<Contact>& contacts);
  void update_phase(Tick tick);
  void finish(Tick tick, MissionEnd why);

  Tick duration_, takeoff_timeout_;
  double takeoff_height_, takeoff_speed_;
  bool collision_kills_both_, batteries_are_swapped_;
  std::vector<Member> uavs_;
  Phase phase_ = Phase::waiting;
  MissionEnd end_ = MissionEnd::none;
  std::optional<Tick> start_tick_, end_tick_;
};

}  // namespace skein::sim
