// A program that only listens in one domain: it is no member, nobody waits for it, and what it hears has come by then.
// What it does not take in time is thrown away, the oldest first, and counted.
// Threads: vendors' threads bring samples; all else from the thread that made it.
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
  /// @param most  messages that wait to be taken. @throws InputError, std::runtime_error as Bus::join()
  ListenerNode(bus::Bus& bus, int domain, const std::vector<topics::WireTopic>& topics, std::size_t most);
  ListenerNode(const ListenerNode&) = delete;
  ListenerNode& operator=(const ListenerNode&) = delete;
  ~ListenerNode();

  struct Heard {
    std::string topic;  ///< on the wire
    bus::Sample sample;
  };
  /// The oldest message; nullopt when none has come in time.
  std::optional<Heard> next(std::chrono::milliseconds timeout);
  /// Whether somebody writes one of the topics.
  bool has_writers() const;
  /// Messages that were thrown away so far.
  std::uint64_t missed() const;

 private:
  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Heard> waiting_;
  std::uint64_t missed_ = 0;
  std::unique_ptr<bus::Participant> participant_;
  std::vector<std::unique_ptr<bus::Reader>> readers_;  ///< last: gone before what their callbacks use
};

}  // namespace skein::agent
