// For the tests of the dynamics: one UAV over open ground, controllers and motors and rigid body together, without
// sensors or mission. Frame W.   Units: SI.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/scenario/scenario_reader.hpp"
#include "sim_server/flight/physics_world.hpp"
#include "sim_server/flight/vehicle.hpp"
#include "tests/support/places.hpp"

namespace skein::sim::test {

inline VehicleConfig vehicle_named(const std::string& name) { return load_vehicle(name, source_path("config")); }

/// Rules with which the CommandGuard does nothing: commands reach the control law as they are.
inline RulesConfig no_limits() {
  RulesConfig rules;
  rules.reject_commands_beyond_limits = rules.guard_position_commands = false;
  return rules;
}

class Flight {
 public:
  /// @param steps  of the physics per tick; controllers keep their own rates.
  explicit Flight(const VehicleConfig& config, double height = 50.0, const RulesConfig& rules = {}, int steps = 1)
      : config_(config), steps_(steps), world_({}, kTickS / steps), vehicle_(config, rules, kTickS / steps) {
    world_.add_uav(config, Isometry3d(Eigen::Translation3d(0.0, 0.0, height)));
  }

  using Pilot = std::function<std::optional<TrajectoryCommand>(double t)>;
  using Watch = std::function<void()>;
  /// Flies on for a time. Calls `pilot` at every control step, and `watch` after every step of the physics.
  void fly(
      double duration_s, const Pilot& pilot, const Watch& watch = [] {}) {
    for (const Tick end = tick_ + ticks(duration_s); tick_ < end; ++tick_) {
      if (tick_ % kControlTicks == 0) vehicle_.control(tick_, state(), pilot(seconds(tick_)), std::nullopt);
      vehicle_.control_attitude(state());
      for (int step = 0; step < steps_; ++step) {
        before_ = state();
        wrench_ = vehicle_.fly(before_);
        world_.apply_wrench(UavIndex{0}, before_.q_WB * wrench_.force_B, before_.q_WB * wrench_.torque_B);
        world_.tick();
        watch();
      }
    }
  }

  const RigidBodyState& state() const { return world_.state(UavIndex{0}); }
  /// State at the beginning of the last step, and the rotors' wrench on the body in that step.
  const RigidBodyState& before() const { return before_; }
  const Wrench& wrench() const { return wrench_; }
  double step_s() const { return kTickS / steps_; }
  double time_s() const { return seconds(tick_); }
  Vehicle& vehicle() { return vehicle_; }
  PhysicsWorld& world() { return world_; }
  double thrust() const {
    double sum = 0.0;
    for (const double speed : vehicle_.rotor_speeds()) sum += config_.rotor_force_constant * speed * speed;
    return sum;
  }

 private:
  VehicleConfig config_;
  int steps_;
  PhysicsWorld world_;
  Vehicle vehicle_;
  Tick tick_ = 0;
  RigidBodyState before_;
  Wrench wrench_;
};

inline Flight::Pilot hover_at(const Vector3d& p_WB, double yaw = 0.0) {
  return [=](double) { return TrajectoryCommand{.p_WB = p_WB, .yaw = yaw}; };
}
inline std::optional<TrajectoryCommand> silent(double) { return std::nullopt; }

}  // namespace skein::sim::test
