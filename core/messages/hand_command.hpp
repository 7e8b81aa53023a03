// Commands for a UAV that a person flies by hand. They pass from a browser to the server and from there to the UAV's
// planner; the server also writes them to a file that can replay the flight.   SI and radians.   Pure; any thread.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace skein {

struct HandCommand {
  Vector3d velocity = Vector3d::Zero();  ///< forward, left, up [m/s], in B without its roll and pitch
  double yaw_rate = 0.0;                 ///< [rad/s], positive: to the left
  double gimbal_pitch_rate = 0.0;        ///< [rad/s], positive: down
  double gimbal_yaw_rate = 0.0;          ///< [rad/s], positive: to the left
  bool operator==(const HandCommand&) const = default;
};

/// Name of the planner that executes these commands.
inline constexpr const char* kHandPlanner = "hand";
/// Name of the debug value (/<id>/debug/held) in which the planner `hand` reports why the UAV is slower than commanded.
inline constexpr const char* kHeldSignal = "held";
enum class HeldBack : std::uint8_t {
  no,
  unproved,   ///< the space ahead is not proved free
  structure,  ///< the UAV would come too close to structure
  peer,       ///< another UAV is in the way
  low,        ///< the UAV has to climb first, or is at its lowest permitted height
};

}  // namespace skein
