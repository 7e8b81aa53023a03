// skein report: report.html of finished runs, made again.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// @throws InputError when a folder holds no result; the pages before it are written then.
int make_reports(const ReportOptions& options, const Console& console);

}  // namespace skein::cli
