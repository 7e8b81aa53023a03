// The log of a hunt: the outcome of each case as a line, so that an interrupted hunt can continue. One thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "cli/hunt/trial.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {

class HuntLog {
 public:
  /// Subfolder of a hunt's folder that keeps the finds and logs of earlier hunts there, in numbered folders.
  static constexpr const char* kEarlier = "earlier";

  /// Continues the hunt in `dir` if it has the same settings; begins one if the folder holds none. Locks the folder:
  /// two hunts never write to the same one. A folder that exists keeps owner and permissions.
  /// @param settings  everything on which the search depends. @param force  begins anew. The finds of the earlier hunt
  ///   are never deleted: they move into kEarlier, with its log and settings; if that fails, the earlier hunt stays as
  ///   it was. A hunt without finds is deleted. Also takes a folder of other files, unless one of them has the name of
  ///   a file of a hunt.
  /// @throws InputError if the folder holds another hunt or other files (foreign_entry()), if it cannot be written, or
  ///   if a line of the log is damaged; FolderInUse if another hunt writes there. An incomplete last line, as after a
  ///   kill, is removed.
  HuntLog(const std::filesystem::path& dir, const Json& settings, bool force);

  /// Capsules of an earlier hunt that the constructor has moved into kEarlier, sorted by name.
  const std::vector<std::filesystem::path>& kept() const { return kept_; }
  /// Outcomes by number of the case; nullopt: not flown.
  const std::vector<std::optional<TrialOutcome>>& outcomes() const { return outcomes_; }
  /// @param flown  text of the case. @throws InputError if the log has another case with this number.
  void check(std::size_t index, const std::string& flown) const;
  /// @throws std::runtime_error if the log cannot be written, as on a full disk.
  void add(std::size_t index, const std::string& flown, TrialOutcome outcome);

 private:
  void read_lines();
  static std::vector<std::filesystem::path> keep_finds(const std::filesystem::path& dir);
  void keep(std::size_t index, const std::string& flown, TrialOutcome outcome);

  const ResultsDir dir_;  ///< the folder, locked
  const std::filesystem::path file_;
  std::vector<std::optional<TrialOutcome>> outcomes_;
  std::vector<std::string> flown_;
  std::vector<std::filesystem::path> kept_;
  std::ofstream lines_;
};

}  // namespace skein::cli
