// Ids of the goals that the flight core itself sets. The ids of planners are not negative.   Pure.
//
// They are distinct, so that Navigator::want() never takes a goal of one kind for the goal of another kind being flown.
#pragma once

#include <cstdint>

namespace skein::agent::goal_ids {

enum : std::int64_t {
  kRecovery = -1,  ///< recovery's flights to places; numeric
  kHome = -2,      ///< a place to deliver captures; numeric
  kTrail = -3,     ///< the UAV's own trail; numeric
  kShowing = -4,   ///< a place beside a photographer; numeric
  kSite = -5,      ///< the first site to land; each further site has the next lower id; numeric
};

}  // namespace skein::agent::goal_ids
