// Takes samples from a backend's threads to the one thread that owns a program's state.
// Handlers run inside dispatch(), one at a time, in order of arrival; samples of one writer on one topic never
// overtake each other. With SKEIN_CHAOS=N in the environment arrivals of *different* topics and writers are held back
// and reordered at random (seeded by N and the process): a correct program's result must not depend on it.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

class Inbox {
 public:
  Inbox();  ///< chaos as the environment says
  explicit Inbox(unsigned chaos);
  ~Inbox();
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  using Handler = std::function<void(Sample&&)>;
  /// Creates a reader on `participant` whose samples reach `handler` through this inbox.
  /// The reader must be destroyed before the inbox.
  std::unique_ptr<Reader> subscribe(Participant& participant, const TopicSpec& topic, Handler handler);

  /// Runs handlers for all that has arrived; waits for at least one arrival, but no longer than `timeout`.
  /// @returns false when nothing arrived in time or wake() was called.
  bool dispatch(std::chrono::milliseconds timeout);
  /// Makes a waiting dispatch() return; from any thread, and from signal handlers' helper threads.
  void wake();
  /// Hands in something from another thread (a control pipe, a timer) to run inside dispatch(), in order of arrival.
  void post(std::function<void()> work);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::bus
