// `skein test`: runs the test suite or, with --faults, fault tests.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct TestOptions {
  bool long_tests = false;                      ///< also tests that take minutes; with `faults`: all of `repeat`
  std::vector<std::string> folders;             ///< only tests in or below these: "sim_server", "tests/fleet"
  std::optional<std::filesystem::path> faults;  ///< a fault test, or a folder of them, instead of the suite
  std::vector<std::string> repeat;              ///< further runs of each fault test: names of enum Repeat
  bool rotate = false;                          ///< only one of `repeat` for each test, in turn
  std::filesystem::path out = "runs/faults";    ///< results of fault tests
  std::optional<std::filesystem::path> assets;  ///< as in RunOptions
  std::optional<std::filesystem::path> agent;   ///< as in RunOptions
  bool one_process = false;                     ///< as in RunOptions
  std::optional<std::string> seeds;             ///< fly each test with each of these seeds; format as in StudyOptions
  std::optional<std::filesystem::path> junit;   ///< file for a report of the fault tests as JUnit XML
  int jobs = 1;                                 ///< flights at once
  bool verbose = false;                         ///< also print the margin of each property that holds
};

/// Adds the command `test`, whose options CLI11 parses into the second argument.
void add_test(CLI::App& app, TestOptions& test);

/// `skein test`: runs the test suite of this build, or with --faults the user's fault tests; the summary is the last
/// line. @throws InputError when this build has no tests, or for invalid options.
int run_tests(const TestOptions& options, const Console& console);

/// `skein test --faults`: prints one line per test, PASS or FAIL, with what does not hold below it; the last line is 'N
/// passed, N failed'. All files are validated before anything flies. A run without faults that several tests compare
/// with is flown once. With --junit the report exists from the start and grows with each test, so after Ctrl-C it holds
/// the tests that were flown. @throws InputError when a file is wrong; Interrupted.
int run_fault_tests(const TestOptions& options, const Console& console);

}  // namespace skein::cli
