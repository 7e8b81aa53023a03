// The simulated time in the lines of an agent's log.   Threads: any.
#pragma once

#include <memory>

namespace spdlog {
class logger;
}

namespace skein {

/// Sets the simulated time [s] that loggers with show_log_time() add to the lines of this process from now on.
void set_log_time(double simulated_s);

/// Makes a logger write "[NAME 12.35] level text" once a time is set; before, it writes "[NAME] level text".
void show_log_time(spdlog::logger& log);

}  // namespace skein
