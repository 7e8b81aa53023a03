// Everything in the simulation that belongs to one UAV.
#pragma once

#include <optional>

#include "sim_server/conditions/surroundings.hpp"
#include "sim_server/flight/command_link.hpp"
#include "sim_server/flight/vehicle.hpp"
#include "sim_server/flight/vehicle_faults.hpp"
#include "sim_server/simulation.hpp"

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
  VehicleCondition condition;                   ///< in this exchange
  bool manual_trigger = false, triggered = false;
  std::optional<Tick> shutter_at = {};  ///< a picture that was triggered is taken then
  bool scans_wanted = true;
  Tick last_raise = 0, idle_ticks = 0;  ///< when a capture last raised a score; how long it has idled

  /// Whether a picture is taken at this tick: triggered now, or so much earlier.
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

/// Moves a scan to where the UAV sees it.
inline void place(LidarScan& scan, const Isometry3d& X_told_W) {
  scan.X_WL = X_told_W * scan.X_WL;
  for (Eigen::Vector3f& p_W : scan.points_W) p_W = (X_told_W * p_W.cast<double>()).cast<float>();
}

}  // namespace skein::sim
