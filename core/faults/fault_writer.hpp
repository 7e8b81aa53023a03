// Faults as a fault file spells them: the counterpart of load_fault_plan(), for programs that make up faults. Pure.
#pragma once

#include <string>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// An entry of `faults`. Times are as they are in the fault; one that waits is written as waiting.
ConfigNode to_node(const Fault& fault);

/// The same on one line: "{at_s: 14, until_s: 30, station_outage: true}".
std::string fault_line(const Fault& fault);

/// A fault file of a run that is flown (`by_hand`): its own faults, and those that somebody has added meanwhile.
/// @param lines  of fault_line(), in their order
std::string by_hand_text(const std::string& description, const std::vector<std::string>& lines);

/// A tree on one line, as YAML's flow style has it.
std::string flow_text(const ConfigNode& node);

}  // namespace skein
