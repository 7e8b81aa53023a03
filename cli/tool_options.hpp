// Functions that add commands to the command line, and the options that several commands share.
#pragma once

#include "cli/command.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds the options of run, compose, keys and fleet that change a scenario's mission: scene seed, UAVs, assets,
/// duration, rules, conditions, faults.  @param faults_but  for the help: the faults that a fault file may not have
void add_mission(CLI::App& command, RunOptions& run, const std::string& faults_but = "");
/// Adds the options of run and fleet about the programs: which agent flies, what they log, checks, and their libm.
void add_programs(CLI::App& command, RunOptions& run);
/// Adds --record, of run, compose and the commands that fly many runs.
void add_record(CLI::App& command, std::string& record);
/// Adds the options for flying a study or a hunt beyond one process.
void add_sweep(CLI::App& command, SweepOptions& sweep);
/// @throws InputError for options that need another --executor.
void check_sweep(const SweepOptions& sweep);
/// Parses `skein --unit STUDY N`, which engines call, not users. @throws InputError
UnitOptions unit_options(const std::vector<std::string>& words);
/// Adds --network, of all commands that may let other hosts take part.
void add_network(CLI::App& command, std::optional<std::string>& network);

// Each of these adds a sub-command, whose options CLI11 parses into the second argument.
void add_run(CLI::App& app, RunOptions& run);
void add_compose(CLI::App& app, ComposeOptions& compose);
void add_keys(CLI::App& app, KeysOptions& keys);
void add_contest(CLI::App& app, StudyOptions& contest);
void add_compare(CLI::App& app, StudyOptions& study);
void add_hunt(CLI::App& app, HuntOptions& hunt);

// Each of these checks and completes a command's options once they are parsed. @param arguments  the whole command line
// @throws InputError for options that do not go together.
void finish_run(RunOptions& run, const std::vector<std::string>& arguments);
void finish_compose(ComposeOptions& compose, const std::vector<std::string>& arguments);
void finish_hunt(HuntOptions& hunt, const std::vector<std::string>& arguments);
void finish_study(StudyOptions& study, const std::vector<std::string>& arguments);

}  // namespace skein::cli
