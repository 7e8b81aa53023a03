// How a UAV comes to know what is free: by its own LiDAR, or by what others tell it.
// Threads: one.   Deterministic.
#pragma once

#include <cstddef>
#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

/// Whether its own LiDAR tells something.
class OwnSight {
 public:
  /// @param agent  must outlive this.
  explicit OwnSight(const AgentConfig& agent);
  /// Once per exchange.
  void update(const PlannerInput& in);
  bool sees() const { return sees_; }

 private:
  const AgentConfig& agent_;
  bool sees_;
  std::optional<Tick> scanned_at_;
};

/// A UAV without a LiDAR, or whose LiDAR has failed, learns of free space by radio, or never: then it takes the boxes
/// to be all that there is.
class ToldSpace {
 public:
  /// @param config, agent  must outlive this.
  ToldSpace(const FlightConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}
  /// Once per exchange. @param sees  whether its own LiDAR tells something.
  void listen(const PlannerInput& in, bool sees, SafetyFilter& filter);

 private:
  const FlightConfig& config_;
  const AgentConfig& agent_;
  std::optional<Tick> told_at_;  ///< when it last was told of space in another region
  std::size_t told_regions_ = 0;
};

}  // namespace skein::agent
