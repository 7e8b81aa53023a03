// `skein merge`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct MergeOptions {
  std::filesystem::path dir;
  std::optional<std::string> scenario;  ///< instead of the scenario that the server reports
  std::optional<std::filesystem::path> assets;
  bool report = true;  ///< as in RunOptions
};

/// Adds the command `merge`, whose options CLI11 parses into the second argument.
void add_merge(CLI::App& app, MergeOptions& merge);

/// `skein merge`: writes the files that the launcher would write after a run, for fleets that were started without it.
/// If the server left no report, only joins the parts of the recording, and prints what is missing.
/// @returns as `skein run` would: 3 when members were lost or there is no result; 1 when the recording or a table is
///   damaged.
/// @throws InputError when there is neither a server's report nor a part, or the scenario is not known on this machine.
int merge_reports(const MergeOptions& options, const Console& console);

}  // namespace skein::cli
