// Takes samples from a backend's threads to the one thread that owns a program's state.
// Handlers run inside dispatch(), one at a time, in order of arrival; samples of one writer on one topic never
// overtake each other. With SKEIN_CHAOS=N in the environment arrivals of *different* topics and writers are held back
// and reordered at random (seeded by N and the process): a correct program's result must not depend on it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "bus/bus.hpp"

namespace skein::bus {

/// Waking a thread costs more than handling a sample. In lock-step most samples are of no use before the one that
/// says how many there are: those topics are silent, and only the others ring.
enum class Bell { rings, silent };

class Inbox {
 public:
  /// Chaos as the environment says. @param run  whose messages are taken; see note_foreign().
  explicit Inbox(RunId run = RunId::none);
  explicit Inbox(unsigned chaos, RunId run = RunId::none);
  ~Inbox();
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  using Handler = std::function<void(Sample&&)>;
  /// Creates a reader on `participant` whose samples reach `handler` through this inbox.
  /// The reader must be destroyed before the inbox.
  std::unique_ptr<Reader> subscribe(Participant& participant, const TopicSpec& topic, Handler handler,
                                    Bell bell = Bell::rings);

  /// Runs handlers for all that has arrived, silent or not; waits until that is worth it, but no longer than `timeout`.
  /// @param rings  wait for so many samples of topics that ring; 0: for any sample. Posted work is never waited over.
  ///   Who asks for n must know that fewer cannot change anything, or it sleeps through what it waits for.
  /// @returns false when nothing arrived in time or wake() was called.
  bool dispatch(std::chrono::milliseconds timeout, std::size_t rings = 0);
  /// True when dispatch() would not wait. For tests that may not let time pass.
  bool ready(std::size_t rings = 0);
  /// Makes a waiting dispatch() return; from any thread, and from signal handlers' helper threads.
  void wake();
  /// Hands in something from another thread (a control pipe, a timer) to run inside dispatch(), in order of arrival.
  void post(std::function<void()> work);

  /// While it is deaf all samples that arrive are lost, as they are to a process that is stopped for long. Posted work
  /// is not.
  void set_deaf(bool deaf);

  /// Counts a sample that was no message of its topic's type (typed.hpp); tells of the first one on each topic.
  /// Inside dispatch(), or on its thread.
  void note_malformed(const std::string& topic, const Sample& sample);
  /// Malformed samples so far, on all topics.
  std::uint64_t malformed() const { return malformed_; }

  /// The run that this program takes part in: lock-step messages of any other are dropped (typed.hpp).
  RunId run() const { return run_; }
  /// Tells of the first message of another run on each topic.
  void note_foreign(const std::string& topic, const Sample& sample, RunId run);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  RunId run_ = RunId::none;
  std::uint64_t malformed_ = 0;
  std::set<std::string> told_;          ///< topics with malformed samples
  std::set<std::string> told_foreign_;  ///< topics with messages of other runs
};

}  // namespace skein::bus
