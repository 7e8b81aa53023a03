// Flies a UAV for its planner: takeoff, goals, return-to-link to deliver captures, recovery and landing. Its modes:
//
//   ground -> takeoff -> working <-> homing, showing, recovering, making room
//   showing, recovering -> homing -> recovering (no way home);   any but ground -> landing (battery nearly empty)
//
// A UAV that is restarted in flight goes from ground to working. The planner returns ranked goals (api/goals.hpp) and
// receives their outcomes; it calls nothing here. The safety filter (safety_filter.hpp) decides where a UAV may fly.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "uav_agent/flight_core/caution.hpp"
#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/homing.hpp"
#include "uav_agent/flight_core/landing.hpp"
#include "uav_agent/flight_core/making_room.hpp"
#include "uav_agent/flight_core/navigator.hpp"
#include "uav_agent/flight_core/recovery.hpp"
#include "uav_agent/flight_core/showing.hpp"
#include "uav_agent/flight_core/takeoff.hpp"

namespace skein::agent {

class FlightCore {
 public:
  /// @param config, agent  must outlive this.
  FlightCore(const FlightConfig& config, const AgentConfig& agent);
  FlightCore(const FlightCore&) = delete;  // parts refer to each other
  FlightCore& operator=(const FlightCore&) = delete;

  /// Call it once per exchange, before the other functions.
  void update(const PlannerInput& in) {
    caution_.update(in);
    filter_.expect(caution_.errors());
    navigator_.update(in);
    recovery_.update(in);
    making_room_.update(in);
  }
  /// The state for PlannerInput. Outcomes are handed out in mode `working` only, and kept until then, so that the
  /// planner receives them when its goals count.
  FlightState state();
  /// Runs one exchange, after the planner has decided.   @param goals, stake  see PlannerOutput.
  Steering step(const PlannerInput& in, std::optional<std::vector<Goal>> goals, const std::optional<Stake>& stake = {});
  /// Advances the tracker by one exchange, as fast as the safety filter allows. Call it after step().
  std::optional<TrajectoryCommand> move(Tracker& tracker, const SafetyFilter::Facts& facts) {
    const bool assumes = filter_.assumes_boxes() || filter_.trust() == SafetyFilter::Trust::unknown;
    const double most_mps = assumes ? config_.alone_mps : navigator_.pace_mps();
    return filter_.step(tracker, facts, std::min(most_mps, caution_.most_mps()), navigator_.retraces());
  }

  /// Index in the fleet of the UAV for which this UAV waits in this exchange.
  const std::optional<std::size_t>& waits_for() const { return waits_for_; }
  /// The reason why a goal ended in this exchange without being reached; empty: none did.
  const std::string& no_way() const { return no_way_; }
  /// The core's activity in this exchange, for display.   @param in  the input of step().
  Doing doing(const PlannerInput& in) const;
  /// The place to which the UAV is about to fly. The other UAVs send map updates about the way there first
  /// (maps/map_news.hpp).
  std::optional<Vector3d> going_to_W() const;
  /// PlannerInput::space: where the planner may choose to work.
  FreeSpace space(const PlannerInput& in) const { return navigator_.open_space(in); }
  const SafetyFilter& filter() const { return filter_; }

 private:
  enum class Mode { ground, takeoff, working, homing, showing, recovering, making_room, landing };

  void take_off(const PlannerInput& in, Steering& steering);
  std::vector<Outcome> outcomes();
  void work(const PlannerInput& in, Steering& steering);
  bool is_stuck(const PlannerInput& in);
  void recover(const PlannerInput& in);
  bool begin_making_room(const PlannerInput& in, Steering& steering);
  bool begin_showing(const PlannerInput& in);
  void cut_wanted();
  void show(const PlannerInput& in, Steering& steering);
  void go_home(const PlannerInput& in, Steering& steering);
  bool gives_up_home(std::size_t tries, std::size_t places, const PlannerInput& in);
  bool flies_along() const;
  Doing::What doing_home(const PlannerInput& in) const;
  void enter(Mode mode, const PlannerInput& in);

  const FlightConfig& config_;
  const AgentConfig& agent_;
  Caution caution_;
  SafetyFilter filter_;
  ToldSpace told_;
  Navigator navigator_;
  Homing homing_;
  Recovery recovery_;
  Showing showing_;
  MakingRoom making_room_;
  Landing landing_;
  Takeoff takeoff_;
  Mode mode_ = Mode::ground;
  Tick since_ = 0;                        ///< when this mode began, or a goal was last flown in it
  Tick show_at_ = 0;                      ///< earliest time to look for the next photographer to show the way up
  std::optional<Tick> at_place_since_;    ///< when homing reached its place, still without a link
  std::size_t next_place_ = 0;            ///< index of the place that homing tries first
  Vector3d held_p_W_ = Vector3d::Zero();  ///< where the safety filter held the UAV on its way to goals, ...
  double held_s_ = 0.0;                   ///< ... and for how long since it was last 0.5 m away or reached a goal
  std::size_t missed_home_ = 0;           ///< how often homing found no way since captures were last delivered
  bool lost_way_home_ = false;            ///< the UAV recovers because of that
  std::optional<Vector3d> room_W_;        ///< where the UAV makes room for another one
  std::vector<Outcome> outcomes_;         ///< outcomes that the planner has not received yet
  std::vector<Goal> wanted_;              ///< the planner's last goals, for when `working` begins again
  std::optional<std::int64_t> cut_id_;    ///< the goal among them that was interrupted on its way, ...
  std::size_t cut_legs_ = 0;              ///< ... and lacks the first waypoints, which the UAV has passed
  std::optional<std::size_t> waits_for_;
  std::string no_way_;
};

}  // namespace skein::agent
