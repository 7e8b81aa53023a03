// The seam of all programs of a fleet: whoever drives a node gives it turns, and nothing else makes it work. A program
// of its own sleeps between them (run_node()); a test, or a process that is home to a whole fleet, gives each node its
// turn with poll().   Threads: one.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "bus/inbox.hpp"
#include "process/program.hpp"

namespace skein::bus {

/// How a node's part in a run ended.
enum class NodeEnd {
  finished,     ///< the last step is answered, the server has gone; of the server: the run is over
  stopped,      ///< asked to stop
  server_gone,  ///< the server vanished in the middle of the run
  dropped,      ///< the server went on without us
  resumed,      ///< a fault stopped us and is over: go on with a new node
};

class LockstepNode {
 public:
  virtual ~LockstepNode() = default;

  /// Before start(): a client that has met no server after so long ends, as after a run. 0: it waits for ever.
  virtual void give_up_after(double /*seconds*/) {}
  /// Begins to look for the others. Once, before any turn.
  virtual void start() = 0;
  /// One turn after Inbox::dispatch(): does all that is possible with what has arrived, and never waits.
  /// @param arrived  what dispatch() returned.
  virtual void turn(bool arrived) = 0;
  /// nullopt while it goes on.
  virtual std::optional<NodeEnd> end() const = 0;
  virtual Inbox& inbox() = 0;

  /// How long it can be left alone.
  struct Rest {
    std::chrono::milliseconds longest{0};
    std::size_t rings = 0;  ///< for Inbox::dispatch()
    bool until_rung =
        true;  ///< until then nothing can happen; else it waits for what no sample announces, such as a match
  };
  virtual Rest rest() = 0;

  /// Its turn, unless it sleeps. It does not look at the time: a fleet that needs a time-out to go on stands still.
  void poll() {
    const Rest now = rest();
    if (end() || (now.until_rung && !inbox().ready(now.rings))) return;
    turn(inbox().dispatch(std::chrono::milliseconds(0)));
  }
};

/// Starts a node and gives it turns on this thread until it ends, asleep between them.
/// @param stop  asked between turns; inbox().wake() makes it look at once. null: nobody stops it.
/// @param on_turn  called before each.
NodeEnd run_node(LockstepNode& node, const StopSignal* stop = nullptr, const std::function<void()>& on_turn = {});

/// Exit code of a program whose node ended so; logs why when that is not a good end.
int exit_code(NodeEnd end, const std::string& member);

}  // namespace skein::bus
