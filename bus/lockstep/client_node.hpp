// Base class of the nodes of all programs except sim_server: a lock-step client that computes and answers each step.
#pragma once

#include "bus/lockstep/client.hpp"
#include "bus/lockstep/lockstep_node.hpp"
#include "bus/lockstep/patience.hpp"
#include "core/run/wait_notice.hpp"

namespace skein::bus {

class ClientNode : public LockstepNode {
 public:
  void give_up_after(double seconds) override { patience_with_server_s_ = seconds; }
  void start() override;
  void turn(bool arrived) override;
  std::optional<NodeEnd> end() const override { return end_; }
  Rest rest() override;
  /// Whether the run ended before this program could join, or the server gave it up before. Then it must not report:
  /// after a restart, its earlier work is already in its records.
  bool came_too_late() const { return (end_ == NodeEnd::finished || end_ == NodeEnd::dropped) && !was_member_; }
  /// Describes, for people, what the program waits for.
  virtual std::string waiting_for() { return client().waiting_for(); }

 protected:
  virtual LockstepClient& client() = 0;

  /// Computes client().step(), writes, and calls client().done(). (The router calls done() later, from serve().)
  virtual void think() = 0;
  /// Called in each turn after a step is complete, until it returns true; then turn() calls think().
  virtual bool may_think() { return true; }
  /// Runs in every turn. @returns true while the node waits for something that no sample announces (a match).
  virtual bool serve() { return false; }
  /// Number of rings for Inbox::dispatch(), while the node waits only for samples.
  virtual std::size_t rings() { return client().rings(); }
  /// Whether the node has answered the last step.
  virtual bool answered_last() const = 0;
  /// Called when a fault that stopped this node is over. @returns true if the node has a new participant and a new
  /// client, so that start() can join again; false if only a new node can join.
  virtual bool rejoin() { return false; }
  /// After this time without a step, the log says what the node waits for; again after twice the time, and so on.
  virtual std::chrono::milliseconds first_word() const { return WaitNotice::kFirst; }

 private:
  void look_for_server();
  void wait_from_now() { wait_ = WaitNotice(WaitNotice::Clock::now(), first_word()); }

  std::optional<NodeEnd> end_;
  WaitNotice wait_{WaitNotice::Clock::now()};
  std::optional<Patience> leaving_;  ///< set once the node has answered the last step: limit of the wait until it ends
  double patience_with_server_s_ = 0.0;
  Patience until_server_{0.0};
  bool was_member_ = false, met_server_ = false;
  bool thinking_ = false;  ///< a step is here, but may_think() has not returned true yet
  bool serving_ = true;    ///< the node waits for something that no sample announces
};

}  // namespace skein::bus
