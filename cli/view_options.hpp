// The options of what a browser is served: of `skein run`, and of `skein replay`.
#pragma once

#include "cli/command.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// --view, --speed, --pause-at, --view-close, --no-browser; of run and compose.
void add_view_options(CLI::App& command, ViewOptions& view);
/// The command `replay`.
void add_replay(CLI::App& app, ReplayOptions& replay);
/// What does not go together. @throws InputError for it.
void check_view(const RunOptions& run);

}  // namespace skein::cli
