// Flies to goals: to the first of a ranked list to which it finds a path. Paths lead through free space and, at a cost,
// through unknown space; the safety filter (safety_filter.hpp) lets the UAV fly only through space that is proved free.
// If the UAV makes no progress on a path, the navigator gives the path up. For some time, later paths avoid the place
// where the safety filter held the UAV.
// Frame W.   Units: SI.   Threads: one.   Deterministic: effort is bounded by counts.
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"
#include "uav_agent/flight_core/sight.hpp"

namespace skein::agent {

/// The flight core's requests to tracker and gimbal in one exchange. Empty values: no change.
struct Steering {
  Motion motion = {};
  std::optional<double> yaw = {};
  GimbalAim gimbal = {};
};

class Navigator {
 public:
  /// @param config, agent, filter  must outlive this.
  Navigator(const FlightConfig& config, const AgentConfig& agent, const SafetyFilter& filter);

  /// Call it once per exchange, before the other functions.
  void update(const PlannerInput& in);
  /// Whether this UAV has a working LiDAR. Then paths may lead through unknown space, which is proved on the way.
  bool sees() const { return sight_.sees(); }
  /// Replaces the goals. The goal being flown goes on if the first of `goals` has its id; its way may have changed.
  void want(std::vector<Goal> goals);
  /// Flies back along the UAV's own trail, without a path search. Because the UAV's body has been there, the safety
  /// filter requires less free space around it. @param trail  in the order of flight, from the present position on.
  void retrace(std::vector<Waypoint> trail);
  bool retraces() const { return current_ && retraces_; }
  /// Brakes, and drops all goals.
  void stop(Steering& steering);
  /// The same, with an outcome for the goal being flown.
  void give_up(const std::string& reason, Steering& steering);

  /// Runs one exchange. @param held  SafetyFilter::held() of the last exchange.
  void step(const PlannerInput& in, const Held& held, Steering& steering);

  /// Turns the body of a UAV with a LiDAR step by step, so that the LiDAR sees more.
  void look_around(const PlannerInput& in, Steering& steering);
  /// Maximum speed at which the LiDAR proves the space ahead before the UAV gets there [m/s]; infinite without one.
  double pace_mps() const { return pace_mps_; }
  /// Whether no goal is being flown, and none is left to try.
  bool idle() const { return !current_ && goals_.empty(); }
  const std::optional<Goal>& current() const { return current_; }
  /// Whether the UAV has reached the current goal's first waypoint, and flies along Goal::way.
  bool on_way() const { return current_ && on_way_; }
  /// Index in Goal::way of the waypoint that the UAV flies to; only if on_way().
  std::size_t leg() const { return leg_; }
  /// Outcomes since the last call.
  std::vector<Outcome> take_outcomes() { return std::exchange(outcomes_, {}); }
  /// First waypoint of the last goal that ended with no_way; nullopt once another goal is reached.
  const std::optional<Vector3d>& missed_W() const { return missed_W_; }
  /// The place to which the UAV flies: the goal's first waypoint, or the last one if on_way(). Without a goal,
  /// missed_W().
  std::optional<Vector3d> going_to_W() const;

  /// Space for path search as of now. Places near other UAVs, and places that could not be proved free, are excluded.
  FreeSpace space(const PlannerInput& in) const { return space(in, in.tracking.setpoint.p_WB); }
  /// The same without these exclusions, for planners, which choose where to work.
  FreeSpace open_space(const PlannerInput& in) const { return {space_config(in), in.boxes, in.map}; }

 private:
  enum class Search { found, none, gave_up };

  FreeSpace::Config space_config(const PlannerInput& in) const;
  FreeSpace space(const PlannerInput& in, const Vector3d& from_W) const;
  Vector3d way_begins_W(const PlannerInput& in) const;
  void choose(const PlannerInput& in, Steering& steering);
  Search set_out(const PlannerInput& in, Steering& steering);
  void begin_way(const PlannerInput& in, Steering& steering);
  void fly(std::vector<Waypoint> waypoints, Steering& steering);
  void end(Outcome::Kind kind, std::string reason, Steering& steering);
  void refuse(const Vector3d& p_W, const PlannerInput& in);
  bool blocked_ahead(const PlannerInput& in) const;
  void replan(const PlannerInput& in, const std::string& reason, Steering& steering);
  void watch(const PlannerInput& in, const Held& held, Steering& steering);
  void stalled(const PlannerInput& in, const Held& held, Steering& steering);
  double proved_ahead_m(const PlannerInput& in, double most_m) const;
  void face_ahead(const PlannerInput& in, Steering& steering) const;

  struct Refused {
    Vector3d p_W;
    Tick until = 0;
  };

  const FlightConfig& config_;
  const AgentConfig& agent_;
  const SafetyFilter& filter_;
  BodyFit fit_;
  OwnSight sight_;
  std::vector<Goal> goals_;  ///< not flown yet, best first
  std::optional<Goal> current_;
  bool on_way_ = false;
  std::size_t leg_ = 0;
  std::vector<Waypoint> path_;  ///< being flown: to the goal's first waypoint, or along Goal::way
  bool new_way_ = false;        ///< want() has changed the way of the current goal
  bool retraces_ = false;       ///< the current goal is the UAV's own trail
  int replans_ = 0;             ///< number of new searches for the current goal
  Tick search_at_ = 0;          ///< earliest time of the next search
  double pace_mps_ = std::numeric_limits<double>::infinity();
  std::deque<Refused> refused_;
  std::vector<Outcome> outcomes_;
  std::optional<Vector3d> missed_W_;
  Vector3d gained_p_W_ = Vector3d::Zero();  ///< where the UAV last made progress, at gained_at_
  Tick gained_at_ = 0, turn_at_ = 0;
};

}  // namespace skein::agent
