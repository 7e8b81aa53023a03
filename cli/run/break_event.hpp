// --break-on: when something happens to a UAV, as a former run of the same flight tells.   Threads: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/run/fleet_plan.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// A time that lies behind the exchange in which a member has it in its hands, and before the next one [s]: that of the
/// first one. @param what  of kBreakEvents. @param result  of result.json
std::optional<double> event_time_s(const Json& result, const std::string& member, const std::string& what);

/// Of a run that must have been the same flight. @throws InputError when there is none, or it was another flight
Json result_of_same_flight(const std::filesystem::path& run, const FleetPlan& plan);

}  // namespace skein::cli
