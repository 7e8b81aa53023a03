// `skein test`: the suite that stands beside this build, or a user's fault tests.
#pragma once

#include <filesystem>
#include <ostream>

#include "cli/options.hpp"
#include "cli/run_command.hpp"

namespace skein::cli {

struct TestCounts {
  int passed = 0, failed = 0, skipped = 0;
};

/// Counts single tests: those inside a GoogleTest program from its JSON report, all others from ctest's JUnit file.
/// @param reports folder of the GoogleTest reports, one a program, called as its ctest entry.
/// @throws std::runtime_error when the JUnit file cannot be read.
TestCounts count_tests(const std::filesystem::path& junit, const std::filesystem::path& reports);

/// "N passed, N failed", with ", N skipped" when there are any.
std::string summary_line(const TestCounts& counts);

/// Runs the suite, or with --faults what fault_test_command.hpp says; the summary is the last line.
int run_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
