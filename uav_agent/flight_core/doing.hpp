// The flight core's present activity, for display only; onboard/activity.hpp puts it into words. Frame W.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace skein::agent {

struct Doing {
  enum class What : std::uint8_t {
    ground,
    takeoff,
    awaits_way_up,  ///< waits until an explorer has proved the space above this UAV free
    to_goal,
    along_goal,   ///< flies along the waypoints of a goal that has several
    seeks_way,    ///< there are goals, but no path to one yet
    no_goal,      ///< all goals of the planner have ended, or it has set none
    shows_mate,   ///< shows a photographer the way up (showing.hpp)
    looks_round,  ///< this and the next four, up to `back`: recovery behaviours (recovery.hpp)
    approaches,
    elsewhere,
    climbs,
    back,
    makes_room,  ///< flies aside for a UAV that stands close to it (making_room.hpp)
    homing,      ///< flies to a place in line of sight of the station
    delivers,    ///< stays at a place from which its captures reach the station
    lands,       ///< flies to a landing place and lands: the battery is nearly empty (landing.hpp)
    awaits_link  ///< is at a place for homing, but has no link to the station
  };
  What what = What::ground;
  std::optional<Vector3d> goal_W = {};   ///< where the UAV flies to; nullopt: nowhere
  std::optional<std::size_t> mate = {};  ///< with shows_mate: index of the photographer in the fleet
};

}  // namespace skein::agent
