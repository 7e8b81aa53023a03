// Protects the fault file of an earlier run (run_folder::kByHand) when that run is flown again.   Any thread.
#pragma once

#include <filesystem>
#include <optional>

namespace skein::cli {

/// A run first deletes an earlier run's files from its results folder `dir`: its own fault file must not be among them.
/// @param faults  the run's fault file. @throws InputError if a run in `dir` would delete it.
void check_outlasts(const std::optional<std::filesystem::path>& faults, const std::filesystem::path& dir);

}  // namespace skein::cli
