// Checks whether a fleet can fly in containers.   Pure; any thread.
#pragma once

#include "cli/compose/compose_file.hpp"

namespace skein::cli {

/// Prefix length of each network of a subnet: 16 addresses, for at most four programs, the engine, and the first and
/// the last address, which no program can have.
inline constexpr int kNetworkPrefix = 28;
/// The network through which browsers reach the page; only the station is in it.
inline constexpr const char* kViewNetwork = "view";

/// @throws InputError if the fleet cannot fly in containers, a name is not valid there, or the subnet is too small.
void check_layout(const FleetPlan& plan, const ComposeLayout& layout);

}  // namespace skein::cli
