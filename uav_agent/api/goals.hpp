// Goals, by which a planner tells the flight core where to fly, and their outcomes. The flight core
// (flight_core/flight_core.hpp) takes off, searches paths, keeps clear of structure and UAVs, returns to the station to
// deliver captures, and recovers when it reaches no goal.
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

/// Aim of the camera. monostate: the last aim stays; Vector3d: a point in W to keep in the centre of the image;
/// GimbalCommand: goes to the gimbal unchanged.
using GimbalAim = std::variant<std::monostate, Vector3d, GimbalCommand>;

/// What the planner wants: to be at a place, or to fly along a line of waypoints that begins there.
struct Goal {
  /// The planner's own number, not negative: the core's own goals have negative ones. If the first goal of a new list
  /// has the id of the goal being flown, the core goes on with it; its `way` may have changed.
  std::int64_t id = 0;
  /// At least one waypoint. The core searches a path to the first one, then flies straight from each to the next.
  std::vector<Waypoint> way = {};
  std::optional<double> yaw = {};  ///< of the body in W, from 4 m before the first waypoint on; nullopt: any
  GimbalAim gimbal = {};           ///< applied when the core sets out to the goal
};

/// The value of a UAV's work, from a planner that knows it. The flight core then weighs the loss of captures against
/// the time of a delivery (flight/delivery_rule.hpp).
struct Stake {
  double value = 0.0;       ///< score that would be lost with the UAV: of captures that the station lacks [points]
  double gain_per_s = 0.0;  ///< score that the planner's present route promises [points/s]
};

/// How a goal ended.
struct Outcome {
  enum class Kind : std::uint8_t {
    reached,  ///< the UAV rests at the end of its way
    no_way,   ///< the UAV could not reach the first waypoint: no path, or none proved free
    blocked,  ///< past the first waypoint, structure, unproved space or a UAV was in the way
  };
  std::int64_t id = 0;  ///< Goal::id
  Kind kind = Kind::reached;
  std::size_t leg = 0;      ///< if `blocked`: index in Goal::way of the waypoint that the UAV did not reach
  std::string reason = {};  ///< for a log; empty if `reached`
};

/// State of the flight core, as the planner needs it.
struct FlightState {
  bool working = false;                   ///< the core flies to goals now; otherwise (takeoff, recovery, ...) they wait
  bool idle = false;                      ///< working, and no goal of the last list is left
  std::optional<std::int64_t> goal = {};  ///< id of the goal being flown; only while working
  bool on_way = false;                    ///< the UAV has reached the first waypoint and flies along `way`
  std::size_t leg = 0;                    ///< while on_way: index in Goal::way of the waypoint that it flies to
  std::vector<Outcome> outcomes = {};     ///< of goals that ended since the last exchange with `working`, in order
};

}  // namespace skein::agent
