// A ROS 2 process as a member of the lock-step (docs/lockstep.md): joins, waits for all samples that a step announces,
// lets the node work, sends what the node published, and answers. Uses the node's own rmw and DDS participant.
// Threads: the one that the node waits in; now_ns(), is_open(), is_over() and interrupt() from any.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <skein_msgs/msg/done.hpp>
#include <skein_msgs/msg/step.hpp>

#include "channels.hpp"
#include "custody.hpp"
#include "setup.hpp"
#include "sources.hpp"

namespace skein_ros {

class Member {
 public:
  explicit Member(Setup setup) : setup_(std::move(setup)), custody_(setup_.uav) {}

  /// Sends the hello and waits for the invitation. From then on the fleet pauses until the node has joined.
  void open(rmw_context_t* context);
  bool is_open() const { return open_; }
  /// Destroys the member's own endpoints if they are in this context, which is about to end.
  void close(const rmw_context_t* context);
  /// True once the member has announced what the node reads and writes.
  bool has_declared() const { return declared_; }
  /// The node's context is shut down, mostly by a signal: waits end.
  void interrupt() { interrupted_ = true; }
  /// True once the last step is answered.
  bool is_over() const { return over_; }
  const Setup& setup() const { return setup_; }

  /// Simulated time [ns].
  std::int64_t now_ns() const { return now_ns_; }

  /// How the node takes part in a topic: the program at the other end, and the depth of the history.
  struct Role {
    Counterpart counterpart = Counterpart::none;
    int depth = 0;
    bool latched = false;
    std::string refusal = {};  ///< why the node must not have the endpoint; empty: it may
  };
  Role role_of_reading(const std::string& topic) const;
  Role role_of_writing(const std::string& topic) const;

  Incoming& add(std::unique_ptr<Incoming> incoming);
  Outgoing& add(std::unique_ptr<Outgoing> outgoing);
  void remove(const Incoming& incoming);
  void remove(const Outgoing& outgoing);
  const std::vector<std::unique_ptr<Incoming>>& incomings() const { return incomings_; }
  const std::vector<std::unique_ptr<Outgoing>>& outgoings() const { return outgoings_; }

  /// True while the node has the samples of a step and has not finished with it.
  bool in_turn() const { return in_turn_; }
  /// Sends what the node published in this step, and answers it. @pre in_turn()
  void end_turn();
  /// `plan` is called at the end of each step, when the node has nothing else left to do in it.
  void before_answer(std::function<void()> plan) { before_answer_ = std::move(plan); }
  void plan() const {
    if (before_answer_) before_answer_();
  }
  enum class Wait { stepped, interrupted };
  /// Waits for the next step. Returns early if one of `guards` is triggered, and leaves only the triggered ones there;
  /// if `guards` is null, when the context is shut down.
  Wait begin_turn(rmw_guard_conditions_t* guards);

 private:
  void say_ready(std::uint32_t revision);
  void wait_for_invitation();
  bool take_invitation();
  void declare();
  void open_custody();
  bool all_matched() const;
  bool router_matched();
  void wait_a_little(rmw_guard_conditions_t* guards, bool* interrupted);
  void read_steps();
  void on_step(skein_msgs::msg::Step step);
  void obey(const std::string& order);
  bool step_is_here();
  void take_in_captures();
  void send_captures(std::uint64_t k);
  void answer(const skein_msgs::msg::Step& step);
  void leave();
  void look_for_server();
  void report_waiting();
  std::string waiting_for() const;
  Source source_of(Counterpart counterpart) const { return counterpart == Counterpart::router ? router_ : server_; }

  const Setup setup_;
  std::atomic<bool> open_ = false, over_ = false, interrupted_ = false;
  std::atomic<std::int64_t> now_ns_ = 0;
  bool declared_ = false, member_ = false, in_turn_ = false;

  rmw_context_t* context_ = nullptr;
  rmw_node_t* node_ = nullptr;
  rmw_wait_set_t* wait_set_ = nullptr;
  rmw_subscription_t *resyncs_ = nullptr, *steps_ = nullptr;
  rmw_publisher_t *done_ = nullptr, *ready_ = nullptr;
  Source self_ = 0, server_ = 0, router_ = 0, matched_router_ = 0;
  Writers writers_;
  std::vector<std::unique_ptr<Incoming>> incomings_;
  std::vector<std::unique_ptr<Outgoing>> outgoings_;
  std::vector<std::pair<std::string, std::pair<Source, std::uint64_t>>> base_;
  std::optional<std::uint64_t> invited_after_;  ///< the last step before the invitation; none: there was no step
  std::optional<skein_msgs::msg::Step> pending_, step_;
  std::optional<skein_msgs::msg::Done> last_done_;

  std::function<void()> before_answer_;
  Custody custody_;
  Incoming *captures_ = nullptr, *acks_ = nullptr, *neighbours_ = nullptr;
  Outgoing *reports_ = nullptr, *stored_ = nullptr;
  std::chrono::steady_clock::time_point waiting_since_, said_at_;
};

}  // namespace skein_ros
