// What KIOS's UAVs tell each other on /plan: what they are about, which cubes they claim, and the map (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message now and then, see uav_agent/api/payload.hpp.
// Source: paper ("exchanging data whenever LoS is available"; no two UAVs in one voxel); the format is our own.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"

namespace skein::agent {

class KiosTalk {
 public:
  using Id = VoxelGrid::Id;
  static constexpr std::uint32_t kNoStop = 0xFFFFFFFF;

  struct Config {
    double share_s = 0.5;        ///< between two messages
    double claim_s = 3.0;        ///< what was claimed longer ago is free again
    std::size_t max_claims = 8;  ///< in a message
  };

  /// What one UAV said last.
  struct Word {
    bool mapping = false;          ///< has not flown its lanes yet
    std::uint32_t stop = kNoStop;  ///< that it flies to, see stops.hpp
    Vector3d goal_W = Vector3d::Zero();
    std::vector<Id> claims = {};  ///< where it is, and where it goes next
    Tick heard = 0;
  };

  /// @param agent  must outlive this.
  KiosTalk(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Takes what arrived, the others' maps into `grid`.
  void listen(const PlannerInput& in, VoxelGrid& grid);
  /// When it is time, says `own` and the map.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out);

  /// nullopt: never heard.
  std::optional<Word> word(std::size_t uav) const;
  /// Cubes that others claim now.
  std::set<Id> claimed(Tick now) const;
  /// Stops that others fly to now.
  std::set<std::uint32_t> taken(Tick now) const;

 private:
  bool valid(const Word& word, Tick now) const { return seconds(now - word.heard) < config_.claim_s; }

  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Word> words_;  ///< by UAV
};

}  // namespace skein::agent
