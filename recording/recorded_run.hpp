// A recording in memory, ordered by time: which sample was sent on which topic and when, for a replay. Immutable; any
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "recording/mcap/records.hpp"

namespace skein::recording {

/// One recorded sample.
struct Said {
  std::string topic;           ///< name in the recording: "/jurong/command/gimbal"
  std::uint32_t sequence = 0;  ///< number of the sample at its source; 0 if it has none
  mcap::Bytes payload;
};

class RecordedRun {
 public:
  /// @param wanted  whether the samples of a recorded topic are kept.
  /// @throws InputError if the file is not a complete, undamaged recording.
  RecordedRun(const std::filesystem::path& file, const std::function<bool(const std::string& topic)>& wanted);

  /// The kept samples of this time, in recorded order.
  const std::vector<Said>& at(Tick tick) const;
  /// Calls `visit` for each kept sample, in order of time.
  void each(const std::function<void(Tick, const Said&)>& visit) const;
  /// Time of the last recorded sample, kept or not.
  Tick end() const { return end_; }

 private:
  std::map<Tick, std::vector<Said>> by_time_;
  Tick end_ = 0;
};

}  // namespace skein::recording
