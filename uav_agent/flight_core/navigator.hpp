// Flies to goals: the first of a ranked list to which there is a way. It plans through what is known to be free and, at
// a cost, through what is unknown; the safety filter (safety_filter.hpp) lets the UAV go only as far as is proved. A
// way that gains nothing for a while is given up, and the place that could not be proved is left out of ways for a
// time.
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

/// What the flight core asks of tracker and gimbal in an exchange.
struct Steering {
  Motion motion = {};
  std::optional<double> yaw = {};
  GimbalAim gimbal = {};
};

class Navigator {
 public:
  /// @param config, agent, filter  must outlive this.
  Navigator(const FlightConfig& config, const AgentConfig& agent, const SafetyFilter& filter);

  /// Once per exchange, before anything else.
  void update(const PlannerInput& in);
  /// Whether this UAV has a LiDAR that tells something: it may fly into the unknown, and proves it on the way.
  bool sees() const { return sight_.sees(); }
  /// What to fly to from now on. A goal that is being flown goes on if it is the first one; its way may have changed.
  void want(std::vector<Goal> goals);
  /// Flies back along its own trail, whose places are given from here on. Its body has been there: the safety filter
  /// asks for less about it, and nothing is looked for.
  void retrace(std::vector<Waypoint> trail);
  bool retraces() const { return current_ && retraces_; }
  /// Brakes, and wants nothing.
  void stop(Steering& steering);

  /// One exchange, with what the filter said of the last one.
  void step(const PlannerInput& in, const Held& held, Steering& steering);

  /// Turns the body of a UAV with a LiDAR step by step, so that the LiDAR sees more.
  void look_around(const PlannerInput& in, Steering& steering);
  /// How fast it may fly now, so that what is ahead is proved by the time that it gets there.
  double pace_mps() const { return pace_mps_; }
  /// No goal is being flown, and none is left to try.
  bool idle() const { return !current_ && goals_.empty(); }
  const std::optional<Goal>& current() const { return current_; }
  bool on_way() const { return on_way_; }
  std::size_t leg() const { return leg_; }
  /// Outcomes since it was last asked.
  std::vector<Outcome> take_outcomes() { return std::exchange(outcomes_, {}); }
  /// The last place to which there was no way.
  const std::optional<Vector3d>& missed_W() const { return missed_W_; }
  /// Where it is about to fly.
  std::optional<Vector3d> going_to_W() const;

  /// Where this UAV may plan to fly as of now, other UAVs and refused places left out.
  FreeSpace space(const PlannerInput& in) const { return space(in, in.tracking.setpoint.p_WB); }
  /// The same with them: for strategies, which choose where to work.
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
  std::vector<Goal> goals_;  ///< that are not flown yet, what is liked best first
  std::optional<Goal> current_;
  bool on_way_ = false;
  std::size_t leg_ = 0;
  std::vector<Waypoint> path_;  ///< being flown: to the goal's first waypoint, or along its way
  bool new_way_ = false;        ///< the current goal's way has changed
  bool retraces_ = false;       ///< the current goal is its own trail
  int replans_ = 0;             ///< for the current goal
  Tick search_at_ = 0;          ///< not before
  double pace_mps_ = std::numeric_limits<double>::infinity();
  std::deque<Refused> refused_;
  std::vector<Outcome> outcomes_;
  std::optional<Vector3d> missed_W_;
  Vector3d gained_p_W_ = Vector3d::Zero();  ///< where it last got on
  Tick gained_at_ = 0, turn_at_ = 0;
};

}  // namespace skein::agent
