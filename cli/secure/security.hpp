// Sets up a secured run (`skein run --secure`), and cleans up after it: each program gets keys and permissions in a
// folder that no other user can read and, if the launcher is root, each agent gets a user id of its own.
// docs/security.md says what this protects, and what not.   Threads: one.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/secure/user_ids.hpp"
#include "host/preflight.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

/// Texts of one program's security files (process/files/security_files.hpp), by their names.
using SecurityFiles = std::map<std::string, std::string>;

/// New security files for each program of a fleet, by program: keys and permissions of its own, and the fleet's
/// governance. @throws std::runtime_error when OpenSSL fails.
std::map<std::string, SecurityFiles> security_of(const FleetPlan& plan, int base_domain);

/// Checks, before anything starts, that agents with user ids of their own can read what they need.
/// @returns one such id, for the agents' own checks (--check); null: agents run as the launcher's user.
/// @throws InputError when they cannot read a program, an input file or the configuration, with path and remedy.
std::unique_ptr<UserIds> check_agents_access(const FleetPlan& plan);

/// Warnings: a sentence for each file with the scenario's ground truth that agents can read. If the launcher is not
/// root: one for all of the user's files.
std::vector<std::string> exposed_files(const FleetPlan& plan);

/// At its end, gives a folder the mode that the folder had at its beginning.
class KeptMode {
 public:
  explicit KeptMode(std::filesystem::path folder);
  ~KeptMode();
  KeptMode(const KeptMode&) = delete;
  KeptMode& operator=(const KeptMode&) = delete;

 private:
  std::filesystem::path folder_;
  std::filesystem::perms mode_;
};

/// Holds the keys of a run: they exist as long as this object.
class SecureRun {
 public:
  /// @param out  the results folder, which contains ground truth, too. If agents have user ids of their own, the folder
  ///   is closed to other users until the run is over.
  /// @throws InputError when agents cannot read their keys or too few user ids are free; std::runtime_error otherwise.
  SecureRun(const FleetPlan& plan, int base_domain, std::filesystem::path out);
  /// Removes all keys, and ends all processes that still run as an agent's user.
  ~SecureRun();
  SecureRun(const SecureRun&) = delete;
  SecureRun& operator=(const SecureRun&) = delete;

  const SecureFolders& folders() const { return folders_; }

  /// Copies files of agents with user ids of their own from their folders to the results folder: regular files that the
  /// agent owns, at most 1000 files and 64 MiB of each agent. Names that are not the program's own get its name in
  /// front. Call it after all programs have ended; it first kills processes that they left behind.
  /// @returns a sentence for each agent of which files were cut or left out.
  std::vector<std::string> collect() const;

 private:
  void make_folders(const FleetPlan& plan, int base_domain);

  ScratchDir scratch_;
  std::filesystem::path out_;
  KeptMode out_mode_;  ///< an object of its own, so that the constructor's errors restore the mode, too
  SecureFolders folders_;
  std::optional<UserIds> users_;  ///< one for each agent; nullopt: the launcher is not root
};

}  // namespace skein::cli
