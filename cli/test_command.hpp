// `skein test`: the suite that stands beside this build, or a user's fault tests.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Runs the suite, or with --faults what fault_test_command.hpp says; the summary is the last line.
int run_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
