#include "report/flight_picture.hpp"

namespace skein::report {

std::array<Vector3d, 8> corners_of(const Vector3d& center, const Vector3d& size, const Eigen::Matrix3d& R_WB) {
  std::array<Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    corners[static_cast<std::size_t>(i)] = center + R_WB * signs.cwiseProduct(0.5 * size);
  }
  return corners;
}

FlightPicture shape_of(const results::RunRecord& run) {
  FlightPicture picture;
  for (const results::RunBox& box : run.boxes) picture.boxes.push_back(corners_of(box.center, box.size, box.R_WB));
  for (const results::RunPoint& point : run.points) picture.points.push_back({point.p_W, point.score, point.cause});
  const auto tracks = run.by_uav(run.poses);
  for (std::size_t uav = 0; uav < run.uavs.size(); ++uav) {
    picture.tracks.push_back({run.uavs[uav], run.explorer[uav], {}});
    for (const results::PoseRow* pose : tracks[uav]) picture.tracks.back().p_WB.push_back(pose->p_W);
  }
  return picture;
}

FlightPicture read_picture(const std::filesystem::path& dir) try {
  return shape_of(results::read_sound_files(dir, {run_folder::kScene, run_folder::kScore, run_folder::kTrajectories}));
} catch (const InputError&) {
  return {};
}

}  // namespace skein::report
