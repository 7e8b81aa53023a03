// The sources from which a UAV learns of free space: its own LiDAR, or map messages of other UAVs.
// Threads: one.   Deterministic.   Source: our own rules.
#pragma once

#include <cstddef>
#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

/// Whether the UAV's own LiDAR works: an explorer's does until it has delivered no scan for 3 s.
class OwnSight {
 public:
  /// @param agent  must outlive this.
  explicit OwnSight(const AgentConfig& agent);
  /// Call it once per exchange.
  void update(const PlannerInput& in);
  bool sees() const { return sees_; }

 private:
  const AgentConfig& agent_;
  bool sees_;
  std::optional<Tick> scanned_at_;
};

/// A UAV without a working LiDAR learns of free space by radio. If its map does not change for alone_s, and holds only
/// the space around its start or has not shown the UAV its way up, its safety filter assumes that space outside the
/// boxes is free, except known structure (SafetyFilter::assume_boxes()). It no longer does so once the UAV has left its
/// start, and is in proved space of a map that it has received. Does nothing in a fleet without an explorer.
class ToldSpace {
 public:
  /// @param config, agent  must outlive this.
  ToldSpace(const FlightConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}
  /// Call it once per exchange. @param sees  OwnSight::sees()
  void listen(const PlannerInput& in, bool sees, SafetyFilter& filter);

 private:
  const FlightConfig& config_;
  const AgentConfig& agent_;
  std::optional<Tick> told_at_;  ///< when the map last changed
  std::uint64_t told_changes_ = 0;
  bool has_left_ = false;  ///< the UAV was away from its start once
};

}  // namespace skein::agent
