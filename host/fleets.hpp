// Finds the fleets that fly on this host: reads command lines and environments of processes from /proc, and recognises
// those of a fleet's programs. Does not find fleets in one process or in containers.   Threads: any.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct RunningFleet {
  std::filesystem::path dir;                ///< results folder
  std::string scenario;                     ///< from sim_server's command line
  int base_domain = 0;                      ///< first DDS domain of its block
  double agent_timeout_s = 60.0;            ///< wall time until a silent program is lost; 0: no limit
  double lease_s = 0.0;                     ///< after it, DDS considers a silent program gone
  std::optional<std::size_t> uavs;          ///< from --uavs; nullopt: the scenario's number of UAVs
  std::string network;                      ///< value of --network; empty: DDS stays on this host
  bool elsewhere = false;                   ///< in another network namespace: its domain locks are not visible here
  std::optional<pid_t> launcher;            ///< nullopt: this process cannot see it
  std::map<std::string, std::string> keys;  ///< key folders of a secured fleet, by program
  std::map<std::string, pid_t> programs;    ///< process ids, by program: "uav_agent-jurong"
};

/// @returns the fleets of a user whose sim_server runs, sorted by results folder.
std::vector<RunningFleet> running_fleets(uid_t user);

/// @returns the fleet that writes to `dir`; without `dir`, this user's only fleet. Prefers fleets in this network
///   namespace. @param command, option  for messages: the command that asks, and its option that takes `dir`.
/// @throws InputError if there is no such fleet, or more than one.
RunningFleet chosen_fleet(const std::optional<std::filesystem::path>& dir, const std::string& command,
                          const std::string& option);

/// A results folder for messages: relative if it is below the working directory, else unchanged.
std::string shown_folder(const std::filesystem::path& dir);

/// Simulated time [s] of the last complete row in the fleet's trajectories.csv; nullopt: there is none yet.
std::optional<double> simulated_s(const RunningFleet& fleet);

/// State of a process: "runs", "stopped" or "debugged by gdb (process 12)".
std::string state_text(pid_t pid);

}  // namespace skein::cli
