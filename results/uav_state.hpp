// What became of a UAV, in a word for the tables of the terminal and of reports. Pure; any thread.
#pragma once

#include <string>

#include "process/json_text.hpp"

namespace skein::results {

/// @param uav  an entry of `uavs` of result.json. @param faults  `faults` of result.json.
/// @returns "collided"; of a UAV whose program was away at the end of the run "lost", "killed" or "paused" (the latter
/// two by a fault); otherwise "alive". "-": not known.
std::string uav_state(const Json& uav, const Json& faults);

}  // namespace skein::results
