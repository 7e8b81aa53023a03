// Where one UAV of XXH may fly, and how it gets there: free of structure, of those who are near, and of what those who
// have priority are about to fly.
// Frame W.   Units: SI.   Threads: one.   Effort: bounded by counts.
// Source: paper, "Inspection Strategy" of Team XXH (A*, shared trajectories, priority rules). Every way is checked
// against the finer map (free_space.hpp), which is ours.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/flight/pilot.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/talk.hpp"

namespace skein::agent {

class XxhWays {
 public:
  /// All must outlive this.
  XxhWays(const XxhConfig& config, const AgentConfig& agent, const XxhTalk& talk, Pilot& pilot)
      : config_(config), agent_(agent), talk_(talk), pilot_(pilot) {}

  /// Once, when the boxes have come.
  void know_site(const std::vector<OrientedBox>& boxes);
  const Site& site() const { return site_; }
  double clearance_m() const;

  /// What others told of the region at hand; nullptr: nothing. Must outlive its use.
  void believe(const VoxelGrid* hearsay) { hearsay_ = hearsay; }
  FreeSpace::Config space() const;
  /// Without those who are near, too. A long way does not lead through boxes.
  FreeSpace space_for_way(const PlannerInput& in, const Vector3d& goal_W) const;

  /// @returns corners up to the goal; nullopt if there is no way or none was found with the effort allowed.
  std::optional<std::vector<Vector3d>> find(const PlannerInput& in, const Vector3d& goal_W) const;
  /// Times in a row that it could not set out. From some on, fewer rays are proof enough of free space.
  int fruitless() const { return fruitless_; }
  void start_anew() { fruitless_ = 0; }
  /// No more proof of free space than that of so many rungs down (proof.hpp).
  void dare(int boldness) { dared_ = boldness; }
  /// Sets out.
  /// @param slow_mps  on a short way, and from place to place; a long way there is flown at the speed of transit.
  /// @returns false, and does nothing, if there is no way.
  bool fly_to(const Vector3d& goal_W, double slow_mps, const PlannerInput& in, PlannerOutput& out);
  /// Along `places` as far as they can be flown one after the other; the first one must be found a way to.
  bool fly_along(const std::vector<Vector3d>& places_W, double slow_mps, const PlannerInput& in, PlannerOutput& out);
  /// The path that was set out on has become another one.
  void forget_corners() { corners_.clear(); }
  /// Where it is told to be, and the corners that come next: what is shared with the others.
  std::vector<Vector3d> ahead(const PlannerInput& in) const;

 private:
  const XxhConfig& config_;
  const AgentConfig& agent_;
  const XxhTalk& talk_;
  Pilot& pilot_;
  Site site_;
  const VoxelGrid* hearsay_ = nullptr;
  int fruitless_ = 0, dared_ = 0;
  std::vector<Vector3d> corners_;  ///< of the path being flown
};

}  // namespace skein::agent
