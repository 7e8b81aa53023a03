// Fills a feed with a finished run, from its results folder, in the same form as during the flight.   Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/run_record.hpp"
#include "view/feed.hpp"
#include "view/kept_clouds.hpp"
#include "view/story.hpp"

namespace skein::view {

/// A finished run as the feed needs it.
struct ToldRun {
  Json scene;
  std::vector<std::string> lines;  ///< in order of time
  std::vector<ShownUav> last;      ///< the fleet at the end of the run
  Heights heights;
};

/// @param run  of read_sound_run(). The scene's "missing" names what the folder lacks.
ToldRun told_run(const results::RunRecord& run);

/// Fills a feed with the run of a results folder. The scene's "missing" names what the folder lacks.
/// @throws InputError when the folder has no result.
void tell_finished_run(const std::filesystem::path& dir, Feed& feed);

/// Title of the run of a results folder: "towers by kios". @throws InputError when the folder has no result.
std::string title_of_run(const std::filesystem::path& dir);

}  // namespace skein::view
