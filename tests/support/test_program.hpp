// What all test programs do. A program holds the tests of a folder; CTest has an entry for each file of it, or for a
// few files that belong together:
//   core_tests --entry core_text_test --file core/text/text_test.cpp [--file ...]
// runs the tests of these files, and names its report after the entry. With --turns K and SKEIN_TURN=N in the
// environment it runs every K-th of them, another share for each N (--aligned: with the same parameters). Without these
// options it is GoogleTest's own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// Takes its own options and GoogleTest's, and runs the tests. @returns the exit code: 2 for a wrong command line.
int run_test_program(int argc, char** argv);

/// SKEIN_TURN, 0 without it: for tests that draw another case at each commit.
std::size_t turn_number();

/// Whether one of many, by its number, has its turn: always, without SKEIN_TURN.
bool has_turn(std::size_t number, std::size_t turns);

/// The share of the tests that has its turn: each test has one of every `turns` successive turns. One test and the next
/// run with different parameters, so that each turn sees all vendors, say.
/// @param tests  "Suite.Name" or "Suite.Name/parameter". @param aligned  all run with the same parameters, for these
/// are dear: worlds that are drawn.
std::vector<std::string> tests_in_turn(const std::vector<std::string>& tests, std::size_t turn, std::size_t turns,
                                       bool aligned = false);

}  // namespace skein
