// The region that a UAV of XXH is at: its map, the end at which it is begun, and where the team waits beside it.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Source: paper, "Exploration Strategy" of Team XXH: the explorer begins at the base layer. What the base of a region
// that lies is, and that an upright one is begun at its top where nothing is proved to be free about its foot, is our
// choice.
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

  /// Comes to a region, for now at the end where it would be begun.
  /// @param box  which the region is part of.   @param clearance_m  of UAVs from structure.
  void enter(const XxhRegion& region, const OrientedBox& box, const Vector3d& came_from_W, double clearance_m);
  void leave() { map_.reset(); }
  explicit operator bool() const { return map_.has_value(); }

  /// Whether it is known at which end the region is begun, which its team's leader decides for all.
  bool decided() const { return decided_; }
  /// Whether some place of the spiral's first turn is proved to be free.
  /// @param proved  asks for proof.
  bool begins_in_the_open(const XxhRegionMap::Section& first, const FreeSpace& proved, const Vector3d& here_W) const;
  /// @returns whether that is another end than before: then the map begins anew, too.
  bool decide(bool from_high_end);
  bool from_high_end() const { return region_.from_high_end; }
  /// Where one comes from who goes on from here to the next region.
  Vector3d far_end_W() const { return far_end(region_, box_); }

  XxhRegionMap& map() { return *map_; }
  const XxhRegionMap& map() const { return *map_; }
  /// The first place of the spiral around it.
  const Vector3d& entry_W() const { return entry_W_; }

  /// Without anybody's map there is only the box to go by, taken to be solid, and an upright one is begun at its top,
  /// since nothing is proved about its foot. That is not shared: it is no knowledge.
  void go_by_the_box();
  bool is_solid() const { return solid_; }
  /// What is shared with the team; nullptr: nothing.
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
