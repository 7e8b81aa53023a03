// Which programs a run consists of, and the command line of each.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/debug/debuggee.hpp"
#include "cli/host/program_host.hpp"
#include "cli/options.hpp"
#include "cli/planner_spec.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario_reader.hpp"

namespace skein::cli {

/// All that is decided before a run starts.
/// The page of a run that is watched.
struct WatchedBy {
  int listener = -1;                  ///< a socket that browsers connect to
  std::filesystem::path key, script;  ///< files: the page's key, and its script
};

struct FleetPlan {
  RunOptions options;
  Scenario scenario;
  std::vector<UavPlanner> planners;                 ///< fleet order
  std::filesystem::path bin_dir;                    ///< where the programs are
  FaultPlan faults;                                 ///< of --faults
  std::optional<UavPlanner> ground = {};            ///< what runs at the ground station: a strategy or "exec:CMD"
  std::optional<std::filesystem::path> agent = {};  ///< flies in the place of uav_agent what names no agent of its own
  std::vector<Debuggee> debug = {};                 ///< what the user looks into
  std::map<std::string, std::string> log_levels = {};  ///< by program, of --log
  std::optional<WatchedBy> watched = {};               ///< none: nobody watches
  std::uint64_t run = 0;  ///< what the programs of one run know each other by (draw_run_id())
};

/// What flies a UAV, or runs at the ground station. @param program  of an agent
const UavPlanner& planner_of(const FleetPlan& plan, const std::string& program);

/// The program that a UAV's on-board software is, or the one at the ground station: its planner's, else the fleet's.
/// @param program  of an agent
std::filesystem::path agent_file(const FleetPlan& plan, const std::string& program);

/// All agent programs of a fleet, each once, in fleet order; of users' commands alone, the one that would fly.
std::vector<std::filesystem::path> agent_files(const FleetPlan& plan);

/// The program that is home to a whole fleet with those agents.
std::filesystem::path fleet_file(const FleetPlan& plan);

/// Why a fleet cannot fly in one process, for people; nullopt: it can.
std::optional<std::string> needs_processes(const FleetPlan& plan);

/// What a program of a secured fleet is given (cli/secure/security.hpp).
struct SecureFolder {
  std::filesystem::path keys;  ///< its key, certificate and permissions
  std::filesystem::path out;   ///< where it writes instead of the results folder; empty: there
  std::optional<UserId> user;  ///< as whom it runs; nullopt: as the launcher
};
using SecureFolders = std::map<std::string, SecureFolder>;  ///< by program

/// A number that no other run has. It decides nothing and is in no digest.
std::uint64_t draw_run_id();

/// What a run says of its scenario.
LoadOptions load_options(const RunOptions& options);

/// Loads the scenario and takes the planners apart. @throws InputError for whatever is wrong in them.
FleetPlan plan_fleet(const RunOptions& options, const std::filesystem::path& bin_dir);

/// Where the sibling programs are: SKEIN_BIN_DIR, else this executable's own folder.
std::filesystem::path program_dir();

/// World, ground station and one domain a UAV.
int domain_count(const FleetPlan& plan);

/// The only DDS domain that an agent joins.
int agent_domain(const FleetPlan& plan, const std::string& program, int base_domain);

/// DDS vendor by program. `mixed` deals the vendors out in turn: sim_server, comm_router, station, then the UAVs.
std::map<std::string, std::string> dds_vendors(const FleetPlan& plan);

/// What one of our programs is told wherever it runs; where it writes, its run, its keys and its network come on top.
std::vector<std::string> program_arguments(const FleetPlan& plan, const std::string& program, int base_domain);

/// The whole fleet in the order in which it starts; what the user starts himself under --debug is left out.
/// @param secure  of all programs, or of none
std::vector<ProgramSpec> fleet_programs(const FleetPlan& plan, int base_domain, const std::filesystem::path& out,
                                        const SecureFolders& secure = {});

/// The process that is home to all of them, under --one-process.
ProgramSpec shared_process(const FleetPlan& plan, const std::filesystem::path& out);

/// Whether the program of this UAV, or of "gcs", flies: all of them, but in some runs that are flown again.
bool takes_part(const FleetPlan& plan, const std::string& member);

/// True when this program is a user's command (`--planner exec:CMD`) in the place of uav_agent.
bool is_exec(const FleetPlan& plan, const std::string& program);

/// What to type to run an agent in gdb (a user's command: as it is, with its environment).
std::string debug_command(const FleetPlan& plan, const std::string& program, int base_domain,
                          const std::filesystem::path& out, const SecureFolders& secure = {});

/// The file that a program of the fleet is; of a user's command the shell.
std::filesystem::path program_file(const FleetPlan& plan, const std::string& program);

/// Programs that only validate (--check): sim_server, then the agent of each different planner. A user's command is not
/// asked: nothing is known about it.
/// @param scratch folder for their logs. @param agent_user  as whom agents will run
std::vector<ProgramSpec> check_programs(const FleetPlan& plan, const std::filesystem::path& scratch,
                                        const std::optional<UserId>& agent_user = {});

}  // namespace skein::cli
