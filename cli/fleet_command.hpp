// `skein fleet`.
#pragma once

#include "cli/console.hpp"
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein fleet`: a fleet that another program steps.
struct FleetOptions {
  RunOptions run;
  int session = -1;  ///< file descriptor of the socket to that program
};

/// Adds the command `fleet`, whose options CLI11 parses into the second argument.
void add_fleet(CLI::App& app, FleetOptions& fleet);

/// `skein fleet`: a fleet that another program steps, as skein.Fleet does in Python. Plans and checks the flight, then
/// replaces this process with the one that simulates the whole fleet (one_process/session.hpp); returns only when that
/// fails. @throws InputError, Interrupted.
int step_fleet(const FleetOptions& options, const Console& console);

}  // namespace skein::cli
