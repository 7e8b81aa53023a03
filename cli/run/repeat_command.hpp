// The command line that flies a run again, of which somebody who watched it took a hand: without a page, from the files
// that it left.   Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein::cli {

/// What takes the place of what was typed.
struct Repeated {
  std::optional<std::string> planners = {};          ///< of --planner
  std::optional<std::filesystem::path> faults = {};  ///< of --faults
};

/// @param command  `skein run ...` as it was given. What is about the page or the results folder is left out.
std::string command_repeated(const std::string& command, const Repeated& by);

}  // namespace skein::cli
