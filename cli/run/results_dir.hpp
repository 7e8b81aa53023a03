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
  /// Looks only; creates and changes nothing.
  /// @throws InputError when `dir` holds a result and `force` is not set, or is no folder.
  static void check(const std::filesystem::path& dir, bool force);

  /// Checks, creates the folder where it is missing, and removes what an earlier run left of the files that a run
  /// writes: a stale report must not pass for one of this run. Other files stay.
  /// Root's is closed to the agents of secured runs (process/files/closed_to_agents.hpp), for good.
  /// @throws InputError as check(), when another run is writing there, and when the disk has no room for a result.
  ResultsDir(const std::filesystem::path& dir, bool force);
  ~ResultsDir();
  ResultsDir(const ResultsDir&) = delete;
  ResultsDir& operator=(const ResultsDir&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< absolute

  /// Writes result.json, into room that was kept for it from the start on: a run that fills the disk has a result all
  /// the same. @returns what went wrong, for people; empty when it is written.
  std::string write_result(const std::string& text) const;

 private:
  void keep_room() const;
  void give_room() const;

  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace skein::cli
