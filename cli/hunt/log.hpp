// What a hunt has flown, line by line, so that it can go on where it was stopped. One thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "cli/hunt/trial.hpp"

namespace skein::cli {

class HuntLog {
 public:
  /// Goes on in a folder where the same search has been, else begins there.
  /// Within the folder of a hunt: what hunts before it found there, numbered.
  static constexpr const char* kEarlier = "earlier";

  /// @param settings  what the search depends on. @param force  begins anew. The finds of the earlier hunt are never
  ///   deleted: they move into kEarlier, with its log.
  /// @throws InputError when the folder is of another search, or a line of its log is damaged. One that was cut off at
  ///   the end, as by a kill, goes.
  HuntLog(const std::filesystem::path& dir, const Json& settings, bool force);

  /// Capsules of an earlier hunt that moved into kEarlier, by name.
  const std::vector<std::filesystem::path>& kept() const { return kept_; }
  /// What came of the cases that were flown, by number.
  const std::vector<std::optional<TrialOutcome>>& outcomes() const { return outcomes_; }
  /// @throws InputError when what was flown under this number was something else.
  void check(std::size_t index, const std::string& flown) const;
  void add(std::size_t index, const std::string& flown, TrialOutcome outcome);

 private:
  void read_lines();
  static std::vector<std::filesystem::path> keep_finds(const std::filesystem::path& dir);
  void keep(std::size_t index, const std::string& flown, TrialOutcome outcome);

  const std::filesystem::path file_;
  std::vector<std::optional<TrialOutcome>> outcomes_;
  std::vector<std::string> flown_;
  std::vector<std::filesystem::path> kept_;
  std::ofstream lines_;
};

}  // namespace skein::cli
