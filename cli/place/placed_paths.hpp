// Which files of this host a program needs on another host, and the program's command line with their paths there. An
// agent's host gets neither meshes nor interest points.   Pure except for reading files; threads: one.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Folders of a host, as the host reports them.
struct HostFolders {
  std::filesystem::path bin, config;  ///< of the Skein that is installed there
  std::filesystem::path root;         ///< temporary; contains all files that the host writes
};

/// What a host needs to start a program.
struct PlacedProgram {
  std::map<std::filesystem::path, std::filesystem::path> files;  ///< path on this host, by path there
  std::vector<std::string> argv;
  std::map<std::string, std::string> variables;  ///< in addition to the environment of all programs
  std::filesystem::path keys;                    ///< folder there; empty: the run is not secured
};

/// @param spec  as the program would start here. @param network  SKEIN_NETWORK of a user's command; other programs have
///   --network in their command line.
PlacedProgram place_program(const FleetPlan& plan, const ProgramSpec& spec, const HostFolders& there,
                            const std::string& network);

}  // namespace skein::cli
