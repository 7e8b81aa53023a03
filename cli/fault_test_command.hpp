// `skein test --faults`: flies fault tests and reports what holds.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Prints one line per test, PASS or FAIL, with what does not hold below it; the last line is 'N passed, N
/// failed'. All files are validated before anything flies. A run without faults that several tests compare with is
/// flown once. With --junit the report exists from the start and grows with each test, so after Ctrl-C it holds the
/// tests that were flown. @returns the exit code. @throws InputError when a file is wrong; Interrupted.
int run_fault_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
