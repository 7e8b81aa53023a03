// Takeoff: lifts off after the UAVs that stand near by, and climbs to a height of its own where the planner's work
// begins. A UAV that starts in a box, and assumes boxes to be structure, climbs straight up out of it. A UAV that is
// held in the climb tries an ordered list of recovery behaviours: climb from a place beside the structure that holds
// it; step aside from space that its LiDAR cannot prove free; sink back to the ground and try again later, if its
// position drifts meanwhile; wait to be shown the way up, if it has no LiDAR.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>

#include "uav_agent/flight_core/landing.hpp"

namespace skein::agent {

class Takeoff {
 public:
  enum class Phase { ground, climbs, over };

  /// @param config, agent, filter, navigator, landing  must outlive this.
  Takeoff(const FlightConfig& config, const AgentConfig& agent, SafetyFilter& filter, const Navigator& navigator,
          const Landing& landing)
      : config_(config), agent_(agent), filter_(filter), navigator_(navigator), landing_(landing) {}

  /// Runs one exchange of a UAV that is on the ground or climbs, and knows its boxes.
  /// @returns the phase afterwards; `over` once the UAV may begin to work, because it has climbed or because it was
  ///   restarted in flight.
  Phase step(const PlannerInput& in, Steering& steering);
  /// Prepares another takeoff, of a UAV that has landed.
  void again();
  /// The end of the climb; nullopt before the UAV first lifts off.
  const std::optional<Vector3d>& top_W() const { return top_W_; }
  /// Index in the fleet of the UAV for which this UAV waited in the last step().
  const std::optional<std::size_t>& waits_for() const { return waits_for_; }

 private:
  void stand(const PlannerInput& in, Steering& steering);
  void climb(const PlannerInput& in, Steering& steering);
  bool raise_top(const PlannerInput& in);
  bool climbs_aside(const PlannerInput& in, Steering& steering);
  bool recovers_from_drift(const PlannerInput& in, Steering& steering);
  bool gives_way(const PlannerInput& in, Steering& steering);
  void sink_back(const PlannerInput& in, Steering& steering);
  bool has_neighbours(const PlannerInput& in) const;
  std::optional<Vector3d> place_aside_W(const PlannerInput& in);
  void climb_from(const Vector3d& place_W, const PlannerInput& in, Steering& steering);
  Vector3d away_from_neighbours_W(const PlannerInput& in) const;
  int neighbours_after() const;
  std::optional<std::size_t> lifts_off_after(const PlannerInput& in);
  bool may_drift_into_neighbours(const PlannerInput& in);
  double stalled_s(const PlannerInput& in) const { return seconds(in.tick - climbed_at_); }
  /// Whether the UAV knows its position only with an error, and reacts to it.
  bool drifts(const PlannerInput& in) const { return config_.reacts && !in.uncertainty.exact(); }

  const FlightConfig& config_;
  const AgentConfig& agent_;
  SafetyFilter& filter_;
  const Navigator& navigator_;
  const Landing& landing_;
  Phase phase_ = Phase::ground;
  std::optional<Tick> ready_since_;  ///< when the UAV was first ready to lift off
  std::optional<Vector3d> top_W_;
  bool sinks_back_ = false;     ///< the UAV gave up a climb, and is not on the ground yet
  Tick stands_until_ = 0;       ///< after a climb that it gave up
  std::size_t next_aside_ = 0;  ///< index of the place beside the start that it tries next
  bool aside_ = false;          ///< whether it flies to such a place, or climbs from there
  Tick next_search_at_ = 0;     ///< of such a place
  int gave_way_ = 0;            ///< number of climbs that it gave up for others
  bool stepped_aside_ = false;  ///< whether it stepped aside in this climb
  double climbed_m_ = 0.0;      ///< height reached in the climb, at climbed_at_
  Tick climbed_at_ = 0;
  std::optional<std::size_t> waits_for_;
};

}  // namespace skein::agent
