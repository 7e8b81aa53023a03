// How many tests passed, and which took longest.
#pragma once

#include <filesystem>
#include <string>

namespace skein::cli {

struct TestCounts {
  int passed = 0, failed = 0, skipped = 0;
};

/// Counts single tests: those in a GoogleTest program from its JSON report, all others from ctest's JUnit file.
/// @param reports  folder of the GoogleTest reports, one for each ctest entry and named after it.
/// @throws std::runtime_error when the JUnit file cannot be read.
TestCounts count_tests(const std::filesystem::path& junit, const std::filesystem::path& reports);

/// Table of the ctest entries that took longest, the longest first, with their times [s]: at most `count` lines, below
/// a heading with the total time. Empty without entries.
/// @throws std::runtime_error when the JUnit file cannot be read.
std::string parts_table(const std::filesystem::path& junit, std::size_t count);

/// "N passed, N failed", with ", N skipped" when there are any.
std::string summary_line(const TestCounts& counts);

}  // namespace skein::cli
