// What a page that holds its flight itself is told: all that a server would tell it, in one text.   Any thread.
#pragma once

#include <cstddef>
#include <string>

#include "view/feed.hpp"

namespace skein::view {

/// @param most_bytes  maps and LiDAR points are in it as long as it is not larger. Points go first, then maps, and what
/// is left is named: {"kept": {"lidar": true, "maps": false}, ...}. 0: neither is in it, and nothing is named.
/// @returns packed (packed.hpp); web/src/kept.js reads it.
std::string kept_flight(const Feed& flight, std::size_t most_bytes);

}  // namespace skein::view
