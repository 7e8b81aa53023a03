// For the mutant of station_node.cpp: the records that each station has yet to write, by the station's address. A
// station that is killed in a one-process run is never destroyed, so no other station gets its address.
#pragma once

#include <map>
#include <vector>

#include "station/scoreboard.hpp"

namespace skein::station {
inline std::map<const void*, std::vector<TallyRecord>> written_late;
}  // namespace skein::station
