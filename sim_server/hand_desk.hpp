// What who flies a UAV by hand wants of it, between the browser and the run: takes orders whenever they come, and says
// at each boundary what is new since the last one.
//
// An order holds for so long as it is renewed: if the browser vanishes, or its host sleeps, the UAV comes to rest. That
// time is the wall clock's, the only one that runs for people. It decides nothing that is hashed by itself: what comes
// of it, like any order, is a command at a step, which goes to the UAV and into its file (core/planners/hand_file.hpp),
// and who flies it again takes that file and no clock.
// Units: SI and radians.   Threads: one.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/hand_command.hpp"
#include "core/ids.hpp"
#include "core/scenario.hpp"
#include "view/fly_order.hpp"

namespace skein::sim {

class HandDesk {
 public:
  using Clock = std::chrono::steady_clock;
  /// A page says what it wants several times in that (web/src/hand_flight.js).
  static constexpr std::chrono::milliseconds kHolds{1000};

  /// @param uavs  that somebody flies by hand.
  HandDesk(const Scenario& scenario, const std::vector<UavIndex>& uavs);

  /// The newest order counts, whoever gave it. Those for other UAVs, or for nobody, go nowhere.
  void take(const view::FlyOrder& order, Clock::time_point now);
  /// At a boundary. @returns what is wanted of this UAV from now on; nullopt: what was wanted before.
  std::optional<HandCommand> news(UavIndex uav, Clock::time_point now);

 private:
  struct Place {
    UavIndex uav;
    std::string name;
    HandCommand wanted, told;
    Clock::time_point until{};
  };
  std::vector<Place> places_;
};

}  // namespace skein::sim
