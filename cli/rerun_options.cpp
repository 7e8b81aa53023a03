// The command lines of the commands that fly a recorded run again.
#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"

namespace skein::cli {
namespace {

void add_reflight(CLI::App& command, Reflight& reflight) {
  command.add_option("RUN", reflight.run, "Its results folder")->required();
  command.add_option("--agent", reflight.agent, "Agent program with planners of your own");
  command
      .add_option("--dds", reflight.dds,
                  "Fly processes over this DDS vendor: cyclonedds, fastdds or mixed (default: one process where it can "
                  "be; the result is the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command.add_option("--out", reflight.out, "Results folder (default: a new one in RUN)");
  command.add_flag("--force", reflight.force, "Overwrite an existing result");
}

}  // namespace

void add_rerun(CLI::App& app, RerunOptions& rerun) {
  CLI::App* command = app.add_subcommand(
      "rerun", "Let one UAV's software think again what it thought in a recorded run, without the fleet");
  add_reflight(*command, rerun.reflight);
  command->add_option("--uav", rerun.uav, "Whose")->required();
  command->add_option("--planner", rerun.planner, "Another planner, which hears what that one heard");
  command
      ->add_option("--debug", rerun.reflight.debug, "UAV[=TOOL]: run it under gdb or another tool, as `skein run` does")
      ->allow_extra_args(false)
      ->excludes("--dds");
  command->footer(
      "Examples:\n"
      "  skein rerun runs/towers-kios-0 --uav jurong\n"
      "  skein rerun runs/towers-kios-0 --uav jurong --agent build/my_agent\n\n"
      "Exit codes: 0 it says what it said then, 1 it does not. docs/how-to-rerun.md has more.");
}

void add_fork(CLI::App& app, ForkOptions& fork) {
  CLI::App* command = app.add_subcommand("fork", "Let a recorded run go on differently from some time on");
  add_reflight(*command, fork.reflight);
  command->add_option("--at", fork.at_s, "Simulated time from which on the fleet's software has its say again [s]")
      ->required()
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--planner", fork.planner, "UAV=NAME,...: who takes over; it listens from the start on");
  command->footer("Example:\n  skein fork runs/towers-kios-0 --at 120 --planner jurong=patrol");
}

}  // namespace skein::cli
