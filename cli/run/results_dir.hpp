// The folder that a run writes its results to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/command.hpp"

namespace skein::cli {

/// Where a run goes when the user names no folder: runs/<scenario>-<planner>-<seed> below the current folder.
std::filesystem::path default_results_dir(const std::string& scenario, const std::string& planner, std::uint64_t seed);

/// The first of `base`, `base`-2, `base`-3, ... that is not there yet, or is an empty folder: where a run goes if the
/// user names no folder, so that a command can be repeated. Creates nothing.
std::filesystem::path free_results_dir(const std::filesystem::path& base);

/// The folder that the user names, or else a free one; with --force the usual one. Creates nothing.
std::filesystem::path results_dir_of(const RunOptions& run, const std::string& scenario);

/// Holds a results folder for one run: two launchers never write to the same one.
class ResultsDir {
 public:
  /// Only checks; creates and changes nothing.
  /// @throws InputError if `dir` holds a result and `force` is not set, or if it is not a folder.
  static void check(const std::filesystem::path& dir, bool force);

  /// Checks and locks the folder, creates it if it is missing, and deletes an earlier run's files from it, so that a
  /// stale report does not pass for one of this run. Other files stay.
  /// If root runs this, agents of secured runs can never read the folder again (process/files/closed_to_agents.hpp).
  /// @throws InputError as check(), and if another run is writing there or the disk has no room for a result.
  ResultsDir(const std::filesystem::path& dir, bool force);
  ~ResultsDir();
  ResultsDir(const ResultsDir&) = delete;
  ResultsDir& operator=(const ResultsDir&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< absolute

  /// Writes result.json into disk space that the constructor has reserved: a run that fills the disk has a result, too.
  /// @returns an error message; empty: the file is written.
  std::string write_result(const std::string& text) const;

 private:
  void keep_room() const;
  void give_room() const;

  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace skein::cli
