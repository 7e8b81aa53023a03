// Writes faults in the format of a fault file: the counterpart of load_fault_plan(), for programs that generate faults.
// Pure.
#pragma once

#include <string>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein {

/// An entry of the list `faults`, with the fault's own times (no ranges); with `when` only while the fault waits.
ConfigNode to_node(const Fault& fault);

/// The same on one line: "{at_s: 14, until_s: 30, station_outage: true}".
std::string fault_line(const Fault& fault);

/// The fault file (`by_hand`) of a run with a viewer: the run's own faults, then those that the viewer added.
/// @param lines  results of fault_line(), in this order
std::string by_hand_text(const std::string& description, const std::vector<std::string>& lines);

/// A tree on one line, in YAML's flow style.
std::string flow_text(const ConfigNode& node);

}  // namespace skein
