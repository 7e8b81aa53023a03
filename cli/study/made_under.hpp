// All that the result of a flight depends on but its seed: another build, other files or another draw of a world make
// another text of it. Reads the programs and the files.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/run/fleet_plan.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// In or over which a fleet flies, for people: "one process", or a vendor.
std::string medium_of(const FleetPlan& fleet);

/// Reads each program once, so that many fleets cost little. One thread.
class MadeUnder {
 public:
  /// Version, digests of the programs and of the agent's file, scenario, planner, digest of their files, medium.
  /// @throws InputError for a file that cannot be read.
  Json of(const FleetPlan& fleet);

 private:
  std::string agent_digest(const FleetPlan& fleet);
  const std::string& digest(const std::filesystem::path& agent);

  std::string programs_;                                  ///< of those that fly with every planner
  std::map<std::filesystem::path, std::string> digests_;  ///< of agents
};

}  // namespace skein::cli
