// Describes everything on which a flight's result depends, except its seed, as JSON. The JSON changes whenever the
// programs, an input file or a generated world changes. Reads the programs and the files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "process/json_text.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// How a fleet's programs communicate, for messages: "one process", or the DDS vendor.
std::string medium_of(const FleetPlan& fleet);

/// Digest of the files that a flight reads beside programs and scenario: those of the scene, planners in Python, files
/// with parameters, those that the commands of `exec:` name, and the fault file. nullopt: there are none.
/// @throws InputError if a file cannot be read.
std::optional<std::string> input_files_digest(const FleetPlan& fleet);

/// Reads each program only once, also for many fleets. One thread.
class MadeUnder {
 public:
  /// Version, digests of the server programs and of the agent programs, scenario, planner, digest of the input files,
  /// medium. @throws InputError if a file cannot be read.
  Json of(const FleetPlan& fleet);

 private:
  std::string agent_digest(const FleetPlan& fleet);
  const std::string& digest(const std::filesystem::path& agent);

  std::string programs_;                                  ///< digest of the programs that are the same for all planners
  std::map<std::filesystem::path, std::string> digests_;  ///< by file of an agent program
};

}  // namespace skein::cli
