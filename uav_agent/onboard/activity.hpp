// What a UAV does and why, in words: the one place that has them (topic /{id}/activity, docs/view.md). Nothing that
// flies asks it.
//
// It tells when that changes, else once a second. What lasts an exchange or two is not told as a change: the moment
// between two goals, or a peer in the way whom the UAV does not even slow down for.
// Frame W.   Units: SI.   Deterministic: cpu_s is left at 0.   Threads: one.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/activity.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

/// Of a planner that the flight core does not fly: what it last asked for.
struct OwnMotion {
  enum class Kind { none, setpoint, path, hold, command };
  Kind kind = Kind::none;
  std::optional<Vector3d> end_W = {};  ///< of a path that is not over
};

/// One exchange, as it ends.
struct ActivityFacts {
  Tick tick = 0;
  std::variant<Doing, OwnMotion> what;
  Vector3d p_WB = Vector3d::Zero();
  double speed_mps = 0.0;
  std::size_t undelivered = 0;
  Held held = {};                             ///< by the safety filter
  std::optional<std::size_t> waits_for = {};  ///< index in the fleet
  std::string no_way = {};                    ///< news: that it found none in this exchange, and why
};

class ActivityTeller {
 public:
  /// @param fleet  must outlive this.
  explicit ActivityTeller(const std::vector<FleetMember>& fleet) : fleet_(fleet) {}

  /// @returns what to tell with this exchange; nullopt: nothing.
  std::optional<Activity> step(const ActivityFacts& facts);

 private:
  std::string mode_of(const ActivityFacts& facts) const;
  std::string name_of(const std::optional<std::size_t>& uav) const;
  void note_standstill(const ActivityFacts& facts);
  void note_waiting(const ActivityFacts& facts);
  void note_no_way(const ActivityFacts& facts);

  const std::vector<FleetMember>& fleet_;
  Activity now_;                       ///< as it stands
  std::optional<Activity> told_;       ///< last
  Tick due_ = 0;                       ///< at the latest
  std::optional<Tick> between_since_;  ///< it has no goal that it flies to
  std::optional<Tick> slow_since_;     ///< it stands
  std::optional<Tick> held_since_;     ///< by the safety filter, with somewhere to go
  Doing::What before_ = Doing::What::ground;
  std::optional<Vector3d> last_goal_W_;
  bool rests_ = false, held_ = false;
  std::optional<std::size_t> waits_for_;
  Tick waited_at_ = 0, no_way_at_ = 0;
};

}  // namespace skein::agent
