// What the flight core is about, for people: onboard/activity.hpp has the words. Frame W.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace skein::agent {

struct Doing {
  enum class What : std::uint8_t {
    ground,
    takeoff,
    awaits_way_up,  ///< that an explorer shows it what is free above
    to_goal,
    along_goal,   ///< that is a line
    seeks_way,    ///< a goal is left, and no way to one has been found yet
    no_goal,      ///< its strategy has none that is left
    shows_mate,   ///< its way up
    looks_round,  ///< and on to `back`: recovery
    approaches,
    elsewhere,
    climbs,
    back,
    homing,      ///< to where the station is in sight
    delivers,    ///< there
    lands,       ///< at its start: its battery has no more to give
    awaits_link  ///< there, without a link
  };
  What what = What::ground;
  std::optional<Vector3d> goal_W = {};   ///< where it flies to
  std::optional<std::size_t> mate = {};  ///< that it shows its way, as index in the fleet
};

}  // namespace skein::agent
