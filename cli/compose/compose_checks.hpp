// What a fleet must be to fly in containers.   Pure; any thread.
#pragma once

#include "cli/compose/compose_file.hpp"

namespace skein::cli {

/// Of each network of a subnet: room for its members (at most four), the engine's own address, the first and the last.
inline constexpr int kNetworkPrefix = 28;
/// By which browsers come to the page; nobody but the station is in it.
inline constexpr const char* kViewNetwork = "view";

/// @throws InputError for what cannot fly in containers, and for a subnet with too little room.
void check_layout(const FleetPlan& plan, const ComposeLayout& layout);

}  // namespace skein::cli
