// The search for the best picture of one point. Part of the oracle (oracle.hpp).
// Frames: W world, ground z = 0; C camera.   Units: SI, radians.
#pragma once

#include <optional>
#include <vector>

#include "oracle/best_aim.hpp"
#include "oracle/open_space.hpp"
#include "oracle/oracle.hpp"
#include "sight/camera.hpp"
#include "sight/camera_mount.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// The n-th vector of a sequence of unit vectors. The first n vectors cover the sphere evenly for every n. Pure.
Vector3d sphere_direction(std::size_t n);

/// A kind of camera, and the places where it may be.
struct Viewer {
  BestAim aim;
  CameraMount mount;
  /// Clearance from the structure [m], depending on the search's Berth: of the camera, or of the body's centre.
  double clearance = 0.0;
  /// All of them must reach the camera, or the body's centre (OpenSpace::reaches()); they must outlive this.
  std::vector<const OpenSpace*> spaces;
  std::size_t optics = 0;  ///< equal for viewers whose `aim` gives equal answers
};

/// Immutable; safe from any thread.
class ViewSearch {
 public:
  /// @param world, viewers  must outlive this. With Berth::camera, all viewers have the same clearance and spaces.
  /// @param rules  used for visibility: whether a camera that passes through the structure is blind, and the test for
  ///               line of sight.
  ViewSearch(const RayScene& world, const std::vector<Viewer>& viewers, Berth berth, const RulesConfig& rules);

  struct Found {
    PointView coarse, fine;  ///< with `directions` and with twice the number; fine.q >= coarse.q
  };
  /// Searches for the best picture of a point.
  /// @param known   pictures from places that this search allows, too; the result is never worse.
  /// @param enough  a picture with at least this quality ends the search.
  Found find(const InterestPoint& point, std::size_t directions, const Found& known, double enough = 1.0) const;

 private:
  struct Trial;
  class Best;
  struct Look;
  Trial try_direction(const InterestPoint& point, const Vector3d& direction, double enough) const;
  double nearest_place(const Look& look, double& openness) const;
  double camera_lacks(const Look& look, const Vector3d& p_WC, double& openness) const;
  double body_lacks(const Look& look, const Vector3d& p_WC, double& openness) const;
  bool heading_matters(const Viewer& viewer) const;
  bool fits(const Viewer& viewer, const Vector3d& p_WC, double body_yaw) const;
  std::optional<double> fitting_yaw(const Look& look, const Vector3d& p_WC, BodyHeadings headings,
                                    double camera_yaw) const;
  BodyHeadings fitting(const Look& look, const Vector3d& p_WC) const;
  void take_picture(const Look& look, const Vector3d& p_WC, const Vector3d& n_W, Aim aim, PointView& best) const;
  void refine(const InterestPoint& point, double step, Best& best) const;

  const RayScene& world_;
  const std::vector<Viewer>& viewers_;
  Berth berth_;
  bool blind_in_structure_;
  SightTest sees_;
  double reach_ = 0.0;
};

}  // namespace skein::sim
