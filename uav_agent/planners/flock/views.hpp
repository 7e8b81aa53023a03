// Views: places and directions to photograph from. The targets propose them, and the formulas of the score judge them.
//
// Each target votes for places straight before it and to its sides, at three distances. Votes for the same place and
// direction add up. The places with most votes for the distance to fly are judged: which targets are in the picture and
// not hidden, and with what quality.
// Frames: W world, B body, C camera.   Units: SI and radians.   Pure and deterministic.   Effort: bounded by counts.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/flock/surfaces.hpp"
#include "uav_agent/planners/flock/talk.hpp"

namespace skein::agent {

/// A place and a direction, and what they show.
struct FlockView {
  struct Sight {
    std::uint32_t target = 0;  ///< index into FlockTargets::all()
    float q = 0.0F;            ///< quality of its picture, without motion blur
  };
  Vector3d p_WB = Vector3d::Zero();
  Vector3d aim_W = Vector3d::Zero();  ///< where the camera looks
  std::vector<Sight> sights = {};     ///< the targets that it shows
  double survey = 0.0;                ///< points expected on the structure that an explorer would find from there
  bool proved = true;                 ///< the place is proved free
};

/// The targets, indexed by place.
class FlockTargets {
 public:
  /// @param range_m  greatest distance of a picture; edge of the index's cells.
  FlockTargets(std::vector<FlockTarget> targets, double range_m);

  const std::vector<FlockTarget>& all() const { return targets_; }
  std::vector<FlockTarget>& all() { return targets_; }
  /// Calls `visit` with the index of each target in the cells around a place: of all within range_m, and some farther.
  template <class Visit>
  void near(const Vector3d& p_W, Visit&& visit) const;

 private:
  std::vector<FlockTarget> targets_;
  double cell_m_;
  Vector3d low_W_ = Vector3d::Zero();
  Eigen::Vector3i dims_ = Eigen::Vector3i::Ones();
  std::vector<std::uint32_t> begins_;  ///< by cell: its first place in order_
  std::vector<std::uint32_t> order_;   ///< indices of targets, sorted by cell
};

class FlockViews {
 public:
  static constexpr double kClaimedShare = 0.9;  ///< chosen

  /// @param config, agent  must outlive this.   @param sharp_m  d*.
  FlockViews(const FlockConfig& config, const AgentConfig& agent, double sharp_m)
      : config_(config), agent_(agent), sharp_m_(sharp_m) {}

  double range_m() const;  ///< targets farther than this are not worth a picture
  /// From a place that find_gaps() proposes, all cells within this distance should come into sight.
  double surveyed_m() const;
  /// The views with most votes for the distance to fly, judged.
  /// @param explores  this UAV may fly to places that are seen but not proved free.
  std::vector<FlockView> find(const FlockSurfaces& surfaces, const FlockTargets& targets, const FreeSpace& space,
                              const Vector3d& p_W, bool explores) const;
  /// Adds places from which an explorer surveys gaps.
  /// @param lack  lack of work, 0 to 1: factor on the points expected there; 0: adds none.
  void find_gaps(const FlockSurfaces& surfaces, const FreeSpace& space, const Vector3d& p_W, double lack,
                 std::vector<FlockView>& views) const;
  /// A view, from a place, of the best point to which the camera can turn quickly; nullopt: none is worth the turn.
  std::optional<FlockView> glance(const FlockSurfaces& surfaces, const FlockTargets& targets, const Vector3d& p_WB,
                                  const RigidBodyState& state, const GimbalState& gimbal) const;
  /// Wide views of the targets, nearest first: a UAV that waits there sees them, and is far from where others work.
  std::vector<FlockView> lookouts(const FlockSurfaces& surfaces, const FlockTargets& targets, const FreeSpace& space,
                                  const Vector3d& p_W) const;
  /// Counts what the views show that another UAV has announced as photographed, with kClaimedShare of the quality.
  void count_claims(const FlockSurfaces& surfaces, const std::vector<FlockClaim>& claims, FlockTargets& targets) const;
  /// Computes what a view shows (FlockView::sights).
  void judge(const FlockSurfaces& surfaces, const FlockTargets& targets, FlockView& view) const;

 private:
  struct Vote;
  /// Points on which the camera can be turned quickly, with most left to photograph around them, best first.
  std::vector<Vector3d> aims(const FlockTargets& targets, const Vector3d& p_WB, const RigidBodyState& state,
                             const GimbalState& gimbal) const;
  std::vector<FlockTarget> voters(const FlockTargets& targets) const;
  std::vector<Vote> votes(const FlockTargets& targets) const;

  const FlockConfig& config_;
  const AgentConfig& agent_;
  double sharp_m_;
};

/// The exposure at a view, with the camera at rest.
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
