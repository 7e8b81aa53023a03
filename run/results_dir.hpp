// The folder that a run writes its results to.   Threads: one for each object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "core/types.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// The results folder when the user names none: runs/<scenario>-<planner>-<seed> below the current folder.
std::filesystem::path default_results_dir(const std::string& scenario, const std::string& planner, std::uint64_t seed);

/// The first of `base`, `base`-2, `base`-3, ... that is not there yet, or is an empty folder: the results folder if the
/// user names none, so that a command can be repeated. Creates nothing.
std::filesystem::path free_results_dir(const std::filesystem::path& base);

/// The folder that the user names, or else a free one; with --force the usual one. Creates nothing. Another launcher
/// may take a free one at the same time: ResultsDir::take() finds out.
std::filesystem::path results_dir_of(const RunOptions& run, const std::string& scenario);

/// Creates a folder for results, with its parents, if it is missing. If root runs this, agents of secured runs can
/// never read the new folder (process/files/closed_to_agents.hpp). A folder that exists keeps owner and permissions.
/// @returns an error; none: the folder is there.
std::error_code make_results_folder(const std::filesystem::path& dir);

/// An entry that keeps a study or a hunt from taking an existing folder as a new folder of its own: the first by name.
/// Ignores hidden files, lost+found, the reserved space that a killed launcher has left, and logs: files with the
/// extension .log, .out or .err, and the file that this process prints to, as a job of Slurm does.
/// @returns its name; empty: there is none, no such folder, or a folder that cannot be read, as ResultsDir will report.
std::string foreign_entry(const std::filesystem::path& dir);

/// Treatment of files that are in a results folder already, under names of a run's files (run_folder::is_of_a_run()).
enum class Earlier {
  refuse,  ///< the folder is not taken: the files may belong to another user
  remove,  ///< they are deleted, so that a stale report does not pass for one of this run (--force)
  keep,    ///< they stay: a study's folder
};

/// Another launcher holds the folder now.
class FolderInUse : public InputError {
 public:
  using InputError::InputError;
};

/// Holds an existing results folder for one process. The kernel releases it when the process ends.
class FolderLock {
 public:
  /// @throws FolderInUse if a launcher holds the folder; InputError if the folder cannot be locked
  explicit FolderLock(const std::filesystem::path& dir);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_ = -1;
};

/// Holds a results folder for one run: two launchers never write to the same one.
class ResultsDir {
 public:
  /// Only checks; creates and changes nothing.
  /// @throws InputError if `dir` is not a folder, or if it holds a file that a run would write or delete, and `force`
  ///   is not set. The message names such a file.
  static void check(const std::filesystem::path& dir, bool force);

  /// Checks and locks the folder, creates it if it is missing (make_results_folder()), and deletes an earlier run's
  /// files if `earlier` says so. Other files stay.
  /// @throws InputError as check(), and if the disk has no room for a result; FolderInUse if another run is writing
  ///   there.
  ResultsDir(const std::filesystem::path& dir, Earlier earlier);
  ResultsDir(const std::filesystem::path& dir, bool force)
      : ResultsDir(dir, force ? Earlier::remove : Earlier::refuse) {}
  ~ResultsDir() { give_room(); }
  ResultsDir(const ResultsDir&) = delete;
  ResultsDir& operator=(const ResultsDir&) = delete;

  /// The folder of results_dir_of(), locked. If the user names no folder, and other runs take free ones at the same
  /// time, this is the first one that they leave. @throws as the constructor
  static std::unique_ptr<ResultsDir> take(const RunOptions& run, const std::string& scenario);

  /// A folder for the flights of one command, each in a folder of its own below it: `out`, else a free one as take()
  /// finds it, with `force` `usual` itself. The flights replace what is in their folders.
  /// @throws as the constructor; InputError if the folder holds anything but logs (foreign_entry()), without `force`.
  static std::unique_ptr<ResultsDir> take_for_flights(const std::optional<std::filesystem::path>& out,
                                                      const std::filesystem::path& usual, bool force);

  const std::filesystem::path& path() const { return path_; }    ///< absolute
  const std::filesystem::path& given() const { return given_; }  ///< as the constructor got it, for messages

  /// Writes result.json into disk space that the constructor has reserved: a run that fills the disk has a result, too.
  /// @returns an error message; empty: the file is written.
  std::string write_result(const std::string& text) const;

 private:
  static std::unique_ptr<ResultsDir> take_free(const std::filesystem::path& base);
  void keep_room() const;
  void give_room() const;

  std::filesystem::path given_, path_;
  std::optional<FolderLock> lock_;
};

}  // namespace skein::cli
