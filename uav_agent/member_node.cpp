#include "uav_agent/member_node.hpp"

#include "core/types.hpp"
#include "process/host/thread_cpu.hpp"
#include "process/log_time.hpp"

namespace skein::agent {

// A program that a fault has stopped joins the network again as a new participant, and keeps its state.
void MemberNode::start() {
  client_.reset();
  participant_.reset();
  participant_ = bus_.join(domain_);
  client_.emplace(*participant_, inbox_, member_);
  declare(*client_);
  ClientNode::start();
}

void MemberNode::think() {
  set_log_time(static_cast<double>(client_->step().tick()) / static_cast<double>(kTicksPerSecond));
  const double before = thread_cpu_s();
  work(client_->step());
  planner_cpu_.add(thread_cpu_s() - before);
  {
    const bus::Burst burst(*participant_);
    send(*client_);
    client_->done();
  }
  show();
  last_step_answered_ = client_->step().final_step();
}

}  // namespace skein::agent
