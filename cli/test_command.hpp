// `skein test`: runs the test suite of this build, or a user's fault tests.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Runs the suite, or with --faults the fault tests (fault_test_command.hpp); the summary is the last line.
/// @returns the exit code. @throws InputError when this build has no tests, or for invalid options.
int run_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
