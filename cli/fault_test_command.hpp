// `skein test --faults`: flies fault tests and says which expectations hold.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// One line a test, PASS or FAIL, below it what was expected and seen; the last line is 'N passed, N failed'.
/// All files are validated before anything flies. A run without faults that several tests compare with is flown once.
/// With --junit the report is there from the beginning, and grows with each test: after Ctrl-C it has those that flew.
/// @throws InputError when a file is wrong; Interrupted.
int run_fault_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
