#include "sim_server/sensors/key_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/euler.hpp"

namespace skein::sim {

std::vector<Eigen::Vector3f> sample_uniformly(std::span<const Eigen::Vector3f> points_W, double cell_m) {
  struct Candidate {
    std::array<std::int64_t, 3> cell;
    double from_centre;  ///< squared
    std::size_t index;
    auto order() const { return std::tie(cell, from_centre, index); }
  };
  std::vector<Candidate> candidates;
  candidates.reserve(points_W.size());
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    const Vector3d scaled = points_W[i].cast<double>() / cell_m;
    const Vector3d cell = scaled.array().floor();
    candidates.push_back({{static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                           static_cast<std::int64_t>(cell.z())},
                          (scaled.array() - cell.array() - 0.5).matrix().squaredNorm(),
                          i});
  }
  std::ranges::sort(candidates, {}, &Candidate::order);
  const auto rest = std::ranges::unique(candidates, {}, &Candidate::cell);
  candidates.erase(rest.begin(), rest.end());
  std::ranges::sort(candidates, {}, &Candidate::index);

  std::vector<Eigen::Vector3f> kept;
  kept.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    kept.push_back(points_W[candidate.index]);
  }
  return kept;
}

KeyFrameSelector::Pose KeyFrameSelector::pose_of(Tick tick, const Isometry3d& X_WB) {
  return {tick, X_WB.translation(), roll_pitch_yaw(X_WB.linear()).yaw};
}

bool KeyFrameSelector::wanted(const Pose& pose) const {
  if (kept_.empty()) {
    return true;
  }
  if (pose.tick - kept_.back().tick <= kMinAge) {
    return false;
  }
  std::vector<Pose> neighbours(std::min(kNeighbours, kept_.size()));
  const auto squared_distance = [&pose](const Pose& kept) { return (kept.p_WB - pose.p_WB).squaredNorm(); };
  std::ranges::partial_sort_copy(kept_, neighbours, {}, squared_distance, squared_distance);
  if (squared_distance(neighbours.front()) > kMinDistance * kMinDistance) {
    return true;
  }
  return std::ranges::all_of(
      neighbours, [&pose](const Pose& kept) { return std::abs(wrap_angle(pose.yaw - kept.yaw)) >= kMinYaw; });
}

std::optional<KeyFrame> KeyFrameSelector::offer(const LidarScan& scan, const Isometry3d& X_WB) {
  const Pose pose = pose_of(scan.tick, X_WB);
  if (!wanted(pose)) {
    return std::nullopt;
  }
  kept_.push_back(pose);
  return KeyFrame{kept_.size() - 1, scan.tick, X_WB, sample_uniformly(scan.points_W, kCell)};
}

}  // namespace skein::sim
