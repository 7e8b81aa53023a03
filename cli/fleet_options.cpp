// The command line of `skein fleet`.
#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"

namespace skein::cli {

void add_fleet(CLI::App& app, FleetOptions& fleet) {
  RunOptions& run = fleet.run;
  CLI::App* command = app.add_subcommand("fleet", "A fleet that a program steps: skein.Fleet in Python starts it");
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command->add_option("--planner", run.planner, "As for `skein run`; UAV=learner: that program says what the UAV does")
      ->capture_default_str();
  const CLI::Validator seconds(check_seconds, "");
  add_mission(*command, run, "; no kills, no pauses");
  command->add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
  command
      ->add_option("--agent-timeout", run.agent_timeout_s,
                   "Wall time that a program may take for one turn before the fleet is given up [s] (default 60)")
      ->check(seconds);
  command->add_option("--agent", run.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command->add_option("--log", run.log, "UAV=LEVEL: how much this program logs (or gcs, sim_server...)")
      ->allow_extra_args(false);
  command->add_flag("--no-check{false}", run.check, "Do not ask the programs first whether they can fly this");
  command->add_flag("--native", run.native, "Let libm use this CPU's fastest code (the digest is then this CPU's own)");
  command->add_option("--session", fleet.session, "Socket of the program that steps it, open under this descriptor")
      ->required();
  command->footer("docs/how-to-python.md tells how a fleet is stepped.");
}

}  // namespace skein::cli
