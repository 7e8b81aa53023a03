// --place: which of a fleet's programs run on which other hosts, and how those are reached.   Threads: any.
#pragma once

#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// A host and what runs there.
struct PlacedHost {
  std::string name;                   ///< as ssh, or Slurm, takes it
  std::vector<std::string> programs;  ///< agents, in the order given
  std::vector<std::string> connect;   ///< command line that starts `skein --host` there; both its streams are ours
};

/// @throws InputError for a UAV that the fleet does not have or that is placed twice, for programs that stay with the
///   launcher, for Slurm without an allocation, and for what a placed fleet cannot do.
std::vector<PlacedHost> read_placement(const FleetPlan& plan);

}  // namespace skein::cli
