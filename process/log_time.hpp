// The simulated time in the lines of an agent's log.   Threads: any.
#pragma once

#include <memory>

namespace spdlog {
class logger;
}

namespace skein {

/// From here on each line that this process logs begins with that time, where its log shows times at all.
void set_log_time(double simulated_s);

/// "[NAME 12.35] level text" once there is a time, "[NAME] level text" before.
void show_log_time(spdlog::logger& log);

}  // namespace skein
