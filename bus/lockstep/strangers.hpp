// Who writes where only members are heard: samples from outside the lock-step, which go nowhere. They are counted here,
// and told of once a topic and writer, however many there are.
// Threads: none of this is shared.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"

namespace skein::bus {

/// Why such a sample goes nowhere, for its sender.
inline constexpr const char* kUnheardReason = "from outside the lock-step: not heard; see docs/ros2.md";

class Strangers {
 public:
  /// A writer that is to be told of.
  struct Notice {
    std::string node;           ///< in whose domain
    std::string topic;          ///< on the wire
    std::uint64_t samples = 0;  ///< so far
  };
  /// Whether a participant is still a stranger: who joins a little later is none, nor who has just left.
  using IsStranger = std::function<bool(ParticipantId)>;

  /// A sample in `step`. Beyond a number of writers that no fleet needs, they are counted without a word of each.
  void add(const std::string& node, const std::string& topic, ParticipantId source, std::uint64_t step);
  /// Who has been a stranger since at least `patience` steps, by `step`, and has not been told of.
  std::vector<Notice> take_notices(std::uint64_t step, std::uint64_t patience, const IsStranger& is_stranger);
  /// Samples of strangers in a node's domain, of those that were told of.
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
  std::map<std::string, std::uint64_t> more_;  ///< samples of writers beyond the number that is kept, by node
};

/// A line for the user: in whose domain, on which topic, and that it has no effect.
std::string describe(const Strangers::Notice& notice);

}  // namespace skein::bus
