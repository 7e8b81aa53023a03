#include "sim_server/process_faults.hpp"

#include <variant>

namespace skein::sim {

std::vector<ProcessFaults::Victim> ProcessFaults::take_beginning(Tick tick) { return take(tick, true); }
std::vector<ProcessFaults::Victim> ProcessFaults::take_ending(Tick tick) { return take(tick, false); }

std::vector<ProcessFaults::Victim> ProcessFaults::take(Tick tick, bool beginning) {
  std::vector<Victim> victims;
  acting_.resize(plan_.faults.size());
  for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
    const Fault& fault = plan_.faults[i];
    const bool of_process = std::holds_alternative<Kill>(fault.action) || std::holds_alternative<Pause>(fault.action);
    if (!of_process || acting_[i] == beginning || fault.active(tick) != beginning) continue;
    acting_[i] = beginning;
    victims.push_back({fault_target(fault), std::holds_alternative<Kill>(fault.action), fault_kind(fault)});
  }
  return victims;
}

}  // namespace skein::sim
