// `skein run CAPSULE`: flies a find of a hunt again (capsule_text() in plan.hpp), and evaluates its property.
#pragma once

#include "cli/console.hpp"
#include "cli/fault_tests/fault_test.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// Whether the scenario that `skein run` was given is a capsule. Reads the file. @throws InputError if it is not YAML.
bool is_capsule(const RunOptions& options);

/// Message for the user: whether this run has the same digest as the run from which the capsule was made.
/// @param digest  of the run; empty: it has none.
std::string comparison_text(const CapsuleMark& mark, const std::string& digest);

/// Accepts only options that do not change what is flown, such as agent, DDS or one process, folder, recording, report.
/// @returns 0 if the property that failed in the hunt holds now, 1 if it fails.
/// @throws InputError, also for other options; Interrupted.
int run_capsule(const RunOptions& options, const Console& console);

}  // namespace skein::cli
