// The mission's clock and who is still in it: take-off, flight, landing, collision, end.
// Units: ticks; positions in W.  Rules: planners' notes on the reference, docs/rules.md.
#pragma once

#include <optional>
#include <vector>

#include "core/run/run_state.hpp"
#include "core/scenario.hpp"
#include "core/types.hpp"
#include "sim_server/flight/physics_world.hpp"

namespace skein::sim {

/// Why a mission ended.
enum class MissionEnd { none, duration, nobody_flies, takeoff_timeout };

/// A UAV hit something while airborne, and is out. A collision of two UAVs is two of these.
struct Collision {
  Tick tick = 0;
  UavIndex uav = {};
  BodyId with;                      ///< the structure or another UAV
  Vector3d p_W = Vector3d::Zero();  ///< where they touched
  bool battery_empty = false;       ///< it fell: that is why
};

/// Watches the fleet tick by tick. Not thread-safe.
///
/// A UAV is airborne once it is `takeoff_height_m` above its rest height and faster than `takeoff_speed_mps`, and
/// grounded again once it is slow and either low or on the ground. The clock starts when the first UAV becomes
/// airborne. An airborne UAV that touches anything but the ground dies (one without power: the ground, too), each of
/// two UAVs by its own state (with `rules.collision_kills_both` the one that one touches dies with it, though it
/// rests). The mission ends when the time is up, when every UAV is dead or has landed after a flight, or when nobody
/// took off in time.
class Mission {
 public:
  /// @param rest_heights  z of each UAV's centre at rest on the ground, in fleet order [m].
  Mission(const Scenario& scenario, std::vector<double> rest_heights);

  /// Take in the state after a tick: the clock, who flies, who collided.
  /// @param states  of all UAVs in fleet order.    @param contacts  of this tick.
  /// @returns the collisions of this tick; those who collided are dead from here on.
  std::vector<Collision> update(Tick tick, const std::vector<RigidBodyState>& states,
                                const std::vector<Contact>& contacts);

  /// A UAV that is no longer of this world: dead from here on, without a collision.
  void take_out(UavIndex uav) { uavs_[uav].alive = uavs_[uav].airborne = false; }

  /// Its battery is empty: if it is in the air it falls, and then the ground kills it, too.
  void lose_power(UavIndex uav) { uavs_[uav].falls = uavs_[uav].airborne; }

  Phase phase() const { return phase_; }
  MissionEnd end() const { return end_; }
  /// First take-off; nullopt while waiting and after a run without one.
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
    bool falls = false;  ///< without power
  };

  void update_airborne(Tick tick, const std::vector<RigidBodyState>& states, const std::vector<Contact>& contacts);
  std::vector<Collision> find_collisions(Tick tick, const std::vector<Contact>& contacts);
  void update_phase(Tick tick);
  void finish(Tick tick, MissionEnd why);

  Tick duration_, takeoff_timeout_;
  double takeoff_height_, takeoff_speed_;
  bool collision_kills_both_;
  std::vector<Member> uavs_;
  Phase phase_ = Phase::waiting;
  MissionEnd end_ = MissionEnd::none;
  std::optional<Tick> start_tick_, end_tick_;
};

}  // namespace skein::sim
