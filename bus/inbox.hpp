// Passes samples from a backend's threads to the thread that owns a program's state. Handlers run inside dispatch(),
// one at a time, in order of arrival; samples of one writer on one topic keep their order. With SKEIN_CHAOS=N in the
// environment, the inbox delays and reorders arrivals of *different* topics and writers at random (seeded by N and the
// process id): the result of a correct program does not depend on this.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "bus/bus.hpp"

namespace skein::bus {

/// Whether a sample of a topic wakes a thread that waits in dispatch(); waking costs more than handling a sample. In
/// lock-step a program cannot use most samples before the message that says how many there are: topics of such samples
/// are silent, the other topics ring.
enum class Bell { rings, silent };

class Inbox {
 public:
  /// Takes the seed of the chaos from SKEIN_CHAOS. @param run  the program's run; see note_foreign().
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

  /// Waits until enough samples have arrived, at most for `timeout`, then runs the handlers of all arrived samples,
  /// silent or not.
  /// @param rings  number of samples of ringing topics to wait for; 0: any sample is enough. Posted work ends the wait.
  ///   Pass n only if fewer than n samples cannot change anything, otherwise dispatch() waits too long.
  /// @returns false when nothing arrived in time or wake() was called.
  bool dispatch(std::chrono::milliseconds timeout, std::size_t rings = 0);
  /// True when dispatch() would not wait. For callers that must not wait: LockstepNode::poll(), tests.
  bool ready(std::size_t rings = 0);
  /// Makes a waiting dispatch() return; from any thread, and from signal handlers' helper threads.
  void wake();
  /// Makes dispatch() run `work`, in order of arrival. For other threads (a control pipe, a timer).
  void post(std::function<void()> work);

  /// While the inbox is deaf, all arriving samples are lost, as for a process that is stopped for a long time. Posted
  /// work is not lost.
  void set_deaf(bool deaf);

  /// Counts a sample that is not a valid message of its topic's type (typed.hpp), and logs the first one on each topic.
  /// Call it inside dispatch(), or on the same thread.
  void note_malformed(const std::string& topic, const Sample& sample);
  /// Malformed samples so far, on all topics.
  std::uint64_t malformed() const { return malformed_; }

  /// The run to which this program belongs. typed.hpp drops lock-step messages of other runs.
  RunId run() const { return run_; }
  /// Logs the first message of another run on each topic.
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
