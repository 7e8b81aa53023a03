// Describes in words what a UAV does and why (topic /{id}/activity, docs/view.md); all these words are here. Nothing
// that controls the flight reads them.
//
// A message is due when the description changes, else once a second. Short states are not reported as a change: up to
// 0.5 s between two goals, or a peer in the way for which the UAV stops for less than 1 s.
// Frame W.   Units: SI.   Deterministic: cpu_s is left at 0.   Threads: one.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/messages/activity.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

/// For a planner that does not use the flight core: the motion that it requested last.
struct OwnMotion {
  enum class Kind { none, setpoint, path, hold, command };
  Kind kind = Kind::none;
  std::optional<Vector3d> end_W = {};  ///< end of a path that is not finished
};

/// The UAV's state at the end of an exchange.
struct ActivityFacts {
  Tick tick = 0;
  std::variant<Doing, OwnMotion> what;
  Vector3d p_WB = Vector3d::Zero();
  double speed_mps = 0.0;
  std::size_t undelivered = 0;
  Held held = {};                             ///< why the safety filter slows the UAV down
  std::optional<std::size_t> waits_for = {};  ///< index in the fleet of the UAV that it waits for
  std::string no_way = {};                    ///< why no path was found in this exchange; empty: no search failed
};

class ActivityTeller {
 public:
  /// @param fleet  must outlive this.
  explicit ActivityTeller(const std::vector<FleetMember>& fleet) : fleet_(fleet) {}

  /// Call it once per exchange. @returns the message that is due in this exchange; nullopt: none.
  std::optional<Activity> step(const ActivityFacts& facts);

 private:
  std::string mode_of(const ActivityFacts& facts) const;
  std::string name_of(const std::optional<std::size_t>& uav) const;
  void note_standstill(const ActivityFacts& facts);
  void note_waiting(const ActivityFacts& facts);
  void note_no_way(const ActivityFacts& facts);

  const std::vector<FleetMember>& fleet_;
  Activity now_;                       ///< the present description
  std::optional<Activity> told_;       ///< the last message
  Tick due_ = 0;                       ///< latest time of the next message
  std::optional<Tick> between_since_;  ///< since when the UAV has flown to no goal
  std::optional<Tick> slow_since_;     ///< since when the UAV has stood still
  std::optional<Tick> held_since_;     ///< since when the safety filter has stopped the UAV on its way
  Doing::What before_ = Doing::What::ground;
  std::optional<Vector3d> last_goal_W_;
  bool rests_ = false, held_ = false;
  std::optional<std::size_t> waits_for_;
  Tick waited_at_ = 0, no_way_at_ = 0;
};

}  // namespace skein::agent
