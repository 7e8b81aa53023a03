// The flight inside a self-contained page (pages.hpp): all that a server would send, in one text.   Any thread.
#pragma once

#include <cstddef>
#include <string>

#include "view/feed.hpp"

namespace skein::view {

/// @param most_bytes  greatest size of a text with maps and LiDAR points. If it would be larger, the points are left
/// out, then also the maps; the key "kept" says what the text has: {"kept": {"lidar": false, "maps": true}, ...}. 0: it
/// has neither, and no key "kept". Without a scene, the text has no other key.
/// @returns packed (packed.hpp); web/src/kept.js reads it.
std::string kept_flight(const Feed& flight, std::size_t most_bytes);

}  // namespace skein::view
