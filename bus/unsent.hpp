// Counts the samples that a program could not send. One counter serves all of its writers.   Threads: any.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace skein::bus {

class Unsent {
 public:
  /// Counts a sample; logs a warning for the first one on each topic.
  /// @param why  reason for the log: "its readers are too slow"
  void note(const std::string& topic, std::string_view why);
  /// Number of unsent samples so far, on all topics.
  std::uint64_t count() const { return count_; }

 private:
  std::atomic<std::uint64_t> count_ = 0;
  std::mutex mutex_;
  std::set<std::string> told_;  ///< topics that have had a warning
};

}  // namespace skein::bus
