// Shares the world map by radio: sends the messages of MapNews on /plan in envelopes of their own, and enters those of
// other UAVs into this UAV's map. is_of_maps() recognises these messages, so that the agent can keep them from the
// planner.
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

/// In map messages, it replaces the planner's name and version in the envelope (payload.hpp). No planner has this name.
inline constexpr std::string_view kMapMessages = "map/1";

class MapRadio {
 public:
  explicit MapRadio(const AgentConfig& config)
      : fleet_(config.fleet.size()), self_(config.self), news_(self_, fleet_) {}

  static bool is_of_maps(const RadioMessage& message);  ///< whether it is a message of map sharing

  /// Enters the received map messages into the map. Ignores messages of planners and damaged ones.
  void hear(std::span<const RadioMessage> received, Tick now, WorldMap& map);
  /// Makes this UAV's next map message. Call it at each exchange.
  /// @param map  the same at each call.   @param going_to_W  place that this UAV flies to, if known.
  /// @returns a message to all in line of sight, if one is due.
  std::optional<RadioMessage> tell(const WorldMap& map, const Peers& peers, const std::optional<Vector3d>& going_to_W,
                                   Tick now);

 private:
  const std::size_t fleet_;
  const UavIndex self_;
  MapNews news_;
};

}  // namespace skein::agent
