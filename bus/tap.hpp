// A listener, such as a recording, that receives the samples that a program writes and reads, in lock-step order.
// No program waits for the listener, and no result depends on it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "bus/bus.hpp"

namespace skein::bus {

/// Listens to one topic in one domain.
struct Ear {
  std::function<void(std::span<const std::uint8_t> payload)> hear{};  ///< empty: nothing listens to the topic
  bool also_unread = false;  ///< the writer builds samples for it even if no program reads them
};

class Tap {
 public:
  virtual ~Tap() = default;
  /// @param node  the domain's node: a UAV's name, "gcs", or "" for the world. @returns an ear; must not outlive this.
  virtual Ear ear(const std::string& node, const TopicSpec& topic) = 0;
  /// @returns a replacement of `handler` for samples that members send; by default, it passes each sample to the ear
  /// first.
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
