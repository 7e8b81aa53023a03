#include "host/process_orders.hpp"

#include <algorithm>
#include <csignal>

namespace skein::cli {
namespace {

constexpr std::chrono::milliseconds kStopPoll{5};

}  // namespace

void ProcessOrders::take_out(const std::string& program, bool kill, bool by_us) {
  programs_[program] = kill ? State::killed : State::stopped;
  if (by_us) host_.signal(program, kill ? SIGKILL : SIGSTOP);
}

void ProcessOrders::let_back(const std::string& program) {
  const auto found = programs_.find(program);
  if (found == programs_.end()) return;
  if (found->second == State::killed) found->second = State::to_restart;
  if (found->second == State::stopped) found->second = State::to_continue;
}

std::vector<std::string> ProcessOrders::take_returning() {
  std::vector<std::string> ready;
  for (auto& [program, state] : programs_) {
    const bool can_start = state == State::to_restart && !host_.running(program);
    const bool can_go_on = state == State::to_continue && host_.has_stopped(program);
    if (!can_start && !can_go_on) continue;
    state = State::returning;
    ready.push_back(program);
  }
  return ready;
}

std::chrono::milliseconds ProcessOrders::limit(std::chrono::milliseconds limit) const {
  const bool poll = std::any_of(programs_.begin(), programs_.end(),
                                [](const auto& entry) { return entry.second == State::to_continue; });
  if (!poll) return limit;
  return limit.count() < 0 ? kStopPoll : std::min(limit, kStopPoll);
}

bool ProcessOrders::on_exit(const std::string& program, const ExitStatus& exit) {
  const auto found = programs_.find(program);
  if (found == programs_.end()) return false;
  const State state = found->second;
  const bool ordered = state == State::killed || state == State::to_restart || state == State::ended;
  if (ordered && exit.signal == SIGKILL) return true;
  programs_.erase(found);
  return false;
}

void ProcessOrders::end() {
  for (auto& [program, state] : programs_) {
    state = State::ended;
    host_.signal(program, SIGKILL);
  }
}

std::set<std::string> ProcessOrders::out() const {
  std::set<std::string> names;
  for (const auto& [program, state] : programs_) names.insert(program);
  return names;
}

}  // namespace skein::cli
