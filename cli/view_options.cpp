#include "cli/view_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/replay_command.hpp"
#include "core/text/number_checks.hpp"
#include "core/types.hpp"
#include "view/endpoint.hpp"
#include "view/time_order.hpp"

namespace skein::cli {
namespace {

/// Validator of the endpoint at which the page is served: returns what is wrong with the text, or nothing.
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

void add_film_options(CLI::App& command, CLI::Option& exported, FilmOptions& film) {
  command.add_option("--fps", film.fps, "Film: frames per second (default 25)")
      ->check(CLI::Range(1, 120))
      ->needs(&exported);
  CLI::Option* const seconds =
      command.add_option("--seconds", film.seconds, "Film: its length [s] (default 30)")->needs(&exported);
  seconds->check(CLI::Validator(number_within(0.1, 36000.0), ""))->type_name("SECONDS");
  command.add_option("--speed", film.speed, "Film: simulated seconds per second of the film, instead of --seconds")
      ->check(CLI::Validator(number_within(0.01, 10000.0), ""))
      ->type_name("SPEED")
      ->needs(&exported)
      ->excludes(seconds);
  command
      .add_option("--from-address", film.address,
                  "Film: what it shows, written as the page's address after its #; t is the simulated time at which "
                  "the film begins")
      ->type_name("ADDRESS")
      ->needs(&exported);
}

}  // namespace

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
                  "With --view: simulated seconds per second, from 0.1 to 1000, or max (default 8; 1 if somebody flies "
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
  command.add_flag("--view-close", view.close, "With --view: end the page when the run ends")->needs(watched);
  add_no_browser(command, view.browser);
}

void add_replay(CLI::App& app, ReplayOptions& replay) {
  CLI::App* command = app.add_subcommand("replay", "Show a finished run in a browser, with a slider over its time");
  command->add_option("RUN", replay.run, "A results folder")->required();
  CLI::Option* const other = command->add_option(
      "OTHER", replay.other, "A second run of the same scene: show both on one clock, and where they first differ");
  CLI::Option* const served = command->add_option(
      "--view", replay.at, "Port of 127.0.0.1 (default: a free port), or another address with a port");
  served->type_name("[ADDRESS:]PORT")->check(CLI::Validator(check_endpoint, ""));
  add_no_browser(*command, replay.browser);
  CLI::Option* const exported =
      command->add_option("--export", replay.exported,
                          "Write a file instead: FILE.html, the page with its flight, which opens in any browser; or "
                          "FILE.mp4, a film (needs chromium and ffmpeg)");
  exported->type_name("FILE")->excludes(served);
  command->add_flag("--force", replay.force, "Overwrite the file of --export")->needs(exported);
  command
      ->add_flag("--maps", replay.maps,
                 "Show each UAV's map over time. If the run did not keep these maps (skein run --keep-maps), Skein "
                 "flies it again from its recording, without oracle and report, and stores the maps in RUN")
      ->excludes(other);
  add_film_options(*command, *exported, replay.film);
  command->footer(
      "Examples:\n  skein replay runs/towers-kios-0\n  skein replay runs/towers-kios-0 runs/towers-star-0\n"
      "  skein replay runs/towers-kios-0 --maps\n"
      "  skein replay runs/towers-kios-0 --export flight.html\n"
      "  skein replay runs/towers-kios-0 --export flight.mp4 --from-address '#uav=changi&view=camera'\n\n"
      "See docs/how-to-watch.md.");
}

void check_view(const RunOptions& run) {
  if (run.view.speed) view::read_speed(*run.view.speed);
  if (run.clock == "lockstep" || !(run.view.speed || run.view.pause_at_s)) return;
  throw InputError(std::string(run.view.speed ? "--speed" : "--pause-at") + " is for --clock lockstep: with --clock " +
                   run.clock + " the clock sets the pace");
}

}  // namespace skein::cli
