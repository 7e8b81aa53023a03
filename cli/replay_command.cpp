#include "cli/replay_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>

#include "cli/film/film.hpp"
#include "cli/maps_in_time.hpp"
#include "cli/option_checks.hpp"
#include "cli/view_options.hpp"
#include "core/text/number_checks.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"
#include "results/diff.hpp"
#include "run/live_page.hpp"
#include "view/finished_run.hpp"
#include "view/pages.hpp"
#include "view/two_runs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

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

/// Size limit of an exported page with maps or LiDAR points [bytes], so that it can be sent by mail.
constexpr std::size_t kMostBytes = 4'000'000;

view::Parting parting_of(const fs::path& a, const fs::path& b) {
  try {
    if (const auto difference = results::first_difference(a, b)) return {difference->time_s, difference->fields, {}};
    return {};
  } catch (const InputError& error) {  // a run without digests is shown all the same
    return {{}, {}, error.what()};
  }
}

std::string said_of(const view::Parting& parting) {
  if (!parting.unknown.empty()) return "where they first differ is not known: " + parting.unknown;
  if (!parting.time_s) return "the runs are the same, step by step";
  return fmt::format("first difference at {:.2f} s: {}", *parting.time_s, joined(parting.fields, ", "));
}

/// The content of the page, and its title.
struct Shown {
  view::Feed feed;
  std::string title;
};

void tell(const ReplayOptions& options, const Console& console, Shown& shown) {
  shown.title = view::title_of_run(options.run);
  if (!options.other) return view::tell_finished_run(options.run, shown.feed);
  shown.title = "A: " + shown.title + ", B: " + view::title_of_run(*options.other);
  const view::Parting parting = parting_of(options.run, *options.other);
  view::tell_two_runs(options.run, *options.other, parting, shown.feed);
  console.out << said_of(parting) << std::endl;
}

/// @returns whether the file is to be a film.
bool check_export(const ReplayOptions& options) {
  const fs::path& file = *options.exported;
  const std::string ending = file.extension();
  if (ending != ".html" && ending != ".mp4") {
    throw InputError("--export " + file.string() + ": must end in .html (a page) or .mp4 (a film)");
  }
  const bool is_film = ending == ".mp4";
  const FilmOptions& film = options.film;
  if (!is_film && (film.fps || film.seconds || film.speed || !film.address.empty())) {
    throw InputError("--export " + file.string() +
                     ": --fps, --seconds, --speed and --from-address are for a film (.mp4)");
  }
  if (fs::is_directory(file) || (fs::exists(file) && !options.force)) {
    throw InputError("--export " + file.string() +
                     (fs::is_directory(file) ? ": is a folder" : ": exists already; --force overwrites it"));
  }
  if (const std::string wrong = check_file_to_write(file); !wrong.empty()) throw InputError("--export: " + wrong);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder))
    throw InputError("--export " + file.string() + ": there is no folder " + folder.string());
  return is_film;
}

int export_run(const ReplayOptions& options, const Console& console) {
  const fs::path& file = *options.exported;
  const bool is_film = check_export(options);
  const auto programs = is_film ? std::optional<FilmPrograms>(std::in_place) : std::nullopt;
  if (const int code = options.maps ? add_maps_in_time(options.run, console) : kExitDone; code != kExitDone)
    return code;
  Shown shown;
  tell(options, console, shown);
  const std::string page = view::kept_page(shown.title, shown.feed, is_film ? 0 : kMostBytes);
  if (is_film) {
    write_film(*programs, page, options.film, file, console);
  } else {
    replace_or_overwrite(file, page);
  }
  console.out << fmt::format("{} ({:.1f} MB)\n", file.string(), 1e-6 * static_cast<double>(fs::file_size(file)))
              << std::flush;
  return kExitDone;
}

}  // namespace

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

int replay_run(const ReplayOptions& options, const Console& console) {
  if (options.exported) return export_run(options, console);
  if (const int code = options.maps ? add_maps_in_time(options.run, console) : kExitDone; code != kExitDone)
    return code;
  Shown shown;
  tell(options, console, shown);
  LivePage page(view::read_endpoint(options.at));
  console.out << shown.title << "; Ctrl-C ends its page" << std::endl;
  page.announce([&](const std::string& text) { console.out << text << std::endl; },
                options.browser && console.terminal);
  page.show(shown.feed, shown.title);
  return kExitDone;
}

}  // namespace skein::cli
