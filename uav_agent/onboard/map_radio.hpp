// Tells the other UAVs what this one knows of the world, and hears what they tell, for the on-board software: puts the
// messages of MapNews into envelopes of their own on /plan, and takes them out of what arrives, so that no planner
// sees them.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/maps/map_news.hpp"

namespace skein::agent {

/// In the place of a planner's name and version (payload.hpp): no planner has it.
inline constexpr std::string_view kMapMessages = "map/1";

class MapRadio {
 public:
  /// @throws std::invalid_argument for a fleet of more than kMostUavs.
  explicit MapRadio(const AgentConfig& config)
      : fleet_(config.fleet.size()), self_(config.self), news_(self_, fleet_) {}

  static bool is_of_maps(const RadioMessage& message);

  /// Takes what others told into the map. Messages of planners, and what is damaged, change nothing.
  void hear(std::span<const RadioMessage> received, Tick now, WorldMap& map);
  /// Called at each exchange.
  /// @param map  the same at each call.   @param going_to_W  where this UAV is about to fly, if that is known.
  /// @returns a message to all in line of sight, if one is due.
  std::optional<RadioMessage> tell(const WorldMap& map, const Peers& peers, const std::optional<Vector3d>& going_to_W,
                                   Tick now);

 private:
  const std::size_t fleet_;
  const UavIndex self_;
  MapNews news_;
};

}  // namespace skein::agent
