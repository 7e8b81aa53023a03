// Plans a run: its scenario, planners, faults and agent programs. fleet_programs.hpp makes the command lines from it.
// Units: s.   Threads: one.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "debug/debuggee.hpp"
#include "host/program_host.hpp"
#include "run/planner_spec.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// The web page on which users watch a run.
struct WatchedBy {
  int listener = -1;                  ///< socket that browsers connect to; -1: none (the station is in a container)
  std::filesystem::path key, script;  ///< files: the page's key, and its script
};

/// Everything that is decided before a run starts.
struct FleetPlan {
  RunOptions options;
  Scenario scenario;
  std::vector<UavPlanner> planners;                    ///< fleet order
  std::filesystem::path bin_dir;                       ///< folder of the programs
  FaultPlan faults;                                    ///< from --faults
  std::optional<UavPlanner> ground = {};               ///< program at the ground station: a strategy or "exec:CMD"
  std::optional<std::filesystem::path> agent = {};     ///< the fleet's own agent program; nullopt: uav_agent
  std::vector<Debuggee> debug = {};                    ///< debugged programs
  std::map<std::string, std::string> log_levels = {};  ///< by program, from --log
  std::optional<WatchedBy> watched = {};               ///< nullopt: the run has no page
  std::uint64_t run = 0;  ///< id by which programs recognise those of their own run (draw_run_id())
};

/// The planner of a UAV or of the ground station. @param program  name of an agent: "uav_agent-jurong"
const UavPlanner& planner_of(const FleetPlan& plan, const std::string& program);

/// File of the agent program of a UAV or of the ground station: the one that its planner names, else the fleet's.
/// @param program  name of an agent
std::filesystem::path agent_file(const FleetPlan& plan, const std::string& program);

/// Files of all agent programs of a fleet, each once, in fleet order. If all agents are users' commands: only the
/// fleet's own agent program.
std::vector<std::filesystem::path> agent_files(const FleetPlan& plan);

/// The file of the program that runs a whole fleet with the first of these agent programs in one process.
std::filesystem::path fleet_file(const FleetPlan& plan);

/// The reason why a fleet cannot fly in one process, as a message; nullopt: it can.
std::optional<std::string> needs_processes(const FleetPlan& plan);

/// Folders and user of a program in a secured fleet (cli/secure/security.hpp).
struct SecureFolder {
  std::filesystem::path keys;  ///< holds the program's key, certificate and permissions
  std::filesystem::path out;   ///< where it writes; empty: the results folder
  std::optional<UserId> user;  ///< user to run as; nullopt: the launcher's
};
using SecureFolders = std::map<std::string, SecureFolder>;  ///< by program

/// Draws a random id for a run, not 0. It does not influence the run and is in no digest.
std::uint64_t draw_run_id();

/// The part of a run's options that changes how its scenario is loaded.
LoadOptions load_options(const RunOptions& options);

/// What decides whether a fleet flies in one process.
enum class Processes {
  as_given,         ///< RunOptions::one_process
  one_if_possible,  ///< only what the fleet needs (needs_processes())
  one_if_large,     ///< as given, but a fleet that is too large for DDS flies in one process
};

/// Loads the scenario and resolves all options into a plan. Its `options.one_process` says how the fleet flies.
/// @throws InputError if one of the options is not valid.
FleetPlan plan_fleet(const RunOptions& options, const std::filesystem::path& bin_dir,
                     Processes processes = Processes::as_given);

/// Folder of the programs: SKEIN_BIN_DIR, else the folder of this executable.
std::filesystem::path program_dir();

/// Number of DDS domains: world, ground station, and one for each UAV.
int domain_count(const FleetPlan& plan);

/// The only DDS domain that an agent joins.
int agent_domain(const FleetPlan& plan, const std::string& program, int base_domain);

/// DDS vendor by program; "inproc" in one process. `mixed` alternates the vendors in this order: sim_server,
/// comm_router, station, agents of the UAVs, program at the ground station.
std::map<std::string, std::string> dds_vendors(const FleetPlan& plan);

/// Whether the agent of this UAV, or of "gcs", runs. False only in a rerun that replays its recorded output instead.
bool takes_part(const FleetPlan& plan, const std::string& member);

/// Whether this program is a user's command (exec: or ros:) in place of uav_agent.
bool is_exec(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
