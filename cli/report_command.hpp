// `skein report`: writes report.html of finished runs anew.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @returns the exit code: kExitCheckFailed when a recording is damaged.
/// @throws InputError at the first folder without a result; the pages of the folders before it are written by then.
int make_reports(const ReportOptions& options, const Console& console);

}  // namespace skein::cli
