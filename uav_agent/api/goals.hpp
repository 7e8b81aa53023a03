// How a strategy says where it wants to go, and what it hears of it. The flight core (flight_core/flight_core.hpp) does
// the flying: it finds ways, keeps clear, takes off, brings captures home, and gets on where something is in the way.
// Frame W.   Units: SI and radians unless the name says otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "uav_agent/api/motion.hpp"

namespace skein::agent {

/// Where the camera looks: monostate: carry on; a point in W to keep in the image's centre; or a command as it is.
using GimbalAim = std::variant<std::monostate, Vector3d, GimbalCommand>;

/// Something that a strategy wants: to be at a place, or to fly along a line from there.
struct Goal {
  std::int64_t id = 0;             ///< its strategy's name for it
  std::vector<Waypoint> way = {};  ///< at least one: the core finds a way to the first, and flies on along the others
  std::optional<double> yaw = {};  ///< of the body, from the first waypoint on
  GimbalAim gimbal = {};           ///< from when it is taken up
};

/// What became of a goal.
struct Outcome {
  enum class Kind : std::uint8_t {
    reached,  ///< the UAV rests at the end of its way
    no_way,   ///< there is no way to its first waypoint, or none that could be proved to be free
    blocked,  ///< something stands on its way: `leg` tells how far it came
  };
  std::int64_t id = 0;
  Kind kind = Kind::reached;
  std::size_t leg = 0;      ///< waypoint of its way that it did not reach
  std::string reason = {};  ///< for a log
};

/// What the flight core is about, for a strategy.
struct FlightState {
  bool working = false;                   ///< in the air, and free to fly to goals; else they wait
  bool idle = false;                      ///< working, and no goal is left
  std::optional<std::int64_t> goal = {};  ///< the one it flies to or along
  bool on_way = false;                    ///< along its way: past the first waypoint
  std::size_t leg = 0;                    ///< waypoint of its way that it flies to
  std::vector<Outcome> outcomes = {};     ///< since the exchange before, in their order
};

}  // namespace skein::agent
