// Places to photograph from: proposed by what is to be photographed, and judged by how much better that would be known
// afterwards.
//
// Each target votes for places straight before it and aside, at two distances; votes of targets that could be seen from
// one place in one direction add up, and the places with most of them for the way there are judged: which targets are
// in the picture, not hidden, and how well, by the formulas of the score.
// Frames: W world, B body, C camera.   Units: SI and radians.   Pure and deterministic.   Effort: bounded by counts.
#pragma once

#include <span>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/flock/surfaces.hpp"

namespace skein::agent {

/// A place and a direction, and what they show.
struct FlockView {
  struct Sight {
    std::uint32_t target = 0;
    float q = 0.0F;
  };
  Vector3d p_WB = Vector3d::Zero();
  Vector3d aim_W = Vector3d::Zero();  ///< where the camera looks
  std::vector<Sight> sights = {};     ///< of targets
  double survey = 0.0;                ///< points expected in what an explorer would find from there
  bool proved = true;                 ///< that a body may be there
};

/// What can be photographed, by place.
class FlockTargets {
 public:
  /// @param range_m  of pictures.
  FlockTargets(std::vector<FlockTarget> targets, double range_m);

  const std::vector<FlockTarget>& all() const { return targets_; }
  std::vector<FlockTarget>& all() { return targets_; }
  /// Calls `visit` with the index of each target in the cells about a place; some are farther off than range_m.
  template <class Visit>
  void near(const Vector3d& p_W, Visit&& visit) const;

 private:
  std::vector<FlockTarget> targets_;
  double cell_m_;
  Vector3d low_W_ = Vector3d::Zero();
  Eigen::Vector3i dims_ = Eigen::Vector3i::Ones();
  std::vector<std::uint32_t> begins_;  ///< by cell, into order_
  std::vector<std::uint32_t> order_;
};

class FlockViews {
 public:
  /// All must outlive this.  @param sharp_m  d*.
  FlockViews(const FlockConfig& config, const AgentConfig& agent, double sharp_m)
      : config_(config), agent_(agent), sharp_m_(sharp_m) {}

  double range_m() const;
  /// Within this distance of a place that find() proposes for a survey, all should come into sight.
  double surveyed_m() const;
  /// The views that promise most for the way to them, judged.
  /// @param explores  whether this UAV may go where nothing is proved, and finds structure.
  std::vector<FlockView> find(const FlockSurfaces& surfaces, const FlockTargets& targets, const FreeSpace& space,
                              const Vector3d& p_W, bool explores) const;
  /// Adds places from which an explorer sees what has not been surveyed yet.
  /// @param lack  of work, 0 to 1: what it is worth to find more.
  void find_gaps(const FlockSurfaces& surfaces, const FreeSpace& space, const Vector3d& p_W, double lack,
                 std::vector<FlockView>& views) const;
  /// Places to which the camera can turn within a moment, with most to photograph around them.
  std::vector<Vector3d> aims(const FlockTargets& targets, const Vector3d& p_WB, const RigidBodyState& state,
                             const GimbalState& gimbal) const;
  /// What a view shows.
  void judge(const FlockSurfaces& surfaces, const FlockTargets& targets, FlockView& view) const;

 private:
  struct Vote;
  std::vector<FlockTarget> voters(const FlockTargets& targets) const;
  std::vector<Vote> votes(const FlockTargets& targets) const;

  const FlockConfig& config_;
  const AgentConfig& agent_;
  double sharp_m_;
};

/// The exposure of a camera at rest.
Exposure exposure_of(const FlockView& view, const AgentConfig& agent);

template <class Visit>
void FlockTargets::near(const Vector3d& p_W, Visit&& visit) const {
  const Eigen::Vector3i at = ((p_W - low_W_) / cell_m_).array().floor().cast<int>();
  const Eigen::Vector3i low = (at.array() - 1).max(0), high = (at.array() + 1).min(dims_.array() - 1);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const std::size_t cell = static_cast<std::size_t>((z * dims_.y() + y) * dims_.x() + x);
        for (std::uint32_t i = begins_[cell]; i < begins_[cell + 1]; ++i) visit(order_[i]);
      }
    }
  }
}

}  // namespace skein::agent
