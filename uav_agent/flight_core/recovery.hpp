// What a UAV does whose goals all came to nothing: an ordered list of behaviours, each tried in turn until its strategy
// gets to a goal again. Looking around lets a LiDAR prove more; nearer to a place that it missed it sees how to go on;
// elsewhere and higher up the world looks different. Where all that is not proved to be free, the way that it came is.
// A UAV that structure seen since has shut in flies back at once.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <deque>
#include <iterator>
#include <optional>

#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/navigator.hpp"

namespace skein::agent {

class Recovery {
 public:
  /// @param config, navigator  must outlive this.
  Recovery(const FlightConfig& config, Navigator& navigator);

  /// Once per exchange, before anything else: remembers where it was.
  void update(const PlannerInput& in);
  /// The strategy got on: the list begins anew.
  void progress() { tries_ = backs_ = 0; }
  /// Takes up the next behaviour.
  void begin(const PlannerInput& in);
  /// One exchange of it. @returns whether it is over, and the strategy may decide anew.
  bool step(const PlannerInput& in, const Held& held, Steering& steering);
  /// Which behaviour it is, for people.
  Doing::What doing() const;

 private:
  enum class Behaviour { look_around, approach, elsewhere, climb, back };

  static constexpr Behaviour kOrder[] = {Behaviour::look_around, Behaviour::approach, Behaviour::elsewhere,
                                         Behaviour::climb, Behaviour::back};
  static constexpr int kBehaviours = std::size(kOrder);

  bool set_out(const PlannerInput& in);
  bool go_back(const Vector3d& here_W);

  const FlightConfig& config_;
  Navigator& navigator_;
  int tries_ = 0;  ///< since the strategy last got on
  int backs_ = 0;  ///< of these, along the trail
  Behaviour behaviour_ = kOrder[0];
  Tick until_ = 0;
  std::deque<Vector3d> trail_W_;  ///< the way that it came, oldest first, without the loops in it
};

}  // namespace skein::agent
