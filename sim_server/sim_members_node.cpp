// SimNode: members that are lost, and participants that send commands without being members.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "sim_server/sim_node.hpp"

namespace skein::sim {

void SimNode::take_losses() {
  for (const auto& lost : server_.take_lost()) {
    spdlog::warn("{} is lost at step {}: {}; the run goes on without it", lost.name, lost.k, lost.reason);
    summary_.lost.push_back({lost.name, lost.k, simulation_.tick(), lost.reason});
    summary_.warnings.push_back(lost.name + " was lost: " + lost.reason);
    summary_.deterministic = false;
  }
}

/// Call it after take_losses(). @param step  the first step in which the members that have joined again take part.
void SimNode::take_returns(std::uint64_t step) {
  for (const std::string& name : server_.take_rejoined()) {
    spdlog::info("{} joined again at step {}", name, step);
    status_.send_surely(status::line_json(status::Rejoined{name}));
    for (LostProcess& lost : summary_.lost) {
      if (lost.name == name && !lost.back) lost.back = simulation_.tick();
    }
    const auto uav = std::find(uav_names_.begin(), uav_names_.end(), name);
    if (uav == uav_names_.end()) continue;
    const UavIndex i{static_cast<std::size_t>(uav - uav_names_.begin())};
    uavs_[i]->resend_captures();
    hand_.resend(i);
  }
}

// Whether a stand-in relays the UAV's commands. It relays all of them while it is a member, and at its start also those
// that were sent before the first step.
bool SimNode::has_stand_in(const std::string& uav) const {
  const bool named = std::ranges::find(options_.stand_ins, uav) != options_.stand_ins.end();
  return named && (simulation_.step() == 0 || server_.is_member(uav));
}

// Warns of commands from outside the lock-step. They have no effect, although their sender sees a matched subscriber.
void SimNode::tell_of_strangers(std::uint64_t patience) {
  const auto is_stranger = [this](bus::ParticipantId source) { return server_.is_stranger(source); };
  for (const bus::Strangers::Notice& notice : strangers_.take_notices(simulation_.step(), patience, is_stranger)) {
    const std::string text = describe(notice);
    spdlog::warn("{}", text);
    status_.send_surely(status::line_json(status::Warning{text}));
    summary_.warnings.push_back(text);
    const auto uav = std::find(uav_names_.begin(), uav_names_.end(), notice.node);
    uavs_[static_cast<std::size_t>(uav - uav_names_.begin())]->reject_unheard(notice.topic);
  }
}

}  // namespace skein::sim
