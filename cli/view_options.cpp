#include "cli/view_options.hpp"

#include <CLI/CLI.hpp>

#include "core/types.hpp"
#include "view/time_order.hpp"

namespace skein::cli {
namespace {

const CLI::Range kPorts(0, 65535);

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& view) {
  CLI::Option* const watched =
      command
          .add_option("--view", view.port,
                      "Serve a page that follows the run in a browser, on this port of 127.0.0.1, and its replay "
                      "afterwards, until Ctrl-C (default: a free port)")
          ->type_name("[PORT]")
          ->check(kPorts)
          ->expected(0, 1)
          ->default_str("0");
  command
      .add_option("--speed", view.speed,
                  "Simulated seconds a second of a run that is watched, from 0.1 to 1000, or max (default 8)")
      ->type_name("SPEED")
      ->needs(watched);
  command.add_flag("--view-close", view.close, "The page ends with the run")->needs(watched);
}

void add_replay(CLI::App& app, ReplayOptions& replay) {
  CLI::App* command = app.add_subcommand("replay", "Show a finished run in a browser, with a slider over its time");
  command->add_option("RUN", replay.run, "A results folder")->required();
  command->add_option("--view", replay.port, "Port of 127.0.0.1 (default: a free one)")
      ->type_name("PORT")
      ->check(kPorts);
  command->footer("Example:\n  skein replay runs/towers-kios-0\n\ndocs/view.md tells what the page shows.");
}

void check_view(const RunOptions& run) {
  if (!run.view.speed) return;
  view::read_speed(*run.view.speed);
  if (run.clock != "lockstep") {
    throw InputError("--speed is for --clock lockstep: with --clock " + run.clock + " the clock sets the pace");
  }
}

}  // namespace skein::cli
