// What XXH's UAVs and its ground station tell each other on /plan. UAVs: where they start, whether they have the
// assignment, how far they are with their region, which trajectory they are about to fly, and the region's map. The
// station: the assignment.
// Frame W.   Units: SI.   Threads: one.   Bounded: one message now and then, see uav_agent/api/payload.hpp.
// Source: paper, "Task Assignment" and "Inspection Strategy" (real-time positions and trajectories are shared); the
// format is our own.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/xxh/plan.hpp"

namespace skein::agent {

/// What one UAV said last.
struct XxhWord {
  static constexpr std::size_t kMaxWay = 8;

  Vector3d start_W = Vector3d::Zero();
  bool has_plan = false;
  std::uint16_t region = 0;          ///< index in its team's list; past the end: all done
  bool from_high_end = false;        ///< of its longest edge that region is begun
  bool decided = false;              ///< so, by a leader
  std::uint8_t explored = 0;         ///< sections of it that may be inspected, for a leader
  bool acknowledged = false;         ///< knows that its own section may be inspected
  bool done = false;                 ///< with its section
  std::vector<Vector3d> way_W = {};  ///< where it is told to be, and the corners that come next
  Tick heard = 0;
};

void write_word(const XxhWord& word, PayloadWriter& writer);
std::optional<XxhWord> read_word(PayloadReader& reader);

/// The assignment as the station says it. @param station  index after the last UAV.
RadioMessage plan_message(const XxhPlan& plan, std::size_t station);
/// @returns nullopt if the message is no word of a UAV of the fleet; `rest` is what follows the word.
std::optional<std::pair<std::size_t, XxhWord>> open_word(const RadioMessage& message, std::size_t fleet_size,
                                                         std::vector<std::uint8_t>* rest = nullptr);

class XxhTalk {
 public:
  struct Config {
    double share_s = 0.5;
    double claim_s = 3.0;
    bool all_give_way = false;  ///< also those who go first
  };

  /// @param agent  must outlive this.
  XxhTalk(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Takes what arrived, maps of the present region into `grid` if there is one.
  void listen(const PlannerInput& in, VoxelGrid* grid);
  /// When it is time, says `own` and the map.
  void speak(const PlannerInput& in, const VoxelGrid* grid, const XxhWord& own, PlannerOutput& out);
  /// Another region, or begun at its other end: nobody is known to know anything of its map.
  void new_map(std::uint16_t region, bool from_high_end) { map_.emplace(RegionMap{region, from_high_end, {}}); }

  /// The station's assignment, once heard.
  const std::optional<XxhPlan>& plan() const { return plan_; }
  /// nullptr: never heard.
  const XxhWord* word(std::size_t uav) const;
  /// Seconds since a UAV was heard; since the beginning if never.
  double silent_s(std::size_t uav, Tick now) const;
  /// Places to keep clear of: what those who go first are about to fly.
  std::vector<Sphere> trajectories(const PlannerInput& in) const;

 private:
  /// Who knows what of the map of a region. Another region, or the other end, is another map.
  struct RegionMap {
    std::uint16_t region = 0;
    bool from_high_end = false;
    MapExchange exchange;
  };

  bool goes_first(std::size_t uav) const;

  const Config config_;
  const AgentConfig& agent_;
  std::optional<RegionMap> map_;          ///< the present one
  std::map<std::size_t, XxhWord> words_;  ///< by UAV
  std::optional<XxhPlan> plan_;
};

}  // namespace skein::agent
