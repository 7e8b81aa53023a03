// The options of `skein run` and `skein compose` for the page that is served to a browser.
#pragma once

#include <string>

#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Validator of the endpoint at which the page is served: returns what is wrong with the text, or nothing.
std::string check_endpoint(const std::string& text);
/// Adds --no-browser.
void add_no_browser(CLI::App& command, bool& browser);
/// Adds --view, --speed, --pause-at, --view-close and --no-browser, of run and compose.
void add_view_options(CLI::App& command, ViewOptions& view);
/// @throws InputError for an invalid --speed, and for --speed or --pause-at without --clock lockstep.
void check_view(const RunOptions& run);

}  // namespace skein::cli
