// --place: which programs of a fleet run on which other hosts, and how the launcher connects to these.   Threads: any.
#pragma once

#include <string>
#include <vector>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// A host and the programs that run there.
struct PlacedHost {
  std::string name;                   ///< for ssh or Slurm
  std::vector<std::string> programs;  ///< agents, in the order given
  std::vector<std::string> connect;   ///< command line that starts `skein --host` there, with its stdin and stdout here
};

/// Reads --place. @returns none without it.
/// @throws InputError for a UAV that the fleet does not have or that is placed twice, for programs that stay with the
///   launcher, for Slurm without an allocation, and together with --debug.
std::vector<PlacedHost> read_placement(const FleetPlan& plan);

}  // namespace skein::cli
