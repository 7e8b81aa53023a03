#include "bus/lockstep/client_node.hpp"

#include <spdlog/spdlog.h>

#include "bus/lockstep/break_point.hpp"

namespace skein::bus {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMatchPoll{2};
constexpr milliseconds kIdlePoll{200};
constexpr double kLinger_s = 5.0;  // limit of the time in which the last answer may be in transit

}  // namespace

void ClientNode::start() {
  client().start();
  wait_from_now();
  was_member_ = met_server_ = thinking_ = false;
  until_server_ = Patience(patience_with_server_s_);
  serving_ = true;
}

LockstepNode::Rest ClientNode::rest() {
  if (leaving_) return {.longest = kIdlePoll, .until_rung = false};
  if (serving_) return {.longest = kMatchPoll, .until_rung = false};
  return {.longest = kIdlePoll, .rings = rings(), .until_rung = true};
}

void ClientNode::turn(bool arrived) {
  if (end_) return;
  // If the node left at once, its last answer could be lost in transit.
  if (leaving_) {
    if (!client().server_present() || leaving_->over()) end_ = NodeEnd::finished;
    return;
  }
  const LockstepClient::Event event = client().poll();
  if (event == LockstepClient::Event::dropped) end_ = NodeEnd::dropped;
  if (event == LockstepClient::Event::resumed) {
    if (rejoin()) return start();
    end_ = NodeEnd::resumed;
  }
  if (end_) return;
  if (event == LockstepClient::Event::think) {
    break_if_due(client().step().tick());
    thinking_ = true;
  }
  if (thinking_ && may_think()) {
    thinking_ = false;
    think();
    wait_from_now();
  }
  if (const auto waited_s = wait_.due(WaitNotice::Clock::now())) {
    spdlog::info("waiting for {} ({:.0f} s)", client().waiting_for(), *waited_s);
  }
  const bool serving = serve();
  was_member_ = was_member_ || client().is_member();
  serving_ = serving || client().waits_for_matches();
  if (answered_last()) {
    leaving_.emplace(kLinger_s);
  } else if (!arrived) {
    look_for_server();
  }
}

// Also called while the node waits for a match: after a stop, the server may be gone. A node without an idle turn in
// the whole run looks for the first time when the server has left; has_declared() shows that it had matched the server.
// An invitation alone does not show that: it may arrive before the match.
void ClientNode::look_for_server() {
  const bool present = client().server_present();
  met_server_ = met_server_ || present || client().has_declared();
  if (present || (!met_server_ && !until_server_.over())) return;
  if (!was_member_) spdlog::info("{}", met_server_ ? "the run is over, without us" : "there is no sim_server");
  end_ = was_member_ ? NodeEnd::server_gone : NodeEnd::finished;
}

}  // namespace skein::bus
