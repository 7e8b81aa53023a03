// `skein report`.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct ReportOptions {
  std::vector<std::filesystem::path> runs;
};

/// Adds the command `report`, whose options CLI11 parses into the second argument.
void add_report(CLI::App& app, ReportOptions& report);

/// `skein report`: writes report.html of finished runs anew, and prints on console.err why a run gets none.
/// @returns the worst exit code of all runs: kExitBadInput for one without a sound result, kExitCheckFailed when a
///   recording is damaged.
int make_reports(const ReportOptions& options, const Console& console);

}  // namespace skein::cli
