// The main loop of every program but the server: dispatch, poll, think, until the last step is answered.
#pragma once

#include <functional>
#include <string>

#include "bus/lockstep/client.hpp"
#include "core/wait_notice.hpp"
#include "process/program.hpp"

namespace skein::bus {

struct ClientLoop {
  /// Thinks about client.step(), writes, and calls client.done(); the router does so later, from `serve`.
  std::function<void()> think;
  /// Called after every dispatch. @returns true while it waits for something that no sample announces (a match).
  std::function<bool()> serve = [] { return false; };
  /// For Inbox::dispatch(), while it waits for nothing else; by default what the client needs.
  std::function<std::size_t()> rings = nullptr;
  /// Whether the answer to the last step is out.
  std::function<bool()> answered_last;
  /// After so long without a step the log tells what it waits for; again after twice as long, and so on.
  std::chrono::milliseconds first_word = WaitNotice::kFirst;
};

enum class LoopEnd {
  finished,     ///< the last step is answered, the server has gone
  stopped,      ///< asked to stop
  server_gone,  ///< the server vanished in the middle of the run
  dropped,      ///< the server went on without us
  resumed,      ///< a fault stopped us and is over: join again, with a new participant and a new client
};

/// Starts the client and runs it on this thread. @param stop  asked now and then; inbox.wake() makes it look at once.
LoopEnd run_client(LockstepClient& client, Inbox& inbox, const ClientLoop& loop, const StopSignal& stop);

/// Exit code of a program whose loop ended so; logs why when it is not a good end.
int exit_code(LoopEnd end, const std::string& member);

}  // namespace skein::bus
