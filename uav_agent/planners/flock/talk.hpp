// The messages of a flock's UAVs on /plan: the views that the sender is about to take and the gain that they promise,
// the points that the fleet has found (points.hpp), and the map with the surface that was looked at (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message per share_s, size in uav_agent/api/payload.hpp.
#pragma once

#include <map>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/flock/config.hpp"
#include "uav_agent/planners/flock/points.hpp"

namespace skein::agent {

/// A view that a UAV is about to take.
struct FlockClaim {
  Vector3d p_WB = Vector3d::Zero(), aim_W = Vector3d::Zero();
};

/// A UAV's announcement.
struct FlockWord {
  std::vector<FlockClaim> claims = {};
  double rate = 0.0;  ///< gain that its routes promise [points/s], rounded to 0.1
};

class FlockTalk {
 public:
  static constexpr std::size_t kMostClaims = 3;  ///< in a message; chosen

  struct Config {
    double share_s = FlockConfig().share_s;  ///< time between two messages
    double claim_s = FlockConfig().claim_s;  ///< age at which a claim expires
  };

  /// @param agent  must outlive this.
  FlockTalk(const Config& config, const AgentConfig& agent);

  /// Reads the received messages, and merges the other UAVs' maps into `grid` and their points into `points`.
  void listen(const PlannerInput& in, VoxelGrid& grid, FlockPoints& points);
  /// Sends `word`, points and map, if a message is due.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const FlockPoints& points, const FlockWord& word,
             PlannerOutput& out);

  /// The present claims, by UAV.
  std::vector<std::pair<std::size_t, std::vector<FlockClaim>>> claims(Tick now) const;
  /// The promised gains of the other UAVs heard in the last 20 s [points/s].
  std::vector<double> rates(Tick now) const;

 private:
  struct Heard {
    FlockWord word;
    Tick at = 0;
  };

  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Heard> words_;  ///< the last one of each UAV
};

}  // namespace skein::agent
