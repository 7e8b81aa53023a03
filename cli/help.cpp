#include "cli/help.hpp"

#include <iterator>

#include "cli/completion.hpp"
#include "core/config/config_files.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/agent_file.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

/// The agent program that flies by default.
std::filesystem::path default_agent() { return own_agent({}).value_or(program_dir() / programs::kAgent); }

/// The list of planners for the help, or the error of the agent program if it fails: help must not fail.
std::string planner_list() try {
  const std::filesystem::path agent = default_agent();
  std::string text = "\nPlanners: " + joined(planners_of(agent)) + "\n";
  return text + "With a program at the ground station: " + joined(ground_programs_of(agent)) + "\n";
} catch (const InputError& error) {
  return std::string("\nPlanners: ") + error.what() + "\n";
}

/// The names of the scenarios in files, and of the families of generated worlds.
std::vector<std::string> scenario_names() {
  std::vector<std::string> names = config_names(default_config_dir() / "scenarios");
  std::ranges::copy(drawn_world_names(), std::back_inserter(names));
  return names;
}

}  // namespace

int print_help(const HelpText& help, const Console& console) {
  console.out << help.text;
  if (help.names_planners) console.out << planner_list();
  return kExitDone;
}

int print_completions(const CompletionOptions& options, const Console& console) {
  const KnownNames known{&scenario_names, [] { return planners_of(default_agent()); }};
  for (const std::string& candidate : completions(options.words, known)) console.out << candidate << '\n';
  return kExitDone;
}

}  // namespace skein::cli
