// The station's memory: an append-only file of everything that changed the tally. The station writes a report here
// before it acknowledges it. So a station that was killed, at any byte, comes back with every acknowledged report.
//
// File: "skeinjnl", the run (u64), then records one after the other; each is length (u32), the first 8 bytes of the
// body's SHA-256, body; all little-endian. A record that was cut off or does not match its hash ends the file. Not
// thread-safe.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/run/run_id.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

class Journal {
 public:
  /// Opens or creates the file and reads back what it holds of this run; what follows the last whole record is cut off.
  /// The journal of another run is emptied. In kNowhere (process/files/nowhere.hpp) nothing is kept.
  /// @throws std::runtime_error (file and reason) when the file cannot be opened, read or cut. If its first bytes
  /// cannot be written, the first append() says so instead.
  explicit Journal(const std::filesystem::path& file, RunId run = RunId::none);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The records that the file had when it was opened, oldest first.
  const std::vector<TallyRecord>& replayed() const { return replayed_; }

  /// Appends the records of one step and hands them to the operating system: they survive the death of this process
  /// (not of the machine). Nothing is written for an empty list. A write error ends the journal with its last whole
  /// record: a restarted station then does not know what came later.
  /// @returns the error, with the file's name, once: in the step in which it occurred; else an empty text.
  std::string append(std::span<const TallyRecord> records);

 private:
  void replay(RunId run);
  std::string write(std::span<const std::uint8_t> bytes);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<TallyRecord> replayed_;
  bool ended_ = false;       ///< nothing is written: an earlier write failed, or the file is in kNowhere
  std::string write_error_;  ///< why the first bytes could not be written, for the first append()
};

}  // namespace skein::station
