// The frames of one UAV for ROS 2's tf, in its own domain, for who looks on there (docs/ros2.md): /tf in each exchange,
// /tf_static once. They tell what the UAV is told of itself, nothing of another UAV and nothing of the truth. Written
// only while a program reads them; in no count of the lock-step, so no program waits for them.
#pragma once

#include <memory>

#include "bus/bus.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class FramesNode {
 public:
  /// @param participant  in the UAV's domain; it and the references must outlive this.
  FramesNode(const UavConfig& uav, UavIndex index, const Simulation& simulation, bus::Participant& participant);

  /// In each step.
  void publish();

 private:
  const UavConfig& uav_;
  const UavIndex index_;
  const Simulation& simulation_;
  std::unique_ptr<bus::Writer> moving_, fixed_;
  bool fixed_written_ = false;
};

}  // namespace skein::sim
