// The command line that repeats a run in which a watching user intervened (flew by hand, caused faults): it serves no
// page, and takes these interventions from the files that the run left.   Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein::cli {

/// New values for options of the command line; nullopt: the option stays as typed.
struct Repeated {
  std::optional<std::string> planners = {};          ///< for --planner
  std::optional<std::filesystem::path> faults = {};  ///< for --faults
};

/// @param command  `skein run ...` as typed. Options of the page and of the results folder are left out.
std::string command_repeated(const std::string& command, const Repeated& by);

}  // namespace skein::cli
