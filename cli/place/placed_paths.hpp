// What a host must have of this one's files for a program, and the program's command line with the paths that they have
// there. An agent's host gets neither meshes nor interest points.   Pure but for reading files; one thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// Folders of a host, as it tells them.
struct HostFolders {
  std::filesystem::path bin, config;  ///< of its Skein
  std::filesystem::path root;         ///< all that it writes is below
};

/// A program as a host starts it.
struct PlacedProgram {
  std::map<std::filesystem::path, std::filesystem::path> files;  ///< here, by where they are to be there
  std::vector<std::string> argv;
  std::map<std::string, std::string> variables;  ///< on top of a fleet's environment there
  std::filesystem::path keys;                    ///< folder there, of a secured run; else empty
};

/// @param spec  as it would start here. @param network  for a user's command, which is not told it otherwise.
PlacedProgram place_program(const FleetPlan& plan, const ProgramSpec& spec, const HostFolders& there,
                            const std::string& network);

}  // namespace skein::cli
