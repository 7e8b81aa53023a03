// `skein merge`: what the launcher makes of a run, for fleets whose programs others started.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// @returns as `skein run` would: 3 when members were lost. @throws InputError when there is no server's report, or its
///   scenario is not known here.
int merge_reports(const MergeOptions& options, const Console& console);

}  // namespace skein::cli
