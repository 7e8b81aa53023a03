// What STAR's UAVs tell each other on /plan: how far they are, where they go, and the map with the surface that was
// inspected (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message now and then, see uav_agent/api/payload.hpp.
// Source: paper (map chunks as in RACER; inspected surfaces shared among photographers); the format, and that all UAVs
// hear it and not just the team, is our choice.
#pragma once

#include <map>
#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"

namespace skein::agent {

class StarTalk {
 public:
  struct Config {
    double share_s = 0.5;   ///< between two messages
    double forget_s = 5.0;  ///< a goal that was told longer ago is no goal
  };

  /// What one UAV said last.
  struct Word {
    bool explored = false;           ///< it sees no frontier any more, or has nothing to explore with
    std::size_t box = 0;             ///< that it is at
    std::optional<Vector3d> goal_W;  ///< where it is about to work
    Tick heard = 0;
  };

  /// @param agent  must outlive this.
  StarTalk(const Config& config, const AgentConfig& agent);

  /// Takes what arrived, the others' maps into `grid`.
  void listen(const PlannerInput& in, VoxelGrid& grid);
  /// When it is time, says `own` and the map.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out);

  /// nullopt: never heard.
  std::optional<Word> word(std::size_t uav) const;
  /// Where others are about to work.
  std::vector<Vector3d> goals_W(Tick now) const;

 private:
  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Word> words_;  ///< by UAV
};

}  // namespace skein::agent
