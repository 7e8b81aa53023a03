// The options of a flight that several commands share: run, compose, keys, fleet, studies and doctor.
#pragma once

#include <optional>
#include <string>

#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds the options of run, compose and keys that say what is flown, and how.
void add_flight_options(CLI::App& command, RunOptions& run);
/// Adds the options of run and compose for the results.
void add_result_options(CLI::App& command, RunOptions& run);
/// Adds the options of run, compose, keys and fleet that change a scenario's mission: scene seed, UAVs, assets,
/// duration, rules, conditions, faults.  @param faults_but  for the help: the faults that a fault file may not have
void add_mission(CLI::App& command, RunOptions& run, const std::string& faults_but = "");
/// Adds the options of run and fleet about the programs: which agent flies, what they log, checks, and their libm.
/// @param more_checks  for the help: what the checks before the flight check besides the programs
void add_programs(CLI::App& command, RunOptions& run, const std::string& more_checks = "");
/// Adds --record, of run, compose and the commands that fly many runs.
void add_record(CLI::App& command, std::string& record);
/// Adds --network, of all commands that may let other hosts take part.
void add_network(CLI::App& command, std::optional<std::string>& network);

}  // namespace skein::cli
