// The radio messages of a run, from its recording: when each was sent, and when and at which node it arrived.
// Pure, except for reading the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/scenario.hpp"

namespace skein::signals {

/// Messages of one node on one topic.
struct RadioStream {
  std::string source, topic;  ///< "jurong", "/plan"
  bool operator==(const RadioStream&) const = default;
  auto operator<=>(const RadioStream&) const = default;
};

struct RadioArrival {
  RadioStream stream;
  std::string target;
  std::uint64_t sent = 0, arrives = 0;  ///< steps; a message arrives one step after it was sent, or later
  bool again = false;                   ///< a duplicate: the same message has arrived at `target` before
};

/// A debug value that a program published.
struct DebugValue {
  std::uint64_t step = 0;
  double value = 0.0;
};

struct RadioLog {
  std::map<RadioStream, std::vector<std::uint64_t>> sent;                        ///< steps, ascending
  std::vector<RadioArrival> arrivals;                                            ///< ordered by step of arrival
  std::map<std::pair<std::string, std::string>, std::vector<DebugValue>> debug;  ///< by UAV and name
};

/// @throws InputError when there is no recording (a run flown with `--record=none` has none), or it is damaged or cut
///   off.
RadioLog read_radio_log(const std::filesystem::path& dir, const Scenario& scenario);

}  // namespace skein::signals
