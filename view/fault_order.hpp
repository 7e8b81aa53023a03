// What a browser may ask of a run's faults: one that begins with the next step, or the end of one that began so.
// Whether that makes sense in this run, sim_server says (sim_server/hand_faults.hpp).
// Times are simulated, in seconds.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/faults/fault_plan.hpp"

namespace skein::view {

struct FaultOrder {
  std::optional<FaultAction> begins = {};  ///< none: `ended` is over
  std::optional<double> for_s = {};        ///< how long that lasts; none: until somebody ends it
  std::uint64_t ended = 0;                 ///< the number by which the page was told of it
};

/// Kinds and targets as in a fault file, whose names are not looked at yet: {"do": "fault", "kind": "kill", "of":
/// "changi"}, {"do": "fault", "kind": "link", "from": "changi", "to": "gcs", "for_s": 5}, {"do": "fault", "kind":
/// "motor_failure", "of": "changi", "rotor": 2, "thrust": 0.5}, {"do": "fault", "kind": "command_delay",
/// "of": "changi", "exchanges": 4}, {"do": "fault", "kind": "station_outage"}; {"do": "end_fault", "fault": 3}.
std::string text_of(const FaultOrder& order);
/// @returns nullopt when the text is none of these, word for word in its keys; numbers must be within their bounds.
std::optional<FaultOrder> read_fault_order(std::string_view text);

/// No radio link between two nodes in this direction, as a fault file says it: its range is less than any distance.
LinkEffect no_link(const std::string& from, const std::string& to);

}  // namespace skein::view
