// Puts the simulated time into the lines of an agent's log.   Threads: any.
#pragma once

#include <memory>

namespace spdlog {
class logger;
}

namespace skein {

/// Sets the simulated time [s] that all loggers of this process write from now on, if show_log_time() has set them up.
void set_log_time(double simulated_s);

/// Makes a logger write lines as "[NAME 12.35] level text", or as "[NAME] level text" as long as no time is set.
void show_log_time(spdlog::logger& log);

}  // namespace skein
