// The time of a run that somebody watches: it holds the server at boundaries between two exchanges, where everybody has
// answered and nobody waits for anything. What the run computes does not depend on it.
// Threads: one.   Pure: knows no bus, and reads no clock.
#pragma once

#include <chrono>
#include <optional>

#include "view/time_order.hpp"

namespace skein::sim {

class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param speed  simulated seconds a second; none: as fast as the machine allows.
  /// @param pause_at_s  simulated time [s] at which it pauses by itself, once; none: only when it is told.
  explicit Pace(std::optional<double> speed, std::optional<double> pause_at_s = {})
      : speed_(speed), pause_at_s_(pause_at_s) {}

  void obey(const view::TimeOrder& order);
  /// At a boundary, before may_go_on(): the run has come to this simulated time [s]. @returns whether it pauses here.
  bool reach(double time_s);
  /// At a boundary: whether the next exchange may begin now; asked again and again until it may. A step that was asked
  /// for is taken with that.
  /// @param period_s  simulated time of an exchange
  bool may_go_on(Clock::time_point now, double period_s);
  /// At a boundary at which it may not: for how long there is nothing to ask, unless an order comes.
  Clock::duration left(Clock::time_point now) const;

  bool paused() const { return paused_; }
  const std::optional<double>& speed() const { return speed_; }
  /// For how long it has held the run in all [s].
  double held_s() const { return std::chrono::duration<double>(held_).count(); }

 private:
  std::optional<double> speed_, pause_at_s_;
  bool paused_ = false;
  int steps_ = 0;                           ///< that were asked for
  std::optional<Clock::time_point> since_;  ///< it holds the run
  std::optional<Clock::time_point> due_;    ///< of the next exchange, by the speed; none: at once
  Clock::duration held_{};
};

}  // namespace skein::sim
