// Orders by which a browser injects a fault, which begins with the next step, or ends such a fault. sim_server decides
// whether an order makes sense in its run (sim_server/hand_faults.hpp).
// Times are simulated, in seconds.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/faults/fault_plan.hpp"

namespace skein::view {

struct FaultOrder {
  std::optional<FaultAction> begins = {};  ///< the fault that begins; none: the order ends the fault `ended`
  std::optional<double> for_s = {};        ///< duration of the fault that begins; none: until an order ends it
  std::uint64_t ended = 0;                 ///< number of the fault, as the page knows it (ToldFault::number)
};

/// Kinds and targets are those of a fault file; names are not checked yet: {"do": "fault", "kind": "kill", "of":
/// "changi"}, {"do": "fault", "kind": "link", "from": "changi", "to": "gcs", "for_s": 5}, {"do": "fault", "kind":
/// "motor_failure", "of": "changi", "rotor": 2, "thrust": 0.5}, {"do": "fault", "kind": "command_delay",
/// "of": "changi", "exchanges": 4}, {"do": "fault", "kind": "station_outage"}; {"do": "end_fault", "fault": 3}.
std::string text_of(const FaultOrder& order);
/// @returns nullopt unless the text is exactly such an order: known keys only, and all numbers within their bounds.
std::optional<FaultOrder> read_fault_order(std::string_view text);

/// The fault that cuts the radio link between two nodes in this direction, as in a fault file: a range of 1 mm.
LinkEffect no_link(const std::string& from, const std::string& to);

}  // namespace skein::view
