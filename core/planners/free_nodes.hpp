// The planner `ros`: ROS 2 nodes fly the UAV in real time, outside of the lock-step (docs/how-to-ros2.md).
#pragma once

#include <string_view>

namespace skein {

/// Its name in --planner.
inline constexpr std::string_view kFreeNodes = "ros";

/// Environment variable with the names of the debug values that the ROS 2 nodes publish, separated by spaces.
inline constexpr const char* kDebugValuesVariable = "SKEIN_DEBUG_VALUES";

}  // namespace skein
