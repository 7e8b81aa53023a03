// The layered inspection of XXH: which cell of a section a UAV visits next, and its work there. The UAV inspects layer
// after layer, cell by cell around the region; at a cell it turns the gimbal to one occupied neighbour after the other.
// Frame W.   Units: SI and radians.   Threads: one.
// Source: paper, "Inspection Strategy" of Team XXH ("all exposed voxel faces", "a spiral pattern"); its public code for
// every third layer, the nearest cell first, the angle at which a target counts as reached,
// and the 3 s at a cell. Our choice: the UAV comes to rest first, stays for a picture, and goes over its layers again
// for cells that it could not reach.
#pragma once

#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/errand.hpp"
#include "uav_agent/planners/xxh/region.hpp"

namespace skein::agent {

class XxhInspector {
 public:
  /// @param config, agent  must outlive this.
  XxhInspector(const XxhConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Begins a section of a region, at its first layer.
  void begin(const XxhRegionMap::Section& section);
  bool finished() const { return layers_.empty() && !visit_; }

  /// Goals at the next cells, best first. Empty: the layer is done, and the next call tries the next layer.
  std::vector<Goal> choices(const XxhRegionMap& region, const Vector3d& here_W, const FreeSpace& space);
  /// Reads the outcomes of these choices. Call it once per exchange.
  void hear(const XxhErrand& errand);
  /// First target of a choice, for the camera on the way there; nullptr: the cell has no target left.
  const XxhTarget* ahead(std::size_t choice, const XxhRegionMap& region) const;

  /// The cell that the UAV is at.
  const std::optional<XxhVisit>& visit() const { return visit_; }
  /// Call it when the UAV has left the cell before it was done.
  void leave();
  /// The target that the camera looks at: the first one that is left at the visited cell.
  const XxhTarget& target() const { return visit_->targets.front(); }
  /// Marks targets that are done; after the last one, visit() is empty. Call it once per exchange at a cell.
  void look(const PlannerInput& in, VoxelGrid& grid);

 private:
  void next_target(VoxelGrid& grid);

  const XxhConfig& config_;
  const AgentConfig& agent_;
  std::deque<int> layers_;  ///< layers that are left
  std::vector<int> all_layers_;
  int pass_ = 0;  ///< passes over the section's layers so far
  std::vector<XxhVisit> choices_;
  std::optional<VoxelGrid::Id> last_cell_;  ///< cell of the last visit, from which the spiral goes on
  std::optional<XxhVisit> visit_;
  std::set<VoxelGrid::Id> failed_;  ///< cells that could not be reached in this pass
  std::optional<Tick> at_cell_since_, reached_since_;
};

}  // namespace skein::agent
