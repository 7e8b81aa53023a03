// The layered inspection of XXH: which cell of a section to visit next, and what to do there. Layer after layer is
// inspected, cell by cell around the region; at a cell the gimbal turns to one occupied neighbour after the other.
// Frame W.   Units: SI and radians.   Threads: one.
// Source: paper, "Inspection Strategy" of Team XXH ("all exposed voxel faces", "a spiral pattern"); its public code for
// every third layer, the nearest cell first, the angle at which a target counts as reached
// and the 3 s at a cell. That the UAV comes to rest first, stays for a picture, and goes over its layers again for what
// it could not reach are ours.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/errand.hpp"
#include "uav_agent/planners/xxh/region.hpp"

namespace skein::agent {

class XxhInspector {
 public:
  /// Both must outlive this.
  XxhInspector(const XxhConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// A section of a region, from its first layer on.
  void begin(const XxhRegionMap::Section& section);
  bool finished() const { return layers_.empty() && !visit_; }

  /// Cells to choose from, the next one first; none when this layer is done: then the next one is tried next time.
  std::vector<Goal> choices(const XxhRegionMap& region, const Vector3d& here_W, const FreeSpace& space);
  /// Once per exchange: hears what became of these choices.
  void hear(const XxhErrand& errand);
  /// Where the camera looks on the way to a choice; nullptr: somebody else has looked at all of it in the meantime.
  const XxhTarget* ahead(std::size_t choice, const XxhRegionMap& region) const;

  /// The cell that it is at.
  const std::optional<XxhVisit>& visit() const { return visit_; }
  /// It was called away from it.
  void leave();
  /// Where the camera looks at the visited cell: at the first target that is left.
  const XxhTarget& target() const { return visit_->targets.front(); }
  /// Once per exchange at the cell; marks what is done. Afterwards visit() is empty when all of it is.
  void look(const PlannerInput& in, VoxelGrid& grid);

 private:
  void next_target(VoxelGrid& grid);

  const XxhConfig& config_;
  const AgentConfig& agent_;
  std::deque<int> layers_;  ///< left
  std::vector<int> all_layers_;
  int pass_ = 0;  ///< how often it has gone over the section's layers
  std::vector<XxhVisit> choices_;
  std::optional<VoxelGrid::Id> last_cell_;  ///< that it visited, from which the spiral goes on
  std::optional<XxhVisit> visit_;
  std::map<VoxelGrid::Id, int> failed_;
  std::optional<Tick> at_cell_since_, reached_since_;
};

}  // namespace skein::agent
