#include "cli/flight_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/run_arguments.hpp"
#include "core/text/number_checks.hpp"
#include "core/text/text.hpp"

namespace skein::cli {

void add_network(CLI::App& command, std::optional<std::string>& network) {
  command
      .add_option(
          "--network", network,
          "Let programs on other hosts take part: over this interface, over those that the DDS vendor chooses (all), "
          "or as a YAML file (or its text in braces) says for each domain (default: nothing leaves this host)")
      ->envname(kNetworkVariable)
      ->type_name("[IFACE|all|FILE]")
      ->expected(0, 1)
      ->default_str("all");
}

void add_record(CLI::App& command, std::string& record) {
  command
      .add_flag("--record{all}", record,
                "What recording.mcap has. run: poses, commands, captures, radio messages and events; all (or --record "
                "alone): also every topic that a program reads; clouds: also LiDAR clouds that no program reads; "
                "messages: only radio messages and debug values; none: no recording")
      ->check(CLI::IsMember({"none", "messages", "run", "all", "clouds"}))
      ->default_str(record);
}

void add_programs(CLI::App& command, RunOptions& run, const std::string& more_checks) {
  command.add_option("--agent", run.agent,
                     "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command
      .add_option("--log", run.log,
                  "How much a program (UAV, gcs, sim_server, ...) logs: UAV=trace, debug, info, warn, error or off")
      ->allow_extra_args(false);
  command.add_flag(
      "--no-check{false}", run.check,
      "Do not check before the flight whether the programs accept scenario, planners and faults" + more_checks);
  command.add_flag("--native", run.native,
                   "Let libm use this CPU's fastest code (the digest then depends on the CPU model)");
}

void add_mission(CLI::App& command, RunOptions& run, const std::string& faults_but) {
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  command.add_option("--scene-seed", run.scene_seed, "Number of the variant of a procedural scenario")->check(seed);
  command
      .add_option("--uavs", run.uavs, "Fleet size N: the scenario's first N UAVs; if it has fewer, also copies of them")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  command.add_option("--assets", run.assets,
                     "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command.add_option("--duration", run.duration_s, "Mission time [s], instead of the scenario's")->check(seconds);
  command.add_option("--rules", run.rules, "Preset of rules, instead of the scenario's: contest, paper or reference");
  command.add_option("--conditions", run.conditions,
                     "Wind, odometry errors, batteries and so on, instead of the scenario's: none, breezy or harsh for "
                     "all parts, or by part: wind=harsh");
  command.add_option("--faults", run.faults, "Fault file (YAML): what goes wrong, and when" + faults_but);
}

void add_flight_options(CLI::App& command, RunOptions& run) {
  command.add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command
      .add_option("--planner", run.planner,
                  "Planner of all UAVs, and UAV=NAME,... for single UAVs; NAME@AGENT: a planner of this agent program; "
                  "py:FILE: a planner in Python; exec:CMD: a program of yours; ros:PACKAGE/EXECUTABLE: a ROS 2 node")
      ->capture_default_str();
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  command
      .add_option("--seed", run.seed,
                  "Seed of the random effects; 0: without those of start places, command latency and LiDARs")
      ->check(seed)
      ->capture_default_str();
  add_mission(command, run);
  command.add_option("--dds", run.dds, "DDS vendor: cyclonedds, fastdds or mixed")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
      ->capture_default_str();
  command
      .add_option(
          "--clock", run.clock,
          "lockstep: as fast as possible, and repeatable; realtime[:FACTOR]: FACTOR simulated seconds per second (1 "
          "if it is left out)")
      ->check(CLI::Validator(check_clock, "CLOCK"))
      ->capture_default_str();
  command
      .add_option("--agent-timeout", run.agent_timeout_s,
                  "Wall time to wait for a program's answer before it counts as lost [s] (default 60)")
      ->check(CLI::Validator(check_timeout, ""));
  command
      .add_option(
          "--lease", run.lease_s,
          "Time of silence after which DDS counts a program as gone [s]; must be longer than any interruption of the "
          "network (default: 10 in containers and for programs that you start by hand; otherwise longer than any wait)")
      ->check(CLI::Range(1, kLongestLease_s));
  command.add_flag("--secure", run.secure, "Enforce the isolation of agents: certificates, encryption, user ids");
  command.add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
}

void add_result_options(CLI::App& command, RunOptions& run) {
  command.add_option("--out", run.out,
                     "Results folder (default runs/<scenario>-<planner>-<seed>, or with -2, -3... if that is taken)");
  command.add_flag("--force", run.force, "Overwrite an existing result and other files that are in the way");
  add_record(command, run.record);
  const std::string keep_maps =
      "Keep each UAV's map over time for the replay, in maps-UAV.mcap: a snapshot every 10 s of simulated time, or "
      "with =SECONDS at this interval, from 1 to 3600";
  command.add_flag("--keep-maps{10}", keep_maps)
      ->check(CLI::Validator(check_maps_period, ""))
      ->each([&run](const std::string& seconds) { run.keep_maps_s = parse_number(seconds); });
  command.add_flag("--no-oracle{false}", run.attainable, "Do not compute the attainable score");
  command.add_flag("--no-report{false}", run.report, "Do not write report.html");
}

}  // namespace skein::cli
