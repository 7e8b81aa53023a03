// Bringing captures home: where a UAV goes to be in direct line of sight of the station, when it must leave,
// and the trip. The nearest such place is often the one where it last had the link: it comes first.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/link_watch.hpp"
#include "uav_agent/flight/pilot.hpp"

namespace skein::agent {

/// Places with a free line to the station as far as is known, best first: above it, each UAV at a height and
/// in a direction of its own, so that the whole fleet can gather there. Pure.
/// @param lowest_m  no place is lower than this.
std::vector<Vector3d> delivery_places(const AgentConfig& agent, const FreeSpace& space, double lowest_m);

/// Time to fly to `place`, on the safe side: the way is not straight [s]. Pure.
double time_home_s(const Vector3d& from_W, const Vector3d& place_W, double speed_mps);

class Delivery {
 public:
  struct Config {
    double every_s = 240.0;  ///< go when something has been undelivered for this long
    double margin_s = 12.0;  ///< spare time at the end of the mission
    double speed_mps = 4.5;
  };

  /// @param agent, pilot  must outlive this.
  Delivery(const Config& config, const AgentConfig& agent, Pilot& pilot)
      : config_(config), agent_(agent), pilot_(pilot) {}

  /// Once per exchange in the air: takes note of links and of what has been delivered. @param top_m  of all structure.
  void update(const PlannerInput& in, double top_m);
  /// Whether it is time to leave: by the clock, unless captures are delivered from where it works.
  bool due(const PlannerInput& in) const;
  /// Sets out.  @param lowest_m  see delivery_places().
  void begin(const PlannerInput& in, const FreeSpace::Config& space, double lowest_m, PlannerOutput& out);
  /// Once per exchange of the trip. @returns true when all is delivered and there is time to work on.
  bool step(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out);
  /// The way there came to nothing: tries the next place in a second.
  void try_elsewhere(const PlannerInput& in);
  /// Tries the same place again in a second.
  void try_again(const PlannerInput& in);

 private:
  Vector3d home() const;
  double way_home_s(const PlannerInput& in) const;
  bool approach(const Vector3d& p_W, const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out);
  void next_place() { place_ = (place_ + 1) % (places_.size() + 1); }

  const Config config_;
  const AgentConfig& agent_;
  Pilot& pilot_;
  double top_m_ = 0.0;
  LinkWatch link_;
  std::vector<Vector3d> places_;
  std::size_t place_ = 0;  ///< places_.size() stands for high above everything
  bool heading_home_ = false;
  Tick next_try_ = 0;
  int failures_ = 0;
  std::optional<Tick> unlinked_since_;  ///< at the place
};

}  // namespace skein::agent
