// The search for the best picture of one point. Part of the oracle (oracle.hpp).
// Frames: W world, ground z = 0; C camera.   Units: SI, radians.
#pragma once

#include <vector>

#include "sim_server/best_aim.hpp"
#include "sim_server/open_space.hpp"
#include "sim_server/oracle.hpp"
#include "sim_server/ray_scene.hpp"

namespace skein::sim {

/// The n-th of a sequence of unit vectors that covers the sphere evenly however long it is. Pure.
Vector3d sphere_direction(std::size_t n);

/// Immutable; safe from any thread.
class ViewSearch {
 public:
  /// All arguments must outlive this.
  /// @param cameras  one for each kind of camera.
  /// @param spaces   the camera must be within reach of each.
  ViewSearch(const RayScene& world, const std::vector<BestAim>& cameras, double clearance,
             std::vector<const OpenSpace*> spaces);

  struct Found {
    PointView coarse, fine;  ///< with `directions` and with twice as many; fine.q >= coarse.q
  };
  /// @param known  what is found is not worse: pictures from places that are allowed here too.
  Found find(const InterestPoint& point, std::size_t directions, const Found& known) const;

 private:
  struct Trial;
  class Best;
  Trial try_direction(const InterestPoint& point, const Vector3d& direction) const;
  double nearest_place(const Vector3d& p_W, const Vector3d& direction, double until, double& openness) const;
  bool may_be_at(const Vector3d& p_WC) const;
  void refine(const InterestPoint& point, double step, Best& best) const;

  const RayScene& world_;
  const std::vector<BestAim>& cameras_;
  double clearance_, reach_;
  std::vector<const OpenSpace*> spaces_;
};

}  // namespace skein::sim
