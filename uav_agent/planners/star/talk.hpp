// The messages of STAR's UAVs on /plan: the sender's progress and goal, and its map with the marks of inspected surface
// (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message per share_s, size in uav_agent/api/payload.hpp.
// Source: paper (map chunks as in RACER; inspected surfaces shared among photographers); the format, and that all UAVs
// use the messages and not just the team, is our choice.
#pragma once

#include <map>
#include <optional>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/star/config.hpp"

namespace skein::agent {

class StarTalk {
 public:
  struct Config {
    double share_s = StarConfig().share_s;  ///< time between two messages
    double forget_s = 5.0;                  ///< age at which another UAV's goal no longer counts; chosen
  };

  /// Content of a UAV's message.
  struct Word {
    bool explored = false;           ///< it has explored all its boxes, or has no LiDAR
    std::size_t box = 0;             ///< index of the box where it works
    std::optional<Vector3d> goal_W;  ///< where it is about to work
    Tick heard = 0;                  ///< when it was received
  };

  /// @param agent  must outlive this.
  StarTalk(const Config& config, const AgentConfig& agent);

  /// Reads the received messages, and merges the other UAVs' maps into `grid`.
  void listen(const PlannerInput& in, VoxelGrid& grid);
  /// Sends `own` and the map, if a message is due.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out);

  /// The last message of a UAV; nullopt: none was received.
  std::optional<Word> word(std::size_t uav) const;
  /// Where other UAVs are about to work.
  std::vector<Vector3d> goals_W(Tick now) const;

 private:
  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Word> words_;  ///< by UAV
};

}  // namespace skein::agent
