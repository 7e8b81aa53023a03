// The fault file of a run that somebody broke by hand (run_folder::kByHand), when it is flown again.   Any thread.
#pragma once

#include <filesystem>
#include <optional>

namespace skein::cli {

/// The fault file of a run must outlast the emptying of its results folder.
/// @param faults  of the run. @throws InputError when it is one of the files that a run in `dir` replaces.
void check_outlasts(const std::optional<std::filesystem::path>& faults, const std::filesystem::path& dir);

}  // namespace skein::cli
