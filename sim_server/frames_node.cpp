#include "sim_server/frames_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "sim_server/viz/frames.hpp"

namespace skein::sim {

FramesNode::FramesNode(const UavConfig& uav, UavIndex index, const Simulation& simulation,
                       bus::Participant& participant)
    : uav_(uav),
      index_(index),
      simulation_(simulation),
      moving_(participant.create_writer(bus::spec(topics::wire(topics::kTf)))),
      fixed_(participant.create_writer(bus::spec(topics::wire(topics::kTfStatic)))) {}

void FramesNode::publish() {
  if (!fixed_written_ && fixed_->has_readers()) {
    fixed_->write(encode(viz::own_fixed_frames(uav_)));
    fixed_written_ = true;
  }
  if (!moving_->has_readers()) return;
  moving_->write(encode(viz::own_moving_frames(simulation_.tick(), uav_, simulation_.uav(index_))));
  for (const ServoEvent& event : simulation_.events().servos) {
    if (event.uav == index_) moving_->write(encode(viz::own_lidar_frame(uav_, event.servo)));
  }
}

}  // namespace skein::sim
