// How a node's process ends, starts again and really sleeps.
#pragma once

#include <chrono>

namespace skein_ros {

/// The run is over: the node is asked to end, as by SIGTERM. A Python node that does not catch what rclpy.spin() throws
/// then has done nothing wrong, so its exit code becomes 0.
void end_node();
/// For a node that goes on working after end_node(): ends the process if it does so for long.
void count_work_after_end();
[[noreturn]] void exit_at_once(int code);
/// The same program from its beginning, in this process.
[[noreturn]] void start_again();
/// Of the wall clock.
void sleep_really(std::chrono::nanoseconds duration);

}  // namespace skein_ros
