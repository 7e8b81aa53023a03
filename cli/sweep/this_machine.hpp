// The machine that this program runs on, as a node of a sweep: it flies each flight as a `skein run` of its own.
#pragma once

#include "cli/console.hpp"
#include "cli/sweep/unit_run.hpp"
#include "cli/sweep_options.hpp"

namespace skein::cli {

/// The name of this node: SKEIN_NODE, else Slurm's name for it (SLURMD_NODENAME), else the host's name.
std::string node_name();

/// Threads: one, which must live as long as the flights. @param console  must outlive the returned node.
SweepNode this_machine(const Console& console);

/// Executes `skein --unit STUDY N`, which an engine runs on a node. @returns the exit code.
int run_unit(const UnitOptions& options, const Console& console);

}  // namespace skein::cli
