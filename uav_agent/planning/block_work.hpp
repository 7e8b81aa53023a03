// Strips for site boxes (is_site_box() in flight/site.hpp): one box around a whole site, most of it empty. The box is
// cut into blocks. The occupied cells of a block get a tight box, whose faces are flown as strips. So the strips follow
// the structure as far as it is known, and their number rises as the map grows. A block's number determines which UAV
// owns it: all UAVs agree on the owners, however much their maps differ. A UAV prefers its own blocks, and then helps
// with the others.
// Frame W.   Units: SI.   Threads: one.   Effort: one pass over all occupied cells at most every look_again_s.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "uav_agent/flight/site.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

/// Index in the fleet of a block's owner. With four UAVs or more, blocks with a common face have different owners, so
/// that several UAVs share structure anywhere.
/// @param block  index of the block along the box's axes.
std::size_t block_owner(const Eigen::Vector3i& block, std::size_t uavs);

class BlockWork {
 public:
  struct Config {
    StripConfig strips;
    double block_m = 12.0;      ///< approximate edge of a block; chosen
    double transit_mps = 4.5;   ///< speed between strips, for costs; chosen
    double look_again_s = 8.0;  ///< least time between two looks at the map; chosen
  };
  /// Identifies a strip: site box, block, direction of the face along the box's axes (0 to 5), number on that face.
  using Key = std::tuple<std::size_t, std::size_t, int, int>;
  struct Task {
    Key key;
    Strip strip;
    bool reversed = false;
    int flown = 0;  ///< how often this UAV has flown it
  };

  /// @param boxes  only site boxes are used.   @param agent, reach  must outlive this.
  BlockWork(const Config& config, const AgentConfig& agent, const CameraReach& reach,
            const std::vector<OrientedBox>& boxes);

  bool any() const { return !sites_.empty(); }  ///< whether there is a site box
  /// The strip to fly next: the one with the least cost, which is the transit time plus penalties for another UAV's
  /// block, earlier flights and failures. nullopt: the map shows no structure there, or all strips failed recently.
  std::optional<Task> next(Tick now, const Vector3d& p_WB, const OccupancyMap& map);
  void flown(const Task& task) { ++records_[task.key].flown; }
  /// The task could not be flown: it is not offered again for 30 s, longer after each further failure.
  void failed(const Task& task, Tick now);

 private:
  struct Site {
    OrientedBox box;
    Eigen::Vector3i count;  ///< number of blocks along the box's axes
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
  /// Makes the strips of a block. @param box  tight box. @param extents_O  of each block's cells, in the site's frame.
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
