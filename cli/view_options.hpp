// The options of `skein run` and `skein compose` for the page that is served to a browser.
#pragma once

#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds --view, --speed, --pause-at, --view-close and --no-browser, of run and compose.
void add_view_options(CLI::App& command, ViewOptions& view);
/// @throws InputError for an invalid --speed, and for --speed or --pause-at without --clock lockstep.
void check_view(const RunOptions& run);

}  // namespace skein::cli
