// The radio of a run, message by message, from its recording: when each was sent, and when it arrived at whom.
// Pure, but for the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario.hpp"

namespace skein::cli {

/// Messages of one node on one topic.
struct RadioStream {
  std::string source, topic;  ///< "jurong", "/plan"
  bool operator==(const RadioStream&) const = default;
  auto operator<=>(const RadioStream&) const = default;
};

struct RadioArrival {
  RadioStream stream;
  std::string target;
  std::uint64_t sent = 0, arrives = 0;  ///< steps; what is sent in one arrives in the next at the earliest
  bool again = false;                   ///< the same message has arrived there before
};

/// A value that a program published.
struct DebugValue {
  std::uint64_t step = 0;
  double value = 0.0;
};

struct RadioLog {
  std::map<RadioStream, std::vector<std::uint64_t>> sent;                        ///< steps, in their order
  std::vector<RadioArrival> arrivals;                                            ///< by step of arrival
  std::map<std::pair<std::string, std::string>, std::vector<DebugValue>> debug;  ///< by UAV and name
};

/// @throws InputError when there is no recording, or it is damaged: a run flown with `--record=none` has none.
RadioLog read_radio_log(const std::filesystem::path& dir, const Scenario& scenario);

}  // namespace skein::cli
