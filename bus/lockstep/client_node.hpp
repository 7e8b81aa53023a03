// Base of every program except the server: a client of the lock-step that thinks about each step, and answers it.
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
  /// Whether the run ended before this program could join: then it has nothing to report. What it did before a restart
  /// is in its records.
  bool came_too_late() const { return end_ == NodeEnd::finished && !was_member_; }
  /// What the program waits for, for people.
  virtual std::string waiting_for() { return client().waiting_for(); }

 protected:
  virtual LockstepClient& client() = 0;

  /// Thinks about client().step(), writes, and calls client().done(); the router calls it later, from serve().
  virtual void think() = 0;
  /// A step has arrived completely. @returns whether it is time for think(); else turn() asks again next time.
  virtual bool may_think() { return true; }
  /// Runs in every turn. @returns true while the node waits for something that no sample announces (a match).
  virtual bool serve() { return false; }
  /// For Inbox::dispatch(), while the node waits for nothing else.
  virtual std::size_t rings() { return client().rings(); }
  /// Whether the node has answered the last step.
  virtual bool answered_last() const = 0;
  /// A fault had stopped this node and is over. @returns true if start() can join again, with a new participant and a
  /// new client; false if only a new node can.
  virtual bool rejoin() { return false; }
  /// After this time without a step, the log says what the node waits for; again after twice the time, and so on.
  virtual std::chrono::milliseconds first_word() const { return WaitNotice::kFirst; }

 private:
  void look_for_server();
  void wait_from_now() { wait_ = WaitNotice(WaitNotice::Clock::now(), first_word()); }

  std::optional<NodeEnd> end_;
  WaitNotice wait_{WaitNotice::Clock::now()};
  std::optional<Patience> leaving_;  ///< since the node answered the last step
  double patience_with_server_s_ = 0.0;
  Patience until_server_{0.0};
  bool was_member_ = false, met_server_ = false;
  bool thinking_ = false;  ///< a step is here, but may_think() has not returned true yet
  bool serving_ = true;    ///< waits for what no sample announces
};

}  // namespace skein::bus
