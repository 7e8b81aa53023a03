#include "cli/options.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "cli/option_checks.hpp"
#include "cli/place_options.hpp"
#include "cli/tool_options.hpp"
#include "cli/view_options.hpp"
#include "core/text/number_checks.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/threads.hpp"

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

void add_programs(CLI::App& command, RunOptions& run) {
  command.add_option("--agent", run.agent,
                     "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command
      .add_option("--log", run.log,
                  "How much a program (UAV, gcs, sim_server, ...) logs: UAV=trace, debug, info, warn, error or off")
      ->allow_extra_args(false);
  command.add_flag("--no-check{false}", run.check, "Do not ask the programs beforehand whether they can fly this");
  command.add_flag("--native", run.native, "Let libm use this CPU's fastest code (the digest is then this CPU's own)");
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
  command.add_option(
      "--conditions", run.conditions,
      "Wind, odometry errors, batteries and so on: none, breezy or harsh for all parts, or by part: wind=harsh");
  command.add_option("--faults", run.faults, "Fault file (YAML): what goes wrong, and when" + faults_but);
}

namespace {

/// The options of run, compose and keys that say what is flown, and how.
void add_flight_options(CLI::App* command, RunOptions& run) {
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command
      ->add_option(
          "--planner", run.planner,
          "Planner of all UAVs, and UAV=NAME,... for single UAVs; NAME@AGENT: a planner of this agent program; "
          "py:FILE: a planner in Python; exec:CMD: a program of yours; ros:PACKAGE/EXECUTABLE: a ROS 2 node")
      ->capture_default_str();
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  command
      ->add_option("--seed", run.seed,
                   "Seed of the random effects; with 0, starts, command latency and LiDARs have none")
      ->check(seed)
      ->capture_default_str();
  add_mission(*command, run);
  command->add_option("--dds", run.dds, "DDS vendor: cyclonedds, fastdds or mixed")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
      ->capture_default_str();
  command->add_option("--clock", run.clock, "lockstep (repeatable), or realtime[:FACTOR]")
      ->check(CLI::Validator(check_clock, "CLOCK"))
      ->capture_default_str();
  command
      ->add_option("--agent-timeout", run.agent_timeout_s,
                   "Wall time to wait for a program's answer before it counts as lost [s] (default 60)")
      ->check(CLI::Validator(check_timeout, ""));
  command
      ->add_option(
          "--lease", run.lease_s,
          "Time of silence after which DDS counts a program as gone [s]; must be longer than any interruption of the "
          "network (default: 10 in containers and for programs that you start by hand; otherwise longer than any wait)")
      ->check(CLI::Range(1, kLongestLease_s));
  command->add_flag("--secure", run.secure, "Enforce the isolation of agents: certificates, encryption, user ids");
  command->add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
}

/// The options of run and compose for the results.
void add_result_options(CLI::App* command, RunOptions& run) {
  command->add_option("--out", run.out,
                      "Results folder (default runs/<scenario>-<planner>-<seed>, or with -2, -3... if that is taken)");
  command->add_flag("--force", run.force, "Overwrite an existing result and other files that are in the way");
  add_record(*command, run.record);
  const std::string keep_maps =
      "Keep each UAV's map over time for the replay, in maps-UAV.mcap: a snapshot every 10 s of simulated time, or "
      "with =SECONDS at this interval, from 1 to 3600";
  command->add_flag("--keep-maps{10}", keep_maps)
      ->check(CLI::Validator(check_maps_period, ""))
      ->each([&run](const std::string& seconds) { run.keep_maps_s = parse_number(seconds); });
  command->add_flag("--no-oracle{false}", run.attainable, "Do not compute the attainable score");
  command->add_flag("--no-report{false}", run.report, "Do not write report.html");
}

/// Refuses the options that need separate processes. @throws InputError
void check_one_process(const RunOptions& run) {
  if (!run.one_process) return;
  const auto refuse = [](bool given, const std::string& option, const std::string& why) {
    if (given) throw InputError(option + " needs processes: " + why + "; leave out --one-process");
  };
  refuse(!run.debug.empty(), "--debug", "the program that you debug is one of its own");
  refuse(run.cores, "--cores", "there would be one core file for all programs");
  refuse(run.domain.has_value(), "--domain", "a fleet in one process uses no DDS domain");
  refuse(run.place.at.has_value(), "--place", "they run on several hosts");
}

}  // namespace

void add_run(CLI::App& app, RunOptions& run) {
  CLI::App* command = app.add_subcommand("run", "Fly a fleet through a scenario and write its results");
  add_flight_options(command, run);
  add_programs(*command, run);
  command
      ->add_flag("--one-process", run.one_process,
                 "Run all programs in one process, without DDS: the same result in less time")
      ->excludes("--dds");
  command
      ->add_option("--threads", run.threads,
                   "Number of threads with --one-process; results do not depend on it (default: SKEIN_THREADS, else "
                   "the available cores, at most one per UAV)")
      ->needs("--one-process")
      ->check(CLI::Range(1, kMostThreads));
  command
      ->add_option("--debug", run.debug,
                   "Debug this program while the fleet waits: a UAV, gcs, sim_server, comm_router or station. TOOL: "
                   "gdb, or pdb for a planner in Python, in this terminal; gdbserver:PORT; wait (until you attach a "
                   "debugger); or a command that Skein puts before the program's command line (default: gdb; without a "
                   "terminal, Skein prints a command for you to start)")
      ->type_name("UAV[=TOOL]")
      ->allow_extra_args(false)
      ->excludes("--agent-timeout");  // with --debug the fleet waits until Ctrl-C, or until the debugged program ends
  command
      ->add_option("--break-at", run.break_at_s,
                   "Stop the debugged programs in the exchange before this simulated time [s]")
      ->check(CLI::Validator(check_seconds, ""))
      ->needs("--debug");
  command
      ->add_option("--break-on", run.break_on,
                   "Like --break-at, before this event first happens to the first UAV of --debug; to find the time, "
                   "Skein flies the fleet once beforehand")
      ->check(CLI::IsMember(std::vector<std::string>(kBreakEvents.begin(), kBreakEvents.end())))
      ->needs("--debug")
      ->excludes("--break-at");
  command
      ->add_option("--break-from", run.break_from,
                   "Results folder of the same flight, in which Skein looks up the time instead of flying beforehand")
      ->needs("--break-on");
  command->add_flag("--cores", run.cores, "Keep the core file of a crashed program in the results folder");
  command->add_option("--domain", run.domain, "First DDS domain of the fleet (default: the first free block)");
  command
      ->add_option(
          "--ros-env", run.ros_env,
          "Do not fly: print settings for a shell with this UAV's ROS 2 nodes, for eval. They are for the fleet that "
          "flies now (select one of several by --out), or with --domain for a fleet that you start later")
      ->type_name("UAV");
  add_network(*command, run.network);
  add_place_options(*command, run.place);
  add_result_options(command, run);
  add_view_options(*command, run.view);
  command->footer(
      "Examples:\n"
      "  skein run towers --planner kios\n"
      "  skein run cranes --planner patrol,jurong=hover --seed 7 --out runs/mine\n"
      "  skein run towers --planner kios --faults config/faults/station_outage.yaml\n"
      "  skein run towers --agent build/my_agent --planner orbit\n"
      "  skein run towers --planner orbit@team_a/agent,jurong=kios@team_b/agent\n"
      "  skein run towers --planner hover,jurong=exec:./my_program\n"
      "  skein run towers --planner kios --debug jurong=gdb\n"
      "  skein run towers --planner kios --view\n"
      "  skein run towers --planner kios --place jurong=host1,raffles=host2");
}

void finish_run(RunOptions& run, const std::vector<std::string>& arguments) {
  check_one_process(run);
  check_view(run);
  run.command = "skein " + shell_line(arguments);
}

void add_compose(CLI::App& app, ComposeOptions& compose) {
  CLI::App* command =
      app.add_subcommand("compose", "Write a docker-compose file for a fleet in containers, or fly this fleet");
  add_flight_options(command, compose.run);
  CLI::Option* up = command->add_flag("--up", compose.up,
                                      "Start the containers, follow the run, and remove the containers at its end");
  command->add_option("--file", compose.file, "File to write (default: standard output)")->excludes(up);
  CLI::Option* const stack =
      command
          ->add_flag("--stack", compose.stack,
                     "Write a file for `docker stack`, which spreads the fleet over several engines")
          ->excludes(up);
  command
      ->add_option("--place", compose.run.place.at,
                   "With --stack: UAV=NODE,...: the swarm nodes on which these UAVs fly")
      ->type_name("UAV=NODE,...")
      ->needs(stack);
  command->add_option("--image", compose.images, "UAV=IMAGE: run this image of yours instead of the UAV's agent")
      ->allow_extra_args(false);
  command->add_option("--subnet", compose.subnet,
                      "IPv4 network that Skein divides among the fleet's networks, such as 172.30.0.0/20 (default: the "
                      "engine's address pools)");
  command
      ->add_option("--debug", compose.run.debug,
                   "Stop this program (UAV, gcs or a server) before its first step while the fleet waits: gdb opens "
                   "gdb in its container, in this terminal (needs --up); wait waits until you attach a debugger "
                   "(default: gdb with --up in a terminal)")
      ->type_name("UAV[=gdb|wait]")
      ->allow_extra_args(false)
      ->excludes("--agent-timeout");
  command->add_option("--build-folder", compose.build, "Fly the programs of this build, not those of the images");
  add_result_options(command, compose.run);
  add_view_options(*command, compose.run.view);
  command->footer(
      "Examples:\n"
      "  skein compose towers --planner kios --up\n"
      "  skein compose towers --planner kios --view 8080 --up\n"
      "  skein compose towers --planner kios --file compose.yaml\n"
      "  skein compose towers --planner hover,jurong=orbit --image jurong=my-agent --up\n\n"
      "docs/how-to-containers.md shows how to build images; docs/containers.md explains each part of the file.");
}

void finish_compose(ComposeOptions& compose, const std::vector<std::string>& arguments) {
  check_view(compose.run);
  compose.run.command = "skein " + shell_line(arguments);
}

void add_keys(CLI::App& app, KeysOptions& keys) {
  CLI::App* command = app.add_subcommand("keys", "Make the certificates and permissions of a secured fleet");
  add_flight_options(command, keys.run);
  command->add_option("--domain", keys.run.domain, "First DDS domain (default 1)");
  command->add_option("--out", keys.out, "New folder, with a folder for each program")->required();
  command->footer("Example:\n  skein keys towers --out keys");
}

}  // namespace skein::cli
