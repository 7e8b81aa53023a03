// Interface of the nodes of all programs of a fleet. A node works only in turns that its caller gives it. In a process
// of its own, run_node() gives the turns, and sleeps between them. A test, or a process with a whole fleet, calls
// poll() on each node.
// Threads: one.
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
  finished,     ///< client: it has answered the last step, and the server has left; server: the run has ended
  stopped,      ///< the program was asked to stop
  server_gone,  ///< the server disappeared during the run
  dropped,      ///< the server removed this member and continued without it
  resumed,      ///< a fault that stopped the program is over: continue with a new node
};

class LockstepNode {
 public:
  virtual ~LockstepNode() = default;

  /// Call it before start(). A client that has found no server after this wall time [s] ends with NodeEnd::finished.
  /// 0: no limit.
  virtual void give_up_after(double /*seconds*/) {}
  /// Starts to look for the other programs. Call it once, before any turn.
  virtual void start() = 0;
  /// One turn after Inbox::dispatch(): does all that the arrived samples permit, and never waits.
  /// @param arrived  what dispatch() returned.
  virtual void turn(bool arrived) = 0;
  /// How the node ended; nullopt while it runs.
  virtual std::optional<NodeEnd> end() const = 0;
  virtual Inbox& inbox() = 0;

  /// How long the caller may wait before the next turn, and for how many samples.
  struct Rest {
    std::chrono::milliseconds longest{0};
    std::size_t rings = 0;  ///< number of samples of ringing topics to wait for, as in Inbox::dispatch()
    /// true: the node can do nothing before these samples have arrived; false: it waits for something else, too, such
    /// as the end of a time.
    bool until_rung = true;
  };
  virtual Rest rest() = 0;

  /// Gives the node a turn, unless it can only wait for samples that have not arrived. It ignores Rest::longest, so a
  /// fleet that can continue only after a time-out makes no progress.
  void poll() {
    const Rest now = rest();
    if (end() || (now.until_rung && !inbox().ready(now.rings))) return;
    turn(inbox().dispatch(std::chrono::milliseconds(0)));
  }
};

/// Starts a node and gives it turns on this thread until it ends; sleeps between turns.
/// @param stop  checked between turns; inbox().wake() ends the sleep. nullptr: the node runs to its own end.
/// @param on_turn  called before each turn.
NodeEnd run_node(LockstepNode& node, const StopSignal* stop = nullptr, const std::function<void()>& on_turn = {});

/// Exit code of a program whose node ended in this way; logs the reason of a failure.
int exit_code(NodeEnd end, const std::string& member);

}  // namespace skein::bus
