// A run that is over, told from its results folder as it was told while it flew.   Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/run_data.hpp"
#include "view/feed.hpp"
#include "view/kept_clouds.hpp"
#include "view/story.hpp"

namespace skein::view {

/// What is told of a run.
struct ToldRun {
  Json scene;
  std::vector<std::string> lines;  ///< by their times
  std::vector<ShownUav> last;      ///< the fleet at its end
  Heights heights;
};

/// @param run  what the folder `dir` holds. What it lacks is named in the scene's "missing".
ToldRun told_run(const std::filesystem::path& dir, const results::RunData& run);

/// Fills a feed with the run of a results folder. What the folder lacks is named in the scene's "missing".
/// @throws InputError when there is no result in it.
void tell_finished_run(const std::filesystem::path& dir, Feed& feed);

/// "towers by kios", of a results folder. @throws InputError when there is no result in it.
std::string title_of_run(const std::filesystem::path& dir);

}  // namespace skein::view
