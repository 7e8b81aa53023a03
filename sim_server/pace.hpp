// Paces a run that a user watches: it holds the server at boundaries between two exchanges, at which every program
// has answered and none waits for a message. The results of the run do not depend on it.
// Threads: one.   Pure: knows no bus, and reads no clock.
#pragma once

#include <chrono>
#include <optional>

#include "view/time_order.hpp"

namespace skein::sim {

class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param speed  simulated seconds per second of wall time; nullopt: as fast as the machine allows.
  /// @param pause_at_s  the first boundary at or after this simulated time [s] pauses the run, once; nullopt: none.
  explicit Pace(std::optional<double> speed, std::optional<double> pause_at_s = {})
      : speed_(speed), pause_at_s_(pause_at_s) {}

  void obey(const view::TimeOrder& order);
  /// Call it at a boundary, before may_go_on(). @param time_s  simulated time of the boundary [s].
  /// @returns whether `pause_at_s` has paused the run with this call.
  bool reach(double time_s);
  /// At a boundary: whether the next exchange may begin now; ask again until it may. While the run is paused, a call
  /// that returns true uses up one of the single steps that a viewer has ordered.
  /// @param period_s  simulated time of an exchange [s]
  bool may_go_on(Clock::time_point now, double period_s);
  /// The run goes on, although may_go_on() has returned false.
  void let_go(Clock::time_point now);
  /// While may_go_on() returns false: time until it is worth asking again, unless an order comes first.
  Clock::duration left(Clock::time_point now) const;

  bool paused() const { return paused_; }
  const std::optional<double>& speed() const { return speed_; }
  /// Total wall time for which it has held the run until now [s], also if it still does.
  double held_s(Clock::time_point now) const {
    return std::chrono::duration<double>(since_ ? held_ + (now - *since_) : held_).count();
  }

 private:
  std::optional<double> speed_, pause_at_s_;
  bool paused_ = false;
  int steps_ = 0;                           ///< single steps that are ordered and not yet taken
  std::optional<Clock::time_point> since_;  ///< when it began to hold the run; none: it does not
  std::optional<Clock::time_point> due_;    ///< when `speed_` lets the next exchange begin; none: at once
  Clock::duration held_{};                  ///< without the hold that lasts
};

}  // namespace skein::sim
