#include "bus/lockstep/client_loop.hpp"

#include <spdlog/spdlog.h>

namespace skein::bus {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMatchPoll{2};
constexpr milliseconds kIdlePoll{200};
constexpr int kLingerPolls = 25;  // of kIdlePoll: as long as the answer to the last step may be on its way

}  // namespace

LoopEnd run_client(LockstepClient& client, Inbox& inbox, const ClientLoop& loop, const StopSignal& stop) {
  client.start();
  const auto wait_from_now = [&] { return WaitNotice(WaitNotice::Clock::now(), loop.first_word); };
  WaitNotice wait = wait_from_now();
  bool was_member = false;
  for (bool waiting = true; !stop.requested();) {
    const std::size_t rings = waiting ? 0 : loop.rings ? loop.rings() : client.rings();
    const bool arrived = inbox.dispatch(waiting ? kMatchPoll : kIdlePoll, rings);
    const LockstepClient::Event event = client.poll();
    if (event == LockstepClient::Event::dropped) return LoopEnd::dropped;
    if (event == LockstepClient::Event::resumed) return LoopEnd::resumed;
    if (event == LockstepClient::Event::think) {
      loop.think();
      wait = wait_from_now();
    }
    if (const auto waited_s = wait.due(WaitNotice::Clock::now())) {
      spdlog::info("waiting for {} ({:.0f} s)", client.waiting_for(), *waited_s);
    }
    const bool serving = loop.serve();
    was_member = was_member || client.is_member();
    waiting = serving || client.waits_for_matches();
    if (loop.answered_last()) break;
    // Also while a match is awaited: a program that was stopped may find nobody left to match.
    if (!arrived && was_member && !client.server_present()) return LoopEnd::server_gone;
  }
  if (stop.requested()) return LoopEnd::stopped;
  // Leaving at once could take the last answer away with us before it has arrived.
  for (int i = 0; i < kLingerPolls && client.server_present() && !stop.requested(); ++i) inbox.dispatch(kIdlePoll);
  return LoopEnd::finished;
}

int exit_code(LoopEnd end, const std::string& member) {
  switch (end) {
    case LoopEnd::finished:
      return 0;
    case LoopEnd::stopped:
      return 0;
    case LoopEnd::server_gone:
      spdlog::error("{}: sim_server is gone", member);
      return 3;
    case LoopEnd::resumed:
    case LoopEnd::dropped:
      spdlog::error("{}: sim_server goes on without us", member);
      return 3;
  }
  return 3;
}

}  // namespace skein::bus
