// `skein merge`: writes the files that the launcher would write after a run, for fleets that were started without it.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// If the server left no report, only joins the parts of the recording, and prints what is missing.
/// @returns as `skein run` would: 3 when members were lost or there is no result; 1 when the recording is damaged.
/// @throws InputError when there is neither a server's report nor a part, or the scenario is not known on this machine.
int merge_reports(const MergeOptions& options, const Console& console);

}  // namespace skein::cli
