// Reads topics of one DDS domain without being a member of the lock-step: no step waits for it. It queues a limited
// number of messages; if the queue is full, it discards and counts the oldest.
// Threads: the DDS vendor's threads fill the queue; call all functions from the thread that constructed it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "core/topics.hpp"

namespace skein::agent {

class ListenerNode {
 public:
  /// @param most  length of the queue, at least 1. @throws InputError, std::runtime_error as Bus::join()
  ListenerNode(bus::Bus& bus, int domain, const std::vector<topics::WireTopic>& topics, std::size_t most);
  ListenerNode(const ListenerNode&) = delete;
  ListenerNode& operator=(const ListenerNode&) = delete;
  ~ListenerNode();

  struct Heard {
    std::string topic;  ///< name on the wire
    bus::Sample sample;
  };
  /// Takes the oldest message, and waits for one if there is none; nullopt after the timeout [ms of wall time].
  std::optional<Heard> next(std::chrono::milliseconds timeout);
  /// Whether one of the readers is matched with a writer.
  bool has_writers() const;
  /// Number of messages discarded so far.
  std::uint64_t missed() const;

 private:
  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Heard> waiting_;
  std::uint64_t missed_ = 0;
  std::unique_ptr<bus::Participant> participant_;
  std::vector<std::unique_ptr<bus::Reader>> readers_;  ///< destroyed before what their callbacks use
};

}  // namespace skein::agent
