// skein replay: a finished run on the page that follows a run that flies.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Serves it until the user interrupts. @throws InputError when the folder holds no result, or no page can be served.
int replay_run(const ReplayOptions& options, const Console& console);

}  // namespace skein::cli
