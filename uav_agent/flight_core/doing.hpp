// What the flight core does at present, for display only; onboard/activity.hpp puts it into words. Frame W.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace skein::agent {

struct Doing {
  enum class What : std::uint8_t {
    ground,
    takeoff,
    awaits_way_up,  ///< until an explorer has proved the space above it free
    to_goal,
    along_goal,   ///< along the waypoints of a goal that has several
    seeks_way,    ///< there are goals, but no path to one yet
    no_goal,      ///< no goal of the planner is left
    shows_mate,   ///< it shows a mate the way up (showing.hpp)
    looks_round,  ///< from here to `back`: recovery (recovery.hpp)
    approaches,
    elsewhere,
    climbs,
    back,
    homing,      ///< to a place in line of sight of the station
    delivers,    ///< its captures arrive at the station
    lands,       ///< at its start, or in need where it is: the battery is nearly empty
    awaits_link  ///< at such a place, but without a link to the station
  };
  What what = What::ground;
  std::optional<Vector3d> goal_W = {};   ///< where it flies to; nullopt: nowhere
  std::optional<std::size_t> mate = {};  ///< index in the fleet of the mate; only if shows_mate
};

}  // namespace skein::agent
