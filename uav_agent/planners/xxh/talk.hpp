// The messages of XXH on /plan. A UAV sends its start, whether it has the assignment, its progress in its region, the
// trajectory that it is about to fly, and the region's map. The ground station sends the assignment.
// Frame W.   Units: SI.   Threads: one.   Bounded: one message per share_s, size in uav_agent/api/payload.hpp.
// Source: paper, "Task Assignment" and "Inspection Strategy" (real-time positions and trajectories are shared); the
// format is our own.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/map_exchange.hpp"
#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/plan.hpp"

namespace skein::agent {

/// A UAV's message, except for the map.
struct XxhWord {
  static constexpr std::size_t kMaxWay = 8;  ///< most corners of way_W in a message; chosen

  Vector3d start_W = Vector3d::Zero();
  bool has_plan = false;
  std::uint16_t region = 0;          ///< counts on through the rounds; past the end: all done
  bool from_high_end = false;        ///< the region is begun at the high end of its longest edge
  bool decided = false;              ///< from_high_end is final
  std::uint8_t explored = 0;         ///< leader: number of sections that may be inspected
  bool acknowledged = false;         ///< the UAV knows that its own section may be inspected
  bool done = false;                 ///< the UAV is done with its section
  std::vector<Vector3d> way_W = {};  ///< its setpoint, and the next corners of its way
  Tick heard = 0;                    ///< when it was received
};

void write_word(const XxhWord& word, PayloadWriter& writer);
std::optional<XxhWord> read_word(PayloadReader& reader);  ///< nullopt if the message is damaged

/// The station's message with the assignment. @param station  sender: index after the last UAV.
RadioMessage plan_message(const XxhPlan& plan, std::size_t station);
/// @param rest  gets the bytes after the word: the map.
/// @returns sender and word; nullopt if the message is not a valid word of a UAV of the fleet.
std::optional<std::pair<std::size_t, XxhWord>> open_word(const RadioMessage& message, std::size_t fleet_size,
                                                         std::vector<std::uint8_t>* rest = nullptr);

class XxhTalk {
 public:
  struct Config {
    double share_s = XxhConfig().share_s;  ///< time between two messages
    /// Age at which an announced trajectory expires.
    double claim_s = XxhConfig().resolved().claim_s.value();
    bool all_give_way = false;  ///< UAVs with priority avoid announced trajectories, too
  };

  /// @param agent  must outlive this.
  XxhTalk(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Reads the received messages; merges maps of the present region into `grid`, unless that is nullptr.
  void listen(const PlannerInput& in, VoxelGrid* grid);
  /// Sends `own` and the map, if a message is due.   @param grid  nullptr: no map.
  void speak(const PlannerInput& in, const VoxelGrid* grid, const XxhWord& own, PlannerOutput& out);
  /// Call it for another region, or another end: forgets what the other UAVs know of the map.
  void new_map(std::uint16_t region, bool from_high_end) { map_.emplace(RegionMap{region, from_high_end, {}}); }

  /// The station's assignment; nullopt until it is received.
  const std::optional<XxhPlan>& plan() const { return plan_; }
  /// The last message of a UAV; nullptr: none was received.
  const XxhWord* word(std::size_t uav) const;
  /// Time since a UAV's last message, or since the beginning of the run [s].
  double silent_s(std::size_t uav, Tick now) const;
  /// Spheres to keep clear of, along the trajectories that UAVs with priority have announced.
  std::vector<Sphere> trajectories(const PlannerInput& in) const;

 private:
  /// What the other UAVs know of the map of a region. Each region has a map for each of its ends.
  struct RegionMap {
    std::uint16_t region = 0;
    bool from_high_end = false;
    MapExchange exchange;
  };

  bool has_priority(std::size_t uav) const;

  const Config config_;
  const AgentConfig& agent_;
  std::optional<RegionMap> map_;          ///< of the present region
  std::map<std::size_t, XxhWord> words_;  ///< by UAV
  std::optional<XxhPlan> plan_;
};

}  // namespace skein::agent
