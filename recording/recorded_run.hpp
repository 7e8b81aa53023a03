// A recording, taken apart by time: who said what when, to be said again. Immutable; any thread.
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
  std::string topic;  ///< as recorded: "/jurong/command/gimbal"
  std::uint32_t sequence = 0;
  mcap::Bytes payload;
};

class RecordedRun {
 public:
  /// @param wanted  of a recorded topic: whether its samples are kept.
  /// @throws InputError when the file is no whole recording.
  RecordedRun(const std::filesystem::path& file, const std::function<bool(const std::string& topic)>& wanted);

  /// What was said at this time, in the order in which it was taken.
  const std::vector<Said>& at(Tick tick) const;
  /// All that was kept, in the order of time.
  void each(const std::function<void(Tick, const Said&)>& visit) const;
  /// Of the last sample.
  Tick end() const { return end_; }

 private:
  std::map<Tick, std::vector<Said>> by_time_;
  Tick end_ = 0;
};

}  // namespace skein::recording
