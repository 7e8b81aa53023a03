// How a node's process ends, starts again, and sleeps in wall time.
#pragma once

#include <chrono>

namespace skein_ros {

/// The run is over: raises SIGTERM, so that the node ends; without a handler, the process ends at once. A Python node
/// need not catch what rclpy.spin() then throws, so its exit code 1 becomes 0. Other programs keep their exit codes.
void end_node();
/// Called at each wait or sleep after end_node(). Ends the process if the node goes on for long.
void count_work_after_end();
[[noreturn]] void exit_at_once(int code);
/// Starts the same program from its beginning, in this process.
[[noreturn]] void start_again();
/// Sleeps in wall time, not in simulated time.
void sleep_really(std::chrono::nanoseconds duration);

}  // namespace skein_ros
