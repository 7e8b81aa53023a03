// The flights of a call of `skein test --faults`: each test, its repetitions, and the runs without faults that tests
// compare with, each of these once. Pure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/test_command.hpp"

namespace skein::cli {

/// One `skein run`.
struct FaultFlight {
  std::string name;  ///< of its folder
  RunOptions options;
  std::optional<std::size_t> chaos = {};  ///< SKEIN_CHAOS
};

/// The flights by which a test is judged, as indices.
struct FlightsOfTest {
  std::size_t own = 0;
  std::optional<std::size_t> fault_free;
  std::vector<std::pair<std::string, std::size_t>> repeats;  ///< how they are flown
};

struct FaultFlights {
  std::vector<FaultFlight> flights;  ///< in the order in which they start
  std::vector<FlightsOfTest> tests;  ///< in the order of the tests
};

/// @throws InputError when two flights would have the same folder, for example a repetition of a.yaml and a-again.yaml.
FaultFlights plan_fault_flights(const std::vector<FaultTest>& tests, const TestOptions& options);

/// A text that is the same for two runs if they are the same run without faults, whatever the DDS vendor.
std::string what_is_flown(const RunOptions& options);

}  // namespace skein::cli
