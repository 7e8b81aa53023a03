// A run that is over, told from its results folder as it was told while it flew.   Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "view/feed.hpp"

namespace skein::view {

/// Fills a feed with the run of a results folder. What the folder lacks is named in the scene's "missing".
/// @throws InputError when there is no result in it.
void tell_finished_run(const std::filesystem::path& dir, Feed& feed);

/// "towers by kios", of a results folder. @throws InputError when there is no result in it.
std::string title_of_run(const std::filesystem::path& dir);

}  // namespace skein::view
