// The planner `ros`: a UAV that ROS 2 nodes fly in real time, outside of the lock-step (docs/ros2.md).
#pragma once

#include <string_view>

namespace skein {

/// As --planner takes it.
inline constexpr std::string_view kFreeNodes = "ros";

/// In the environment: the names of the debug values that ROS 2 nodes tell, with spaces between them.
inline constexpr const char* kDebugValuesVariable = "SKEIN_DEBUG_VALUES";

}  // namespace skein
