// Refuses a fleet that does not fit into the memory of this host.   Threads: any.
#pragma once

#include <cstdint>
#include <optional>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Memory that the fleet's programs need at least [bytes]: an estimate (process/host/memory.hpp).
std::uint64_t memory_need(const FleetPlan& plan);

/// @param left  memory that programs can still get on this host [bytes]; nullopt: unknown, so there is no check. Nor is
///   there one of a fleet on several hosts (--place).
/// @throws InputError that names the need and what is left when the fleet does not fit.
void check_memory(const FleetPlan& plan, const std::optional<std::uint64_t>& left);

}  // namespace skein::cli
