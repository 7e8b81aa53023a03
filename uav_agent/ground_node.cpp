#include "uav_agent/ground_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "uav_agent/neighbours.hpp"

namespace skein::agent {

using Counterpart = bus::LockstepClient::Counterpart;

GroundNode::GroundNode(const Scenario& scenario, std::unique_ptr<GroundProgram> program, int base_domain, bus::Bus& bus)
    : MemberNode(bus, node_domain(base_domain, kStationNode), std::string(bus::kGcsName)),
      radio_(scenario, kStationNode),
      program_(std::move(program)) {}

void GroundNode::declare(bus::LockstepClient& client) {
  client.read<msg::PointCloud>(bus::spec(topics::bounding_boxes()), Counterpart::server,
                               [this](const auto& m) { input_.boxes = from_box_vertices(m); });
  client.read<msg::Duration>(bus::spec(topics::mission_duration_remained(member())), Counterpart::server,
                             [this](const auto& m) { input_.mission_remaining_s = from_duration(m); });
  client.read<msg::PointCloud2>(bus::spec(topics::neighbour_odometry(member())), Counterpart::server,
                                [this](const auto& m) { input_.linked = neighbours_of(m); });
  radio_.declare(client, input_.radio);
}

void GroundNode::work(const msg::Step& step) {
  input_.k = step.k();
  input_.tick = step.tick();
  output_ = program_->work(input_);
}

void GroundNode::send(bus::LockstepClient& client) {
  radio_.send(client, output_);
  input_.radio.clear();
}

}  // namespace skein::agent
