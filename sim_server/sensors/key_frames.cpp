#include "sim_server/sensors/key_frames.hpp"

// The filters are compiled here: libpcl_filters and what it needs would have a program resolve 60,000 symbols at its
// start, which is most of the time that a program takes to start.
#define PCL_NO_PRECOMPILE
#include <pcl/filters/uniform_sampling.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

constexpr double kMostCells = 1e9;  ///< PCL counts cells with an int

using Points = std::span<const Eigen::Vector3f>;

/// Marks those of the points `some` that PCL's filter removes. Its output is not used, because that is in the order of
/// a hash table.
void leave_out(Points points_W, const std::vector<std::size_t>& some, double cell_m, std::vector<bool>& left_out) {
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(some.size());
  for (const std::size_t i : some) cloud->push_back({points_W[i].x(), points_W[i].y(), points_W[i].z()});
  pcl::UniformSampling<pcl::PointXYZ> sampling(true);  // true: report removed points
  sampling.setInputCloud(cloud);
  sampling.setRadiusSearch(cell_m);
  pcl::PointCloud<pcl::PointXYZ> sampled;
  sampling.filter(sampled);
  for (const int i : *sampling.getRemovedIndices()) left_out[some[static_cast<std::size_t>(i)]] = true;
}

/// The same for points whose extent may have more cells than PCL can count: halves such an extent first.
void leave_out_piecewise(Points points_W, std::vector<std::size_t> some, double cell_m, std::vector<bool>& left_out) {
  if (some.size() < 2) return;
  const auto cell = [&](std::size_t i) { return Vector3d((points_W[i].cast<double>() / cell_m).array().floor()); };
  Eigen::AlignedBox3d extent;
  for (const std::size_t i : some) extent.extend(cell(i));
  if ((extent.sizes().array() + 2.0).prod() <= kMostCells) return leave_out(points_W, some, cell_m, left_out);
  Eigen::Index axis = 0;
  extent.sizes().maxCoeff(&axis);
  const double middle = std::floor(extent.center()[axis]);
  const auto upper = std::stable_partition(some.begin(), some.end(), [&](auto i) { return cell(i)[axis] <= middle; });
  leave_out_piecewise(points_W, {upper, some.end()}, cell_m, left_out);
  some.erase(upper, some.end());
  leave_out_piecewise(points_W, std::move(some), cell_m, left_out);
}

}  // namespace

std::vector<Eigen::Vector3f> sample_uniformly(Points points_W, double cell_m) {
  std::vector<bool> left_out(points_W.size());
  std::vector<std::size_t> all(points_W.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  leave_out_piecewise(points_W, std::move(all), cell_m, left_out);
  std::vector<Eigen::Vector3f> kept;
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    if (!left_out[i]) kept.push_back(points_W[i]);
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
