// For the mutant of station_node.cpp: what each station still has to write down. A station that is killed in one
// process is never destroyed, so that no other has its address.
#pragma once

#include <map>
#include <vector>

#include "station/scoreboard.hpp"

namespace skein::station {
inline std::map<const void*, std::vector<TallyRecord>> written_late;
}  // namespace skein::station
