// The region that a UAV of XXH works on: its map, the end at which the team begins, and its entry.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Source: paper, "Exploration Strategy" of Team XXH: the explorer begins at the base layer. Our choice: which end is
// the base of a lying region; and a team begins an upright region at its top if no place at its foot is proved free.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/plan.hpp"
#include "uav_agent/planners/xxh/region.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

class XxhWorksite {
 public:
  /// @param config  must outlive this.
  XxhWorksite(const XxhConfig& config, const AgentConfig& agent);

  /// Makes `region` the present one, with the end at which it should be begun; decided() tells if that is final.
  /// @param box  the box that contains the region.   @param clearance_m  least distance of UAVs to structure.
  void enter(const XxhRegion& region, const OrientedBox& box, const Vector3d& came_from_W, double clearance_m);
  void leave() { map_.reset(); }
  explicit operator bool() const { return map_.has_value(); }

  /// Whether the end at which the region is begun is final. The leader decides it for its team.
  bool decided() const { return decided_; }
  /// Whether some place of the spiral in a section is proved free.
  /// @param first  the first section.   @param proved  space in which only proved places are free.
  bool begins_in_the_open(const XxhRegionMap::Section& first, const FreeSpace& proved, const Vector3d& here_W) const;
  /// Makes an end final. @returns whether it is another one than before: then the map is empty again.
  bool decide(bool from_high_end);
  bool from_high_end() const { return region_.from_high_end; }
  /// Where the team leaves this region for the next one.
  Vector3d far_end_W() const { return far_end(region_, box_); }

  XxhRegionMap& map() { return *map_; }
  const XxhRegionMap& map() const { return *map_; }
  /// The first place of the spiral around the region.
  const Vector3d& entry_W() const { return entry_W_; }

  /// For a UAV without any map: takes the box for solid, and begins an upright region at its top, because no space is
  /// proved free at its foot. This map is an assumption, so it is not shared.
  void go_by_the_box();
  bool is_solid() const { return solid_; }
  /// The map that is shared with the team; nullptr: none.
  VoxelGrid* shared_grid() { return map_ && !solid_ ? &map_->grid() : nullptr; }

 private:
  void lay_out();

  const XxhConfig& config_;
  const CameraReach reach_;
  XxhRegion region_;
  OrientedBox box_;
  Vector3d came_from_W_ = Vector3d::Zero(), entry_W_ = Vector3d::Zero();
  double clearance_m_ = 0.0;
  bool decided_ = false, solid_ = false;
  std::optional<XxhRegionMap> map_;
};

}  // namespace skein::agent
