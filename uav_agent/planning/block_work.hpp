// Work in boxes that say little: one box around a whole site, most of it empty. Such a box is cut into blocks. What
// the map shows in a block gets a tight box of its own, whose faces are flown as strips; so the strips follow the
// structure as far as it is known, and become more as the map grows. The blocks are dealt out by number: all UAVs
// agree on whose a block is, however much their maps differ. Who is done with its own goes on with the others'.
// Frame W.   Units: SI.   Threads: one.   Effort: a look at all occupied cells every few seconds, no more.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "uav_agent/flight/site.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

/// Whose a block is; neighbours go to different UAVs, so that structure anywhere is shared.
/// @param block  its place along the box's axes.
std::size_t block_owner(const Eigen::Vector3i& block, std::size_t uavs);

class BlockWork {
 public:
  struct Config {
    StripConfig strips;
    double block_m = 12.0;  ///< edges, about
    double transit_mps = 4.5;
    double look_again_s = 8.0;  ///< at the map
  };
  /// A strip: box, block, direction of its face, number on that face.
  using Key = std::tuple<std::size_t, std::size_t, int, int>;
  struct Task {
    Key key;
    Strip strip;
    bool reversed = false;
    int flown = 0;  ///< so often already, by this UAV
  };

  /// @param boxes  of which the roomy ones (flight/site.hpp) are taken.   @param agent, reach  must outlive this.
  BlockWork(const Config& config, const AgentConfig& agent, const CameraReach& reach,
            const std::vector<OrientedBox>& boxes);

  bool any() const { return !sites_.empty(); }
  /// What to fly next: near by, own, not flown yet. nullopt: nothing on the map, or all of it tried in vain lately.
  std::optional<Task> next(Tick now, const Vector3d& p_WB, const OccupancyMap& map);
  void flown(const Task& task) { ++records_[task.key].flown; }
  /// It could not be flown: something else first.
  void failed(const Task& task, Tick now);

 private:
  struct Site {
    OrientedBox box;
    Eigen::Vector3i count;  ///< of blocks along its axes
  };
  struct Job {
    Key key;
    Strip strip;
    bool own = false;
  };
  struct Record {
    int flown = 0, failed = 0;
    Tick not_before = 0;
  };

  void look(const OccupancyMap& map);
  /// @param extents_O  of all blocks' structure, along the site's axes.
  void cut(std::size_t site, std::size_t block, const OrientedBox& box,
           const std::vector<Eigen::AlignedBox3d>& extents_O);

  const Config config_;
  const AgentConfig& agent_;
  const CameraReach& reach_;
  std::vector<Site> sites_;
  std::vector<Job> jobs_;
  std::map<Key, Record> records_;
  std::uint64_t revision_ = 0;
  std::optional<Tick> looked_at_;
};

}  // namespace skein::agent
