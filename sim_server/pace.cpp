#include "sim_server/pace.hpp"

#include <algorithm>

namespace skein::sim {
namespace {

/// Maximum delay that the exchanges after a slow one catch up.
constexpr std::chrono::milliseconds kCatchUp{250};
/// While the run is paused: time until may_go_on() is worth asking again.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

void Pace::obey(const view::TimeOrder& order) {
  using Kind = view::TimeOrder::Kind;
  if (order.kind == Kind::speed) {
    speed_ = order.speed;
    due_.reset();
  } else if (order.kind == Kind::step) {
    steps_ = paused_ ? steps_ + 1 : 0;  // in a run that is not paused, the order `step` only pauses it
    paused_ = true;
  } else {
    paused_ = order.kind == Kind::pause;
    steps_ = 0;
    due_.reset();
  }
}

bool Pace::reach(double time_s) {
  if (!pause_at_s_ || time_s < *pause_at_s_) return false;
  pause_at_s_.reset();
  obey({view::TimeOrder::Kind::pause});
  return true;
}

bool Pace::may_go_on(Clock::time_point now, double period_s) {
  const bool goes = paused_ ? steps_ > 0 : !speed_ || !due_ || now >= *due_;
  if (!goes) {
    if (!since_) since_ = now;
    return false;
  }
  let_go(now);
  if (paused_) --steps_;
  if (speed_) {
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(period_s / *speed_));
    due_ = std::max(due_.value_or(now), now - kCatchUp) + period;
  }
  return true;
}

void Pace::let_go(Clock::time_point now) {
  if (since_) held_ += now - *since_;
  since_.reset();
}

Pace::Clock::duration Pace::left(Clock::time_point now) const {
  if (paused_) return steps_ > 0 ? Clock::duration(0) : kLook;
  return due_ ? std::max(*due_ - now, Clock::duration(0)) : Clock::duration(0);
}

}  // namespace skein::sim
