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

/// `skein report`: writes report.html of finished runs anew. @returns kExitCheckFailed when a recording is damaged.
/// @throws InputError at the first folder without a result; the pages of the folders before it are written by then.
int make_reports(const ReportOptions& options, const Console& console);

}  // namespace skein::cli
