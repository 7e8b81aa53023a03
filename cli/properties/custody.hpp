// The fate of capture reports, derived anew from what the server saw: its ledger, its links, who took part when. The
// signal `custody_differences` compares the station's own account with it. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "core/faults/fault_plan.hpp"
#include "results/run_record.hpp"

namespace skein::cli {

/// UAV and number of the capture.
using CaptureKey = std::pair<std::string, std::uint64_t>;

/// In which step each capture of the ledger reaches the station; those that never do are left out. This is the rule
/// of Skein's own on-board software (uav_agent/onboard/uplink.hpp): from the step on in which the camera handed a
/// report out, it is sent while there is a direct link to the station, again ten steps later as long as it is not
/// acknowledged; what is sent in one step arrives in the next. It needs the router in the step of sending and, for its
/// word of it, in that of arrival, the station in the step of arrival and the one before, and a link that does not lose
/// it. Who is killed forgets; its camera hands out again what was not acknowledged when it is back. Who is paused
/// remembers.
std::map<CaptureKey, std::uint64_t> derived_deliveries(const results::RunRecord& run, const Scenario& scenario,
                                                       const FaultPlan& plan);

}  // namespace skein::cli
