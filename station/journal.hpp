// The station's memory: an append-only file of everything that moved the tally, written before it is acknowledged, so
// that a station that was killed at any byte comes back with every report whose sender was told to forget it.
//
// File: "skeinjnl", the run (u64), then records one after the other; each is length (u32), the first 8 bytes of the
// body's SHA-256, body; all little-endian. A record that was cut off or does not match its hash ends the file. Not
// thread-safe.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/run_id.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

class Journal {
 public:
  /// Opens or creates the file and reads back what it holds of this run; what follows the last whole record is cut off.
  /// The journal of another run is none of ours: it is emptied. One in kNowhere (process/files/nowhere.hpp) is not
  /// kept.
  /// @throws std::runtime_error (file and reason) when the file cannot be opened, read, cut or begun.
  explicit Journal(const std::filesystem::path& file, RunId run = RunId::none);
  ~Journal();
  /// Whose journal a file is; nothing when it is no journal.
  static std::optional<RunId> run_of(const std::filesystem::path& file);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What the file held when it was opened, oldest first.
  const std::vector<TallyRecord>& replayed() const { return replayed_; }

  /// Appends the records of one step and hands them to the operating system: they survive the death of this process
  /// (not of the machine). Nothing is written for an empty list. A disk that refuses ends the journal, with its last
  /// whole record: from then on a station that is killed does not remember.
  /// @returns what went wrong, with the file's name, in the step in which it did; else an empty text.
  std::string append(std::span<const TallyRecord> records);

 private:
  void replay(RunId run);
  std::string write(std::span<const std::uint8_t> bytes);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<TallyRecord> replayed_;
  bool ended_ = false;   ///< by a disk that refused
  std::string trouble_;  ///< at the beginning of the file, to be told
};

}  // namespace skein::station
