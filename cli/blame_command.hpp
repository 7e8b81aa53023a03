// `skein blame`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein blame`: what each fault of a run cost.
struct BlameOptions {
  std::filesystem::path what;                  ///< a results folder, or a capsule
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions; so is the next member
  std::optional<std::filesystem::path> assets;
  std::optional<std::string> dds;  ///< a vendor or "mixed"; none: in one process where possible
  std::vector<double> messages;    ///< begin and end [s]: also remove each link's messages of that time, link by link
  std::optional<std::filesystem::path> out;
  bool force = false;  ///< write to a folder that is not empty
};

/// Adds the command `blame`, whose options CLI11 parses into the second argument.
void add_blame(CLI::App& app, BlameOptions& blame);

/// `skein blame`: flies a run again without one of its faults at a time, and on request without one link's messages at
/// a time, and ranks them by what they cost.
/// @throws InputError when there is nothing to blame, or the run cannot be repeated; Interrupted.
int blame(const BlameOptions& options, const Console& console);

}  // namespace skein::cli
