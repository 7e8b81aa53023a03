// A fault test: a run, what goes wrong in it, and what must hold of it. docs/how-to-test-faults.md explains the files.
// Reads files only; fault_test_command.hpp flies them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_expectations.hpp"
#include "cli/fleet_plan.hpp"

namespace skein::cli {

/// One file, ready to fly.
struct FaultTest {
  std::string name;  ///< of the file, without .yaml
  FleetPlan plan;    ///< with the faults; its options say how to fly it
  Expectations expect;

  bool needs_fault_free() const;
  /// Those that the file asks for.
  std::vector<Repeat> repeats() const;
};

/// True when a document is a fault test rather than a mere fault file.
bool is_fault_test(const ConfigNode& root);

/// @param assets  for scenarios that read files.
/// @throws InputError naming file, line, key and what would be right: also for what is wrong in the faults, the
///   scenario or the planner.
FaultTest load_fault_test(const std::filesystem::path& file, const std::optional<std::filesystem::path>& assets = {});

/// The fault tests of a folder by name, or the one file. @throws InputError when there are none.
std::vector<std::filesystem::path> fault_test_files(const std::filesystem::path& path);

}  // namespace skein::cli
