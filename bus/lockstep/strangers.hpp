// Counts the samples of programs outside the lock-step on topics that only members may write. Such samples have no
// effect. There is one notice for each topic and writer.
// Not thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"

namespace skein::bus {

/// Reason why such a sample has no effect, for the user.
inline constexpr const char* kUnheardReason =
    "ignored: the sender does not take part in the lock-step; see docs/ros2.md";

class Strangers {
 public:
  /// A writer that the user should be told about.
  struct Notice {
    std::string node;           ///< radio node of the domain
    std::string topic;          ///< DDS name
    std::uint64_t samples = 0;  ///< so far
  };
  /// Whether a participant is outside the lock-step. A program that has joined since, or has just left, is not a
  /// stranger.
  using IsStranger = std::function<bool(ParticipantId)>;

  /// Counts a sample that arrived in `step`. Beyond 256 writers, further writers' samples are counted without notices.
  void add(const std::string& node, const std::string& topic, ParticipantId source, std::uint64_t step);
  /// Notices about writers that have been strangers for at least `patience` steps at `step`; one per topic and writer.
  std::vector<Notice> take_notices(std::uint64_t step, std::uint64_t patience, const IsStranger& is_stranger);
  /// Number of samples in a node's domain by writers that had a notice, or came after the 256th.
  std::uint64_t unheard(const std::string& node) const;

 private:
  struct Key {
    std::string node, topic;
    ParticipantId source = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Writer {
    std::uint64_t first_step = 0, samples = 0;
    bool told = false;
  };
  std::map<Key, Writer> writers_;
  std::map<std::string, std::uint64_t> more_;  ///< samples of writers beyond the first 256, by node
};

/// A line for the user: in whose domain, on which topic, and that it has no effect.
std::string describe(const Strangers::Notice& notice);

}  // namespace skein::bus
