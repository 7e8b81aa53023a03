// The messages of KIOS's UAVs on /plan: the sender's stage, stop and claimed cubes, and its map (map_exchange).
// Frame W.   Units: SI.   Threads: one.   Bounded: one message per share_s, size in uav_agent/api/payload.hpp.
// Source: paper ("exchanging data whenever LoS is available"; no two UAVs in one voxel); the format is our own.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/kios/config.hpp"

namespace skein::agent {

class KiosTalk {
 public:
  using Id = VoxelGrid::Id;
  static constexpr std::uint32_t kNoStop = std::numeric_limits<std::uint32_t>::max();

  struct Config {
    double share_s = KiosConfig().share_s;                  ///< time between two messages
    double claim_s = KiosConfig().claim_s;                  ///< age at which a claim expires
    std::size_t max_claims = KiosConfig::kMostReserve + 1;  ///< most claims in a message
  };

  /// Content of a UAV's message.
  struct Word {
    bool mapping = false;                ///< it has not flown its lanes yet
    std::uint32_t stop = kNoStop;        ///< id of the stop that it flies to or photographs from (stops.hpp)
    Vector3d goal_W = Vector3d::Zero();  ///< position of this stop
    std::vector<Id> claims = {};         ///< the cube that it is in, and the next ones on its way
    Tick heard = 0;                      ///< when it was received
  };

  /// @param agent  must outlive this.
  KiosTalk(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Reads the received messages, and merges the other UAVs' maps into `grid`.
  void listen(const PlannerInput& in, VoxelGrid& grid);
  /// Sends `own` and the map, if a message is due.
  void speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out);

  /// The last message of a UAV; nullopt: none was received.
  std::optional<Word> word(std::size_t uav) const;
  /// Cubes that other UAVs claim now.
  std::set<Id> claimed(Tick now) const;
  /// Stops that other UAVs fly to or photograph from now.
  std::set<std::uint32_t> taken(Tick now) const;

 private:
  bool valid(const Word& word, Tick now) const { return seconds(now - word.heard) < config_.claim_s; }

  const Config config_;
  const AgentConfig& agent_;
  MapExchange exchange_;
  std::map<std::size_t, Word> words_;  ///< by UAV
};

}  // namespace skein::agent
