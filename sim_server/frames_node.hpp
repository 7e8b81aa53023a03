// Publishes the frames of one UAV for ROS 2's tf in the UAV's own domain, for viewers there (docs/ros2.md): /tf in each
// exchange, /tf_static once. The poses are those that the UAV is told, not the true ones, and none of other UAVs. The
// server writes only while a program reads them. The lock-step does not count them, so no program waits for them.
// Threads: one.
#pragma once

#include <memory>

#include "bus/bus.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class FramesNode {
 public:
  /// @param participant  in the UAV's domain; it and the references must outlive this.
  FramesNode(const UavConfig& uav, UavIndex index, const Simulation& simulation, bus::Participant& participant);

  /// Call it once per step.
  void publish();

 private:
  const UavConfig& uav_;
  const UavIndex index_;
  const Simulation& simulation_;
  std::unique_ptr<bus::Writer> moving_, fixed_;
  bool fixed_written_ = false;
};

}  // namespace skein::sim
