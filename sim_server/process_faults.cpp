#include "sim_server/process_faults.hpp"

#include <variant>

namespace skein::sim {

ProcessFaults::ProcessFaults(const FaultPlan& plan) {
  for (const Fault& fault : plan.faults) {
    const bool of_process = std::holds_alternative<Kill>(fault.action) || std::holds_alternative<Pause>(fault.action);
    if (of_process) entries_.push_back({fault});
  }
}

std::vector<ProcessFaults::Victim> ProcessFaults::take_beginning(Tick tick) { return take(tick, true); }
std::vector<ProcessFaults::Victim> ProcessFaults::take_ending(Tick tick) { return take(tick, false); }

std::vector<ProcessFaults::Victim> ProcessFaults::take(Tick tick, bool beginning) {
  std::vector<Victim> victims;
  for (auto& [fault, acting] : entries_) {
    if (acting == beginning || fault.active(tick) != beginning) continue;
    acting = beginning;
    victims.push_back({fault_target(fault), std::holds_alternative<Kill>(fault.action), fault_kind(fault)});
  }
  return victims;
}

}  // namespace skein::sim
