// What somebody who flies a UAV by hand wants of it: from a browser to the server, to the UAV's planner, and into the
// file that repeats it.   SI and radians.   Pure; any thread.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace skein {

struct HandCommand {
  Vector3d velocity = Vector3d::Zero();  ///< [m/s]: ahead, to the left, up; of the body's heading, level
  double yaw_rate = 0.0;                 ///< to the left
  double gimbal_pitch_rate = 0.0;        ///< down
  double gimbal_yaw_rate = 0.0;          ///< to the left
  bool operator==(const HandCommand&) const = default;
};

/// The planner that does what such commands say.
inline constexpr const char* kHandPlanner = "hand";
/// Under this name the planner `hand` tells what holds it back (/<id>/debug/held).
inline constexpr const char* kHeldSignal = "held";
enum class HeldBack : std::uint8_t {
  no,
  unproved,   ///< what lies ahead is not known to be free
  structure,  ///< it would come too near to something
  peer,       ///< another UAV is in the way
  low,        ///< it has to climb first, or is as low as it may be
};

}  // namespace skein
