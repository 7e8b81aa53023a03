// Derives when each capture report reaches the station, only from what the server recorded: ledger, links, members. The
// signal `custody_differences` compares the station's own account with this. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "core/faults/fault_plan.hpp"
#include "results/run_record.hpp"

namespace skein::signals {

/// UAV and number of the capture.
using CaptureKey = std::pair<std::string, std::uint64_t>;

/// The step in which each capture of the ledger reaches the station; captures that never reach it are left out. Skein's
/// own on-board software (uav_agent/onboard/uplink.hpp) delivers by these rules: a UAV's program sends a report from
/// the step on in which the camera handed it out, while there is a direct link to the station, and again every ten
/// steps until the report is acknowledged. What is sent in one step arrives in the next. For this, the router must take
/// part in the step of sending and in all later ones up to the arrival, the station in the step of arrival and in the
/// one before, and the link must not lose the message. A killed program loses its reports; when it is back, its camera
/// hands out again all reports that were not acknowledged. A paused program keeps its reports.
std::map<CaptureKey, std::uint64_t> derived_deliveries(const results::RunRecord& run, const Scenario& scenario,
                                                       const FaultPlan& plan);

}  // namespace skein::signals
