// What the UAVs of a flock tell each other on /plan: the views that each is about to take and how much they promise,
// the points that the fleet has found (points.hpp), and the map with the surface that was looked at (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message now and then, see uav_agent/api/payload.hpp.
#pragma once

#include <map>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/flock/points.hpp"

namespace skein::agent {

/// A view that a UAV is about to take.
struct FlockClaim {
  Vector3d p_WB = Vector3d::Zero(), aim_W = Vector3d::Zero();
};

/// What a UAV says of itself.
struct FlockWord {
  std::vector<FlockClaim> claims = {};
  double rate = 0.0;  ///< that its routes promise [points/s], to 0.1
};

class FlockTalk {
 public:
  static constexpr std::size_t kMostClaims = 3;

  struct Config {
    double share_s = 0.5;  ///< between two messages
    double claim_s = 4.0;  ///< an older claim does not count
  };

  /// @param agent  must outlive this.
  FlockTalk(const Config& config, const AgentConfig& agent);

  /// Takes what arrived: the others' maps into `grid`, points into `points`.
  void listen(const PlannerInput& in, VoxelGrid& grid, FlockPoints& points);
  /// When it is time, tells a word, points and map.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const FlockPoints& points, const FlockWord& word,
             PlannerOutput& out);

  /// By UAV, what it claims now.
  std::vector<std::pair<std::size_t, std::vector<FlockClaim>>> claims(Tick now) const;
  /// What the routes of the others that were heard of late promise.
  std::vector<double> rates(Tick now) const;

 private:
  struct Heard {
    FlockWord word;
    Tick at = 0;
  };

  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Heard> words_;  ///< the last one, by UAV
};

}  // namespace skein::agent
