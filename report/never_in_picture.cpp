#include <algorithm>

#include "report/figures.hpp"

namespace skein::report {
namespace {

/// Part of a track, with the box around it.
struct Stretch {
  Eigen::AlignedBox3d box;
  std::vector<Vector3d> places_W;
};

/// The places at which a UAV was alive, in stretches of some seconds.
std::vector<Stretch> stretches_of(const std::vector<const results::PoseRow*>& track) {
  constexpr std::size_t kLongest = 50;
  std::vector<Stretch> stretches;
  for (const results::PoseRow* pose : track) {
    if (!pose->alive) continue;
    if (stretches.empty() || stretches.back().places_W.size() == kLongest) stretches.emplace_back();
    stretches.back().box.extend(pose->p_W);
    stretches.back().places_W.push_back(pose->p_W);
  }
  return stretches;
}

bool comes_near(const std::vector<Stretch>& stretches, const Vector3d& p_W, double range_m) {
  const double most = range_m * range_m;
  return std::ranges::any_of(stretches, [&](const Stretch& stretch) {
    if (stretch.box.squaredExteriorDistance(p_W) > most) return false;
    return std::ranges::any_of(stretch.places_W,
                               [&](const Vector3d& place_W) { return (place_W - p_W).squaredNorm() <= most; });
  });
}

}  // namespace

std::optional<NeverInPicture> never_in_picture(const results::RunRecord& run) {
  constexpr std::optional<std::size_t> kCause = results::cause_of("never_in_picture");
  std::vector<std::pair<std::vector<Stretch>, double>> cameras;  // where each was, and its range
  const auto tracks = run.by_uav(run.poses);
  for (std::size_t uav = 0; uav < std::min(run.cameras.size(), tracks.size()); ++uav) {
    if (run.cameras[uav]) cameras.emplace_back(stretches_of(tracks[uav]), run.cameras[uav]->range_m);
  }
  if (cameras.empty()) return std::nullopt;
  NeverInPicture sums;
  for (const results::RunPoint& point : run.points) {
    if (point.cause != kCause) continue;
    const bool near = std::ranges::any_of(
        cameras, [&](const auto& camera) { return comes_near(camera.first, point.p_W, camera.second); });
    ++(near ? sums.points_near : sums.points_far);
    (near ? sums.loss_near : sums.loss_far) += point.loss;
  }
  return sums.points_near + sums.points_far > 0 ? std::optional(sums) : std::nullopt;
}

}  // namespace skein::report
