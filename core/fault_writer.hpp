// Faults as a fault file spells them: the counterpart of load_fault_plan(), for programs that make up faults. Pure.
#pragma once

#include <string>

#include "core/config_node.hpp"
#include "core/fault_plan.hpp"

namespace skein {

/// An entry of `faults`. Times are as they are in the fault; one that waits is written as waiting.
ConfigNode to_node(const Fault& fault);

/// The same on one line: "{at_s: 14, until_s: 30, station_outage: true}".
std::string fault_line(const Fault& fault);

/// A tree on one line, as YAML's flow style has it.
std::string flow_text(const ConfigNode& node);

}  // namespace skein
