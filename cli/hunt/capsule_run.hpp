// skein run CAPSULE: flies what a hunt found (capsule_text() in plan.hpp), and says whether it is still so.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/fault_tests/fault_test.hpp"

namespace skein::cli {

/// Whether `skein run` was given a capsule in the place of a scenario.
bool is_capsule(const RunOptions& options);

/// Whether a run is the one that a capsule was made of, for people: it says so only of the digest that was found.
/// @param digest  of the run; empty: it has none.
std::string comparison_text(const CapsuleMark& mark, const std::string& digest);

/// Of the options, those are taken that do not say what is flown: agent, DDS or one process, folder, recording, report.
/// @returns 0 when what failed then holds, 1 when it fails. @throws InputError, also for other options; Interrupted.
int run_capsule(const RunOptions& options, const Console& console);

}  // namespace skein::cli
