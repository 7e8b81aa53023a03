// The main program of all tests. A test program holds the tests of a folder; CTest has an entry for each of its files,
// or for a few files that belong together:
//   core_tests --entry core_text_test --file core/text/text_test.cpp [--file ...]
// runs the tests of these files, and names its report after the entry. With --turns K and SKEIN_TURN=N in the
// environment it runs every K-th test, another share for each N (--aligned: all with the same parameters). With
// --half 0 it runs nothing if N is odd, with --half 1 nothing if N is even; for everything else, N / 2 takes the place
// of N. Without these options the program behaves as any GoogleTest program.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Parses the above options and GoogleTest's, and runs the tests. @returns the exit code: 2 for a wrong command line.
int run_test_program(int argc, char** argv);

/// SKEIN_TURN; 0 if it is not set. For tests that draw another case at each commit.
std::size_t turn_number();

/// Whether the item of this number has its turn, one of `turns`; always true without SKEIN_TURN.
bool has_turn(std::size_t number, std::size_t turns);

/// The turn among those of one half, for tests that run in every other turn only: the even ones (0) or the odd ones
/// (1). @returns nullopt in the turns of the other half.
std::optional<std::size_t> turn_in_half(std::size_t turn, std::size_t half);

/// The tests that run in a turn: each test runs in one of every `turns` successive turns. Successive tests run with
/// different parameters, so that each turn covers all DDS vendors, for example.
/// @param tests  "Suite.Name" or "Suite.Name/parameter".
/// @param aligned  all tests run with the same parameters, because a parameter is costly: drawn worlds, for example.
std::vector<std::string> tests_in_turn(const std::vector<std::string>& tests, std::size_t turn, std::size_t turns,
                                       bool aligned = false);

}  // namespace skein
