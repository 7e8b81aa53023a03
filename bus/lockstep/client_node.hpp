// What every program but the server is: a client of the lock-step that thinks about each step, and answers it.
#pragma once

#include "bus/lockstep/client.hpp"
#include "bus/lockstep/lockstep_node.hpp"
#include "bus/lockstep/patience.hpp"
#include "core/wait_notice.hpp"

namespace skein::bus {

class ClientNode : public LockstepNode {
 public:
  void give_up_after(double seconds) override { patience_with_server_s_ = seconds; }
  void start() override;
  void turn(bool arrived) override;
  std::optional<NodeEnd> end() const override { return end_; }
  Rest rest() override;
  /// Whether the run ended while it stood at the door: it has nothing to report then. What it did in an earlier life is
  /// in its books.
  bool came_too_late() const { return end_ == NodeEnd::finished && !was_member_; }
  /// What it waits for, for a human.
  virtual std::string waiting_for() { return client().waiting_for(); }

 protected:
  virtual LockstepClient& client() = 0;

  /// Thinks about client().step(), writes, and calls client().done(); the router does so later, from serve().
  virtual void think() = 0;
  /// A step is here, all of it. @returns whether it is time for think(); else the node is asked again in its next turn.
  virtual bool may_think() { return true; }
  /// In every turn. @returns true while it waits for something that no sample announces (a match).
  virtual bool serve() { return false; }
  /// For Inbox::dispatch(), while it waits for nothing else.
  virtual std::size_t rings() { return client().rings(); }
  /// Whether the answer to the last step is out.
  virtual bool answered_last() const = 0;
  /// A fault stopped us and is over. @returns whether start() joins again, with a new participant and a new client;
  /// else it takes a new node to do that.
  virtual bool rejoin() { return false; }
  /// After so long without a step the log tells what it waits for; again after twice as long, and so on.
  virtual std::chrono::milliseconds first_word() const { return WaitNotice::kFirst; }

 private:
  void look_for_server();
  void wait_from_now() { wait_ = WaitNotice(WaitNotice::Clock::now(), first_word()); }

  std::optional<NodeEnd> end_;
  WaitNotice wait_{WaitNotice::Clock::now()};
  std::optional<Patience> leaving_;  ///< since the last step is answered
  double patience_with_server_s_ = 0.0;
  Patience until_server_{0.0};
  bool was_member_ = false, met_server_ = false;
  bool thinking_ = false;  ///< a step is here, and may_think() was not true yet
  bool serving_ = true;    ///< waits for what no sample announces
};

}  // namespace skein::bus
