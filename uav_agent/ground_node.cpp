#include "uav_agent/ground_node.hpp"

#include "bus/lockstep/names.hpp"
#include "core/thread_cpu.hpp"
#include "core/topics.hpp"
#include "uav_agent/neighbours.hpp"

namespace skein::agent {

using Counterpart = bus::LockstepClient::Counterpart;

GroundNode::GroundNode(const Scenario& scenario, std::unique_ptr<GroundProgram> program, int base_domain,
                       bus::Bus& bus)
    : bus_(bus),
      domain_(node_domain(base_domain, kStationNode)),
      id_(bus::kGcsName),
      radio_(scenario, kStationNode),
      program_(std::move(program)) {
  join();
}

void GroundNode::join() {
  client_.reset();
  participant_.reset();
  participant_ = bus_.join(domain_);
  client_.emplace(*participant_, inbox_, id_);
  client_->read<msg::PointCloud>(bus::spec(topics::bounding_boxes()), Counterpart::server,
                                 [this](const auto& m) { input_.boxes = from_box_vertices(m); });
  client_->read<msg::Duration>(bus::spec(topics::mission_duration_remained(id_)), Counterpart::server,
                               [this](const auto& m) { input_.mission_remaining_s = from_duration(m); });
  client_->read<msg::PointCloud2>(bus::spec(topics::neighbour_odometry(id_)), Counterpart::server,
                                  [this](const auto& m) { input_.linked = neighbours_of(m); });
  radio_.declare(*client_, input_.radio);
}

void GroundNode::think() {
  const msg::Step& step = client_->step();
  input_.k = step.k();
  input_.tick = step.tick();
  const double before = thread_cpu_s();
  const std::vector<RadioMessage> messages = program_->work(input_);
  planner_cpu_s_ += thread_cpu_s() - before;
  {
    const bus::Burst burst(*participant_);
    radio_.send(*client_, messages);
    client_->done();
  }
  last_step_answered_ = step.final_step();
  input_.radio.clear();
}

int GroundNode::run(const StopSignal& stop) {
  const bus::ClientLoop loop{.think = [this] { think(); }, .answered_last = [this] { return last_step_answered_; }};
  bus::LoopEnd end = bus::run_client(*client_, inbox_, loop, stop);
  while (end == bus::LoopEnd::resumed) {
    join();
    end = bus::run_client(*client_, inbox_, loop, stop);
  }
  return bus::exit_code(end, id_);
}

}  // namespace skein::agent
