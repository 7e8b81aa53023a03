#include "tests/support/test_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

/// Removes every `option VALUE` from the arguments. @returns the values
std::vector<std::string> take(std::vector<std::string>& arguments, const std::string& option) {
  std::vector<std::string> values;
  for (auto at = arguments.begin(); (at = std::find(at, arguments.end(), option)) != arguments.end();) {
    if (at + 1 == arguments.end()) break;
    values.push_back(at[1]);
    at = arguments.erase(at, at + 2);
  }
  return values;
}

/// The tests of a source file, in the order in which they are in the file.
std::vector<std::string> tests_of(const std::string& file) {
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  std::vector<std::string> tests;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const ::testing::TestInfo& test = *suite.GetTestInfo(k);
      if (!("/" + std::string(test.file())).ends_with("/" + file)) continue;
      tests.push_back(std::string(suite.name()) + "." + test.name());
    }
  }
  return tests;
}

std::optional<std::size_t> turn_asked_for() {
  const char* const turn = std::getenv("SKEIN_TURN");
  if (!turn) return std::nullopt;
  return std::stoul(turn);
}

/// Runs the chosen tests. They, and the programs that they start, have a temporary folder of their own: so two suites
/// may run at the same time, and nothing remains of tests that pass.
int run_in_own_folder() {
  namespace fs = std::filesystem;
  ScratchFolder folder;
  const std::string path = folder.path().string();
  fs::permissions(path, fs::perms::all | fs::perms::sticky_bit);  // as /tmp: some tests start programs of other users
  ::setenv("TMPDIR", path.c_str(), 1);
  ::setenv("TEST_TMPDIR", path.c_str(), 1);  // GoogleTest's TempDir() prefers this variable
  const int result = RUN_ALL_TESTS();
  if (result != 0 && !fs::is_empty(path)) {
    std::printf("files of these tests: %s\n", path.c_str());
    folder.keep();
  }
  return result;
}

}  // namespace

std::size_t turn_number() { return turn_asked_for().value_or(0); }

bool has_turn(std::size_t number, std::size_t turns) {
  const std::optional<std::size_t> turn = turn_asked_for();
  return !turn || (number + *turn) % turns == 0;
}

std::optional<std::size_t> turn_in_half(std::size_t turn, std::size_t half) {
  return turn % 2 == half ? std::optional(turn / 2) : std::nullopt;
}

std::vector<std::string> tests_in_turn(const std::vector<std::string>& tests, std::size_t turn, std::size_t turns,
                                       bool aligned) {
  std::vector<std::string> names, parameters, chosen;
  const auto number = [](std::vector<std::string>& known, const std::string& one) {
    const auto found = std::find(known.begin(), known.end(), one);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    known.push_back(one);
    return known.size() - 1;
  };
  for (const std::string& test : tests) {
    const std::size_t slash = test.find('/', test.find('.') + 1);
    const bool has_parameter = slash != std::string::npos;
    std::size_t place = has_parameter ? number(parameters, test.substr(slash)) : 0;
    if (!aligned || !has_parameter) place += number(names, test.substr(0, slash));
    if ((place + turn) % turns == 0) chosen.push_back(test);
  }
  return chosen;
}

int run_test_program(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::vector<std::string> entries = take(arguments, "--entry"), files = take(arguments, "--file"),
                                 turns = take(arguments, "--turns"), halves = take(arguments, "--half");
  const bool aligned = std::erase(arguments, "--aligned") > 0;
  // If GTEST_OUTPUT names a folder, the report in it is named after CTest's entry (`--entry`). InitGoogleMock() reads
  // the flag `output`, so the flag must be set before.
  const std::string output = GTEST_FLAG_GET(output);
  if (!entries.empty() && output.ends_with("/")) GTEST_FLAG_SET(output, output + entries.front() + ".json");
  std::vector<char*> rest = {argv[0]};
  for (std::string& argument : arguments) rest.push_back(argument.data());
  int count = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  ::testing::InitGoogleMock(&count, rest.data());
  if (count > 1) {
    std::fprintf(stderr, "%s: unknown argument '%s'\n", argv[0], rest[1]);
    return 2;
  }
  std::vector<std::string> tests;
  for (const std::string& file : files) {
    const std::vector<std::string> more = tests_of(file);
    if (more.empty()) {
      std::fprintf(stderr, "%s: no test of '%s' is in here\n", argv[0], file.c_str());
      return 2;
    }
    tests.insert(tests.end(), more.begin(), more.end());
  }
  if (!halves.empty() && halves.front() != "0" && halves.front() != "1") {
    std::fprintf(stderr, "%s: --half '%s': must be 0 or 1\n", argv[0], halves.front().c_str());
    return 2;
  }
  if (const std::optional<std::size_t> turn = turn_asked_for(); turn && !halves.empty()) {
    const std::optional<std::size_t> own = turn_in_half(*turn, halves.front() == "1" ? 1 : 0);
    if (own) setenv("SKEIN_TURN", std::to_string(*own).c_str(), 1);
    if (!own) std::printf("turn %zu: none of %zu tests\n", *turn, tests.size());
    if (!own) GTEST_FLAG_SET(filter, "-*");
  }
  const std::size_t shares = turns.empty() ? 1 : std::strtoul(turns.front().c_str(), nullptr, 10);
  if (shares == 0) {
    std::fprintf(stderr, "%s: --turns '%s': must be a number from 1 on\n", argv[0], turns.front().c_str());
    return 2;
  }
  if (const std::optional<std::size_t> turn = turn_asked_for(); turn && !turns.empty()) {
    const std::size_t all = tests.size();
    tests = tests_in_turn(tests, *turn, shares, aligned);
    std::printf("turn %zu: %zu of %zu tests\n", *turn, tests.size(), all);
  }
  std::string filter;
  for (const std::string& test : tests) filter += test + ":";
  if (!files.empty() && GTEST_FLAG_GET(filter) == "*") GTEST_FLAG_SET(filter, filter);
  return run_in_own_folder();
}

}  // namespace skein
