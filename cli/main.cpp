// The skein command: parses the command line, calls the command, and turns errors into a message and an exit code.
#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "cli/actions.hpp"
#include "cli/completion.hpp"
#include "cli/duration_variable.hpp"
#include "cli/hunt/capsule_run.hpp"
#include "cli/option_checks.hpp"
#include "cli/options.hpp"
#include "cli/place/host_service.hpp"
#include "cli/standard_output.hpp"
#include "cli/sweep/this_machine.hpp"
#include "core/config/config_files.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "host/environment.hpp"
#include "host/preflight.hpp"
#include "host/program_start.hpp"
#include "process/files/path_error.hpp"
#include "results/run_folder.hpp"
#include "run/agent_file.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

/// The agent program that flies by default.
std::filesystem::path default_agent() { return own_agent({}).value_or(program_dir() / programs::kAgent); }

/// The list of planners for the help. If the agent program fails, its error takes the place of the list.
std::string planner_list() try {
  const std::filesystem::path agent = default_agent();
  std::string text = "\nPlanners: " + joined(planners_of(agent)) + "\n";
  return text + "With a program at the ground station: " + joined(ground_programs_of(agent)) + "\n";
} catch (const InputError& error) {
  return std::string("\nPlanners: ") + error.what() + "\n";
}

/// The names of scenarios in files, and of procedurally drawn ones.
std::vector<std::string> scenario_names() {
  std::vector<std::string> names = config_names(default_config_dir() / "scenarios");
  names.insert(names.end(), kDrawnWorlds.begin(), kDrawnWorlds.end());
  return names;
}

/// Executes a command: one overload for each.
struct Execute {
  const Console& console;
  int operator()(const RunOptions& options) const {
    return is_capsule(options) ? run_capsule(options, console) : run_fleet(options, console);
  }
  int operator()(const TestOptions& options) const { return run_tests(options, console); }
  int operator()(const HuntOptions& options) const { return run_hunt(options, console); }
  int operator()(const BlameOptions& options) const { return blame(options, console); }
  int operator()(const CheckPlannerOptions& options) const { return check_planner(options, console); }
  int operator()(const CheckOptions& options) const { return check_files(options, console); }
  int operator()(const ConvertOptions& options) const { return convert_files(options, console); }
  int operator()(const SceneOptions& options) const { return export_scene(options); }
  int operator()(const BenchOptions& options) const { return run_bench(options, console); }
  int operator()(const OracleOptions& options) const { return consult_oracle(options, console); }
  int operator()(const DiffOptions& options) const { return diff_runs(options, console); }
  int operator()(const DoctorOptions& options) const { return consult_doctor(options); }
  int operator()(const ComposeOptions& options) const { return compose_fleet(options, console); }
  int operator()(const KeysOptions& options) const { return make_keys(options, console); }
  int operator()(const MergeOptions& options) const { return merge_reports(options, console); }
  int operator()(const ReportOptions& options) const { return make_reports(options, console); }
  int operator()(const ReplayOptions& options) const { return replay_run(options, console); }
  int operator()(const RerunOptions& options) const { return rerun(options, console); }
  int operator()(const ForkOptions& options) const { return fork_run(options, console); }
  int operator()(const FleetOptions& options) const { return step_fleet(options, console); }
  int operator()(const PsOptions&) const { return list_fleets(console); }
  int operator()(const AttachOptions& options) const { return attach_to(options, console); }
  int operator()(const StudyOptions& options) const { return run_study(options, console); }
  int operator()(const PackOptions& options) const { return pack_programs(options, console); }
  int operator()(const HostOptions&) const { return serve_host(); }
  int operator()(const UnitOptions& options) const { return run_unit(options, console); }
  int operator()(const HelpText& help) const {
    console.out << help.text;
    if (help.names_planners) console.out << planner_list();
    return kExitDone;
  }
  int operator()(const CompletionOptions& options) const {
    const KnownNames known{&scenario_names, [] { return planners_of(default_agent()); }};
    for (const std::string& candidate : completions(options.words, known)) console.out << candidate << '\n';
    return kExitDone;
  }
};

/// The command of these arguments. A mission that names no duration gets that of the environment, except in a capsule,
/// which has all that is flown.
Command command_of(const std::vector<std::string>& arguments) {
  Command command = parse_command_line(arguments);
  const auto* run = std::get_if<RunOptions>(&command);
  if (run != nullptr && is_capsule(*run)) return command;
  return parse_command_line(with_duration_of_environment(arguments));
}

int execute(const std::vector<std::string>& arguments, const Console& console) try {
  const Command command = command_of(arguments);
  if (!std::holds_alternative<HelpText>(command) && !std::holds_alternative<CompletionOptions>(command)) {
    check_paths(arguments);
  }
  const int code = std::visit(Execute{console}, command);
  if (const std::string lost = lost_output(); code == kExitDone && !lost.empty()) throw std::runtime_error(lost);
  return code;
} catch (const InputError& error) {
  console.err << error.what() << std::endl;
  return kExitBadInput;
} catch (const Interrupted&) {
  return kExitInterrupted;
} catch (const std::filesystem::filesystem_error& error) {
  console.err << "skein: " << path_error_text(error) << std::endl;
  return is_wrong_path(error) ? kExitBadInput : kExitProcessFailed;
} catch (const std::exception& error) {
  console.err << "skein: " << error.what() << std::endl;
  return kExitProcessFailed;
}

}  // namespace
}  // namespace skein::cli

int main(int argc, char** argv) {
  skein::cli::settle_process();
  std::signal(SIGXFSZ, SIG_IGN);  // at a file size limit the write fails, as on a full disk
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  return skein::cli::execute({argv + 1, argv + argc},
                             {std::cout, std::cerr, terminal, terminal && skein::cli::owns_terminal()});
}
