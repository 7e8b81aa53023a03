// The server's side of a run that is watched (--watch): it tells the station what a page needs, and holds the run where
// the page says so. It is there only then; nobody in the fleet hears of it, and it is in no count.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "sim_server/pace.hpp"
#include "sim_server/record/event_log.hpp"
#include "sim_server/simulation.hpp"
#include "view/story.hpp"

namespace skein::sim {

struct WatchOptions {
  std::optional<double> speed;  ///< simulated seconds a second; none: as fast as the machine allows
  bool paced = true;            ///< false: a clock of the world sets the pace, and nothing holds the run
};

class WatchNode {
 public:
  /// @param world  of the server; it and the references must outlive this.
  WatchNode(const Scenario& scenario, const Simulation& simulation, EventLog& events, bus::Inbox& inbox,
            bus::Participant& world, const WatchOptions& options);

  /// In each step, when it is published. @param faults  that begin or end with it, in words
  void begin_step(const std::vector<std::string>& faults);
  /// At a boundary: whether the next exchange may begin.
  bool may_go_on();
  /// While it may not: for how long there is nothing to do unless something arrives.
  std::chrono::milliseconds left() const;
  /// For how long the run was held in all [s]: no time of its own.
  double held_s() const { return pace_.held_s(); }

 private:
  using Clock = Pace::Clock;

  void tell(const std::string& line);
  void tell_scene();
  void tell_state(Clock::time_point now);
  std::vector<view::ShownUav> shown_uavs() const;
  std::vector<view::ShownLink> shown_links() const;

  const Scenario& scenario_;
  const Simulation& simulation_;
  const WatchOptions options_;
  Pace pace_;
  std::unique_ptr<bus::Writer> story_, state_;
  std::unique_ptr<bus::Reader> orders_;
  std::vector<view::ShownLink> told_links_;
  Tick pose_due_ = 0;
  bool state_stale_ = true;
  Clock::time_point state_told_{};
};

}  // namespace skein::sim
