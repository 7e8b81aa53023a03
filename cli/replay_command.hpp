// `skein replay`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/console.hpp"
#include "cli/film/film_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein replay`: shows a finished run in a browser, or two runs on one clock; or writes a file that shows them.
struct ReplayOptions {
  std::filesystem::path run;
  std::optional<std::filesystem::path> other;
  std::string at = "0";  ///< endpoint of the page, as in ViewOptions; so is the next member
  bool browser = true;
  std::optional<std::filesystem::path> exported;  ///< .html or .mp4, instead of a page that is served
  bool force = false;                             ///< overwrite the exported file
  FilmOptions film;
  bool maps = false;  ///< first compute the snapshots of UAVs' maps, if the folder has none (maps_in_time.hpp)
};

/// Adds the command `replay`, whose options CLI11 parses into the second argument.
void add_replay(CLI::App& app, ReplayOptions& replay);

/// `skein replay`: shows a finished run, or two runs on one clock, on the same page that follows a live run. Serves the
/// page until the user interrupts, or writes it to a file.
/// @throws InputError when a folder holds no result, two runs have no scene in common, no page can be served, or the
///   requested file cannot be written; Interrupted while a film is made.
int replay_run(const ReplayOptions& options, const Console& console);

}  // namespace skein::cli
