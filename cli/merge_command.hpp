// `skein merge`: what the launcher makes of a run, for fleets whose programs others started.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Of a run without a server's report it joins the recording's parts, and says what is missing.
/// @returns as `skein run` would: 3 when members were lost or there is no result; 1 when the recording is damaged.
/// @throws InputError when there is neither a server's report nor a part, or its scenario is not known here.
int merge_reports(const MergeOptions& options, const Console& console);

}  // namespace skein::cli
