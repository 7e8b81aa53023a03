#include "cli/view_options.hpp"

#include <CLI/CLI.hpp>

#include "core/text/number_checks.hpp"
#include "core/types.hpp"
#include "view/endpoint.hpp"
#include "view/time_order.hpp"

namespace skein::cli {

std::string check_endpoint(const std::string& text) {
  try {
    view::read_endpoint(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

void add_no_browser(CLI::App& command, bool& browser) {
  command.add_flag("--no-browser{false}", browser, "Do not open a browser");
}

void add_view_options(CLI::App& command, ViewOptions& view) {
  CLI::Option* const watched =
      command
          .add_option(
              "--view", view.at,
              "Serve a page that follows the run in a browser, and then its replay until Ctrl-C: on this port of "
              "127.0.0.1 (default: a free port), or at an address that other hosts reach, such as 0.0.0.0:8080")
          ->type_name("[[ADDRESS:]PORT]")
          ->check(CLI::Validator(check_endpoint, ""))
          ->expected(0, 1)
          ->default_str("0");
  command
      .add_option("--speed", view.speed,
                  "With --view: simulated seconds per second, from 0.1 to 1000, or max (default 8; 1 if you fly a UAV "
                  "by hand)")
      ->type_name("SPEED")
      ->needs(watched);
  command
      .add_option("--pause-at", view.pause_at_s,
                  "With --view: pause the run at this simulated time [s] until you resume it on the page; 0: before "
                  "its first step")
      ->type_name("SECONDS")
      ->check(CLI::Validator(number_within(0.0, 1e6), ""))
      ->needs(watched);
  command.add_flag("--view-close", view.close, "With --view: stop the server of the page when the run ends")
      ->needs(watched);
  add_no_browser(command, view.browser);
}

void check_view(const RunOptions& run) {
  if (run.view.speed) view::read_speed(*run.view.speed);
  if (run.clock == "lockstep" || !(run.view.speed || run.view.pause_at_s)) return;
  throw InputError(std::string(run.view.speed ? "--speed" : "--pause-at") + " is for --clock lockstep: with --clock " +
                   run.clock + " the clock sets the pace");
}

}  // namespace skein::cli
