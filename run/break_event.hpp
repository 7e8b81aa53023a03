// --break-on: finds in an earlier run when an event first happened to a member.   Threads: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "process/json_text.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// When `what` (of kBreakEvents) first happened to `member`, for --break-at, which stops in the last exchange before
/// that simulated time [s]. For "lost" and "rejected", adds half an exchange period: the exchange at their time decides
/// them, so it must come before the break. @param result  result.json. @returns nullopt: it never happened.
std::optional<double> event_time_s(const Json& result, const std::string& member, const std::string& what);

/// The first input in which an earlier run differs from a plan: "another seed", "other faults"; empty: none is known.
/// Of faults, a result has neither the strength nor the links.
std::string other_input(const Json& result, const FleetPlan& plan);

/// The result of an earlier run. @throws InputError if there is none, or other_input() names one
Json result_of_same_flight(const std::filesystem::path& run, const FleetPlan& plan);

}  // namespace skein::cli
