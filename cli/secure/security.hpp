// What a secured run (`skein run --secure`) is given before it starts, and takes back at its end: keys and permissions
// of each program in a folder that nobody else can read, and, when the launcher is root, a user id of its own for each
// agent. What this protects, and what not: docs/security.md. From one thread.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"
#include "cli/run/preflight.hpp"
#include "cli/secure/user_ids.hpp"

namespace skein::cli {

/// Texts of one program's security files (process/files/security_files.hpp), by their names.
using SecurityFiles = std::map<std::string, std::string>;

/// Of each program of a fleet: keys of its own, rules of the fleet's. New ones at each call.
std::map<std::string, SecurityFiles> security_of(const FleetPlan& plan, int base_domain);

/// A new file that only its owner can read. @throws std::system_error
void write_private_file(const std::filesystem::path& file, const std::string& text);

/// Before anything starts: what can be wrong with a secured fleet's agents under user ids of their own.
/// @returns one such id, for the agents' own checks; null when agents run as the launcher.
/// @throws InputError when they cannot read the programs or the configuration; it names the path and what helps.
std::unique_ptr<UserIds> check_agents_access(const FleetPlan& plan);

/// Files that hold the scenario's ground truth and that agents can read all the same, each as a warning.
std::vector<std::string> exposed_files(const FleetPlan& plan);

/// While it lives, the keys of a run exist.
class SecureRun {
 public:
  /// @param out  the results folder, which holds ground truth too: closed to others until the run is over, if agents
  ///   are such others.
  /// @throws InputError when the agents cannot get at their keys; std::runtime_error when something fails.
  SecureRun(const FleetPlan& plan, int base_domain, std::filesystem::path out);
  /// Removes all keys, and ends whatever still runs as an agent's user.
  ~SecureRun();
  SecureRun(const SecureRun&) = delete;
  SecureRun& operator=(const SecureRun&) = delete;

  const SecureFolders& folders() const { return folders_; }

  /// Copies what agents under their own user ids wrote from their own folders to the results folder, once all programs
  /// have ended (and what they left behind has been): plain files of theirs, under names that begin with the program's,
  /// as many and as much of them as is sensible. @returns what was left behind or cut, a sentence for each agent that
  /// it befell.
  std::vector<std::string> collect() const;

 private:
  void make_folders(const FleetPlan& plan, int base_domain);

  ScratchDir scratch_;
  std::filesystem::path out_;
  std::filesystem::perms out_perms_;
  SecureFolders folders_;
  std::optional<UserIds> users_;  ///< one an agent, if the launcher may choose
};

}  // namespace skein::cli
