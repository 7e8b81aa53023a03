// The machine that this program runs on, as a node of a sweep: it flies each flight as a `skein run` of its own.
#pragma once

#include "cli/console.hpp"
#include "cli/sweep/unit_run.hpp"

namespace skein::cli {

/// What this node is called: SKEIN_NODE, as Slurm calls it, or the host's name.
std::string node_name();

/// From one thread, which must live as long as the flights. @param console  must outlive it.
SweepNode this_machine(const Console& console);

/// A flight as `skein` is told it, in a folder of its own. @throws InputError for what is no flight.
std::vector<std::string> arguments_into(const SweepFlight& flight, const std::filesystem::path& out);

/// `skein --unit STUDY N`, which engines run on nodes. @returns its exit code.
int run_unit(const UnitOptions& options, const Console& console);

}  // namespace skein::cli
