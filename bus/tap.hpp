// Somebody who hears, in the order of the lock-step, what a program writes and reads there: a recording. Nothing waits
// for it, nothing depends on it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "bus/bus.hpp"

namespace skein::bus {

/// Of one topic, in one domain.
struct Ear {
  std::function<void(std::span<const std::uint8_t> payload)> hear{};  ///< empty: it is not listened to
  bool also_unread = false;  ///< samples that nobody else reads are built for it, too
};

class Tap {
 public:
  virtual ~Tap() = default;
  /// @param node  whose domain it is: a UAV's name, "gcs", or "" for the world's. @returns what must not outlive this.
  virtual Ear ear(const std::string& node, const TopicSpec& topic) = 0;
  /// What stands in the place of the `handler` of what members send; by default it is heard first.
  virtual OnSample taken(const std::string& node, const TopicSpec& topic, OnSample handler) {
    auto hear = ear(node, topic).hear;
    if (!hear) return handler;
    return [hear = std::move(hear), handler = std::move(handler)](Sample&& sample) {
      hear(sample.payload);
      handler(std::move(sample));
    };
  }
};

}  // namespace skein::bus
