// skein run CAPSULE: flies what a hunt found (capsule_text() in plan.hpp), and says whether it is still so.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Whether `skein run` was given a capsule in the place of a scenario.
bool is_capsule(const RunOptions& options);

/// Of the options, those count that do not say what is flown: agent, DDS or one process, folder, recording, report.
/// @returns 0 when what failed then holds, 1 when it fails. @throws InputError, Interrupted.
int run_capsule(const RunOptions& options, const Console& console);

}  // namespace skein::cli
