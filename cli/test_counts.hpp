// How many tests passed, and which took longest.
#pragma once

#include <filesystem>
#include <string>

namespace skein::cli {

struct TestCounts {
  int passed = 0, failed = 0, skipped = 0;
};

/// Counts single tests: those inside a GoogleTest program from its JSON report, all others from ctest's JUnit file.
/// @param reports folder of the GoogleTest reports, one a program, called as its ctest entry.
/// @throws std::runtime_error when the JUnit file cannot be read.
TestCounts count_tests(const std::filesystem::path& junit, const std::filesystem::path& reports);

/// The entries of ctest that took longest, the longest first, with their seconds: at most `count` lines below a heading
/// that names the time of all. Empty without entries.
/// @throws std::runtime_error when the JUnit file cannot be read.
std::string parts_table(const std::filesystem::path& junit, std::size_t count);

/// "N passed, N failed", with ", N skipped" when there are any.
std::string summary_line(const TestCounts& counts);

}  // namespace skein::cli
