// Everything in the simulation that belongs to one UAV.
// Frames: W world, B body, L LiDAR, `told`: W displaced by the error of the UAV's odometry.   Units: SI, ticks.
// Threads: one at a time for each UAV.
#pragma once

#include <optional>
#include <utility>

#include "sight/camera.hpp"
#include "sim_server/conditions/surroundings.hpp"
#include "sim_server/flight/command_link.hpp"
#include "sim_server/flight/vehicle.hpp"
#include "sim_server/flight/vehicle_faults.hpp"
#include "sim_server/sensors/key_frames.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "sim_server/uav_view.hpp"

namespace skein::sim {

struct SimulatedUav {
  Vehicle vehicle;
  CommandLink link;
  Camera camera;
  Surroundings surroundings;
  std::optional<Lidar> lidar;
  KeyFrameSelector keyframes;
  UavView view;
  std::optional<GimbalCommand> gimbal_command;  ///< arrived since the last control step
  VehicleCondition condition;                   ///< effects of faults in this exchange
  bool manual_trigger = false, triggered = false;
  std::optional<Tick> shutter_at = {};  ///< when the picture that was triggered is taken
  bool scans_wanted = true;
  Tick last_raise = 0, idle_ticks = 0;  ///< last capture that raised a score, or mission start; time idle

  /// Pose of the body according to the UAV's odometry. @param truth  the true state.
  Isometry3d X_told_B(const RigidBodyState& truth) const {
    const auto X_told_W = surroundings.X_told_W(truth);
    return X_told_W ? *X_told_W * truth.X_WB() : truth.X_WB();
  }

  /// Applies the effects of faults in the exchange that begins.
  void suffer(const VehicleCondition& faulty) {
    condition = faulty;
    vehicle.damage_rotors(faulty.rotor_shares);
    vehicle.jam_gimbal(!faulty.gimbal_works);
    surroundings.suffer(faulty.fix_lost, faulty.most_charge, faulty.charge_lost);
    if (faulty.camera_works) return;
    triggered = false;
    shutter_at.reset();
  }

  /// @param conditions  of the ticks that follow.
  void change_conditions(const ConditionsConfig& conditions) {
    surroundings.change(conditions);
    camera.change_conditions(conditions.camera);
    if (lidar) lidar->change_conditions(conditions.lidar);
  }

  /// One tick: runs the 20 Hz controllers if they are due, then the attitude loop and the rotors in the present wind.
  /// @param listens  whether the UAV takes commands; if not, the 20 Hz controllers do not run.
  /// @returns the wrench on the body, in B.
  Wrench fly(Tick tick, const RigidBodyState& truth, bool listens) {
    surroundings.begin_tick(tick, truth, condition.gust_W);
    if (tick % kControlTicks == 0 && listens) {
      const auto gimbal = std::exchange(gimbal_command, std::nullopt);
      vehicle.control(tick, surroundings.believed(truth), link.take_trajectory(tick), gimbal);
    }
    return surroundings.fly(vehicle, truth);
  }

  /// Whether a picture is taken at this tick. @param delay  from the trigger to the picture [ticks].
  bool shutter_opens(Tick tick, Tick delay) {
    const bool wanted = (!manual_trigger || triggered) && camera.ready(tick);
    if (!shutter_at && wanted) {
      triggered = false;
      shutter_at = tick + delay;
    }
    if (!shutter_at || tick < *shutter_at) return false;
    shutter_at.reset();
    return true;
  }
};

/// Transforms a scan from W to the frame `told`: its points lie where the UAV's odometry makes them appear.
inline void place(LidarScan& scan, const Isometry3d& X_told_W) {
  scan.X_WL = X_told_W * scan.X_WL;
  for (Eigen::Vector3f& p_W : scan.points_W) p_W = (X_told_W * p_W.cast<double>()).cast<float>();
}

}  // namespace skein::sim
