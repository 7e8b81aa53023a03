// The fleets that fly on this host, as /proc and the results folders tell of them: processes by the command lines and
// variables that their launcher gave them. Those in one process or in containers are not among them.   Threads: any.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct RunningFleet {
  std::filesystem::path dir;                ///< its results folder
  std::string scenario;                     ///< as sim_server is told it
  int base_domain = 0;                      ///< its first DDS domain
  double agent_timeout_s = 60.0;            ///< after which it goes on without who does not answer; 0: never
  double lease_s = 0.0;                     ///< after which who gives no sign of life is gone for the others
  std::optional<std::size_t> uavs;          ///< its size, where it is not the scenario's
  std::string network;                      ///< of --network; empty: nothing leaves the host
  bool elsewhere = false;                   ///< in another network namespace, whose locks cannot be asked from here
  std::optional<pid_t> launcher;            ///< unless it is out of sight
  std::map<std::string, std::string> keys;  ///< folders of a secured fleet, by program
  std::map<std::string, pid_t> programs;    ///< "uav_agent-jurong"
};

/// Those of a user, by results folder.
std::vector<RunningFleet> running_fleets(uid_t user);

/// The only one of this user's, or the one that writes to `dir`.
/// @param command, option  for people: what asks, and how a folder is given. @throws InputError when there is none, or
///   the user must say which.
RunningFleet chosen_fleet(const std::optional<std::filesystem::path>& dir, const std::string& command,
                          const std::string& option);

/// A results folder as people would write it from here.
std::string shown_folder(const std::filesystem::path& dir);

/// How far it has written its trajectories [s]; nullopt: not yet.
std::optional<double> simulated_s(const RunningFleet& fleet);

/// "runs", "stopped", "debugged by gdb (process 12)".
std::string state_text(pid_t pid);

}  // namespace skein::cli
