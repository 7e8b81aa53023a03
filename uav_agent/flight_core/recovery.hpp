// What a UAV does whose goals all came to nothing: an ordered list of behaviours, each tried in turn until its strategy
// gets to a goal again. Looking around lets a LiDAR prove more; nearer to a place that it missed it sees how to go on;
// elsewhere and higher up the world looks different.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>

#include "uav_agent/flight_core/navigator.hpp"

namespace skein::agent {

class Recovery {
 public:
  /// @param config, navigator  must outlive this.
  Recovery(const FlightConfig& config, Navigator& navigator);

  /// The strategy got on: the list begins anew.
  void progress() { tries_ = 0; }
  /// Takes up the next behaviour.
  void begin(const PlannerInput& in);
  /// One exchange of it. @returns whether it is over, and the strategy may decide anew.
  bool step(const PlannerInput& in, const Held& held, Steering& steering);

 private:
  enum class Behaviour { look_around, approach, elsewhere, climb };

  bool set_out(const PlannerInput& in);

  const FlightConfig& config_;
  Navigator& navigator_;
  int tries_ = 0;  ///< since the strategy last got on
  Behaviour behaviour_ = Behaviour::look_around;
  Tick until_ = 0;
};

}  // namespace skein::agent
