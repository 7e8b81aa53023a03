// Takes the orders of people who fly UAVs by hand. Orders from a browser may come at any time; at each boundary between
// two steps the server asks which commands have changed since the last one.
//
// An order lapses unless the page renews it: if the browser vanishes, or its host sleeps, the UAV comes to rest. This
// timeout uses the wall clock, because it is for people. The run stays repeatable: a timeout, like any order, becomes a
// command at a step, which goes to the UAV and into its file (core/planners/hand_file.hpp). A run that repeats the
// flight reads that file, and no clock.
// Units: SI and radians.   Threads: one.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/messages/hand_command.hpp"
#include "core/scenario/scenario.hpp"
#include "view/fly_order.hpp"

namespace skein::sim {

class HandDesk {
 public:
  using Clock = std::chrono::steady_clock;
  /// Wall time after which an order lapses. While a UAV is to move, the page renews its order several times in this
  /// time (web/src/hand_flight.js).
  static constexpr std::chrono::milliseconds kHolds{1000};

  /// @param uavs  UAVs that viewers fly by hand.
  HandDesk(const Scenario& scenario, const std::vector<UavIndex>& uavs);

  /// The newest order counts, no matter which viewer gave it. Orders for other UAVs are ignored.
  void take(const view::FlyOrder& order, Clock::time_point now);
  /// Call it at a boundary. @returns the command for this UAV from now on; nullopt: it has not changed.
  std::optional<HandCommand> news(UavIndex uav, Clock::time_point now);

 private:
  struct Place {
    UavIndex uav;
    std::string name;
    HandCommand wanted, told;  ///< as ordered last; as news() returned last
    Clock::time_point until{};
  };
  std::vector<Place> places_;
};

}  // namespace skein::sim
