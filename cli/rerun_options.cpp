// The command lines of the commands that fly a recorded run again.
#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"

namespace skein::cli {
namespace {

void add_reflight(CLI::App& command, Reflight& reflight) {
  command.add_option("RUN", reflight.run, "Results folder of the recorded run")->required();
  command.add_option("--agent", reflight.agent, "Agent program with planners of your own");
  command
      .add_option("--dds", reflight.dds,
                  "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: in one process where "
                  "possible; the result is the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command.add_option("--out", reflight.out, "Results folder (default: a new one in RUN)");
  command.add_flag("--force", reflight.force, "Overwrite an existing result");
}

}  // namespace

void add_rerun(CLI::App& app, RerunOptions& rerun) {
  CLI::App* command = app.add_subcommand(
      "rerun", "Run one UAV's software again with the inputs of a recorded run, and compare its output");
  add_reflight(*command, rerun.reflight);
  command->add_option("--uav", rerun.uav, "UAV whose software runs (gcs: the program at the ground station)")
      ->required();
  command->add_option("--planner", rerun.planner, "Run this planner instead of the recorded one, with the same inputs");
  command
      ->add_option("--debug", rerun.reflight.debug,
                   "UAV[=TOOL]: run the UAV's program in gdb or with another tool, as for `skein run`")
      ->allow_extra_args(false)
      ->excludes("--dds");
  command->footer(
      "Examples:\n"
      "  skein rerun runs/towers-kios-0 --uav jurong\n"
      "  skein rerun runs/towers-kios-0 --uav jurong --agent build/my_agent\n\n"
      "Exit codes: 0 the output is the recorded one, 1 it differs. See docs/how-to-rerun.md.");
}

void add_fork(CLI::App& app, ForkOptions& fork) {
  CLI::App* command =
      app.add_subcommand("fork", "Fly a recorded run again, and continue it differently from a given time on");
  add_reflight(*command, fork.reflight);
  command
      ->add_option(
          "--at", fork.at_s,
          "Simulated time [s]: before it, the recorded output of all programs counts, from then on their new output")
      ->required()
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--planner", fork.planner,
                      "UAV=NAME,...: these planners take over at that time; they receive their inputs from the start");
  command->footer(
      "Example:\n  skein fork runs/towers-kios-0 --at 120 --planner jurong=patrol\n\nSee docs/how-to-rerun.md.");
}

}  // namespace skein::cli
