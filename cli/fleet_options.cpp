// The command line of `skein fleet`.
#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"

namespace skein::cli {

void add_fleet(CLI::App& app, FleetOptions& fleet) {
  RunOptions& run = fleet.run;
  CLI::App* command = app.add_subcommand(
      "fleet", "Fly a fleet that another program advances step by step; skein.Fleet in Python starts this command");
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command->add_option("--planner", run.planner, "As for `skein run`; UAV=learner: the other program commands this UAV")
      ->capture_default_str();
  const CLI::Validator seconds(check_seconds, "");
  add_mission(*command, run, "; kill and pause are refused");
  command->add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
  command
      ->add_option("--agent-timeout", run.agent_timeout_s,
                   "Wall time that a program may take for one step; then Skein ends the fleet [s] (default 60)")
      ->check(CLI::Validator(check_timeout, ""));
  command->add_option("--agent", run.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command
      ->add_option("--log", run.log,
                   "How much a program (UAV, gcs, sim_server, ...) logs: UAV=trace, debug, info, warn, error or off")
      ->allow_extra_args(false);
  command->add_flag("--no-check{false}", run.check, "Do not ask the programs beforehand whether they can fly this");
  command->add_flag("--native", run.native, "Let libm use this CPU's fastest code (the digest is then this CPU's own)");
  command->add_option("--session", fleet.session, "Descriptor of the open socket to the program that steps the fleet")
      ->required();
  command->footer("See docs/how-to-python.md.");
}

}  // namespace skein::cli
