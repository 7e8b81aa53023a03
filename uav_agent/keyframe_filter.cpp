#include "uav_agent/keyframe_filter.hpp"

#include <pcl/filters/crop_box.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr float kHorizonM = 1e4F;  ///< crops nothing sideways

Cloud::Ptr without_bodies(const std::vector<Eigen::Vector3f>& points_W, const std::vector<KnownBody>& bodies) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(points_W.size());
  for (const Eigen::Vector3f& p_W : points_W) {
    const Vector3d p = p_W.cast<double>();
    const bool own_kind = std::any_of(bodies.begin(), bodies.end(), [&](const KnownBody& body) {
      return (p - body.p_W).squaredNorm() <= body.radius_m * body.radius_m;
    });
    if (p.allFinite() && !own_kind) cloud->push_back({p_W.x(), p_W.y(), p_W.z()});
  }
  return cloud;
}

}  // namespace

std::vector<Eigen::Vector3f> KeyframeFilter::operator()(const std::vector<Eigen::Vector3f>& points_W,
                                                        const std::vector<KnownBody>& bodies) const {
  Cloud::Ptr cloud = without_bodies(points_W, bodies);
  if (cloud->empty()) return {};

  auto cropped = std::make_shared<Cloud>();
  pcl::CropBox<pcl::PointXYZ> crop;
  crop.setInputCloud(cloud);
  crop.setMin({-kHorizonM, -kHorizonM, static_cast<float>(config_.lowest_m), 1.0F});
  crop.setMax({kHorizonM, kHorizonM, static_cast<float>(config_.highest_m), 1.0F});
  crop.filter(*cropped);
  if (cropped->empty()) return {};

  auto thinned = std::make_shared<Cloud>();
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setInputCloud(cropped);
  voxels.setLeafSize(Eigen::Vector4f::Constant(static_cast<float>(config_.voxel_m)));
  voxels.filter(*thinned);

  if (config_.lone_min_neighbours > 0 && thinned->size() > 1) {
    auto kept = std::make_shared<Cloud>();
    pcl::RadiusOutlierRemoval<pcl::PointXYZ> lone;
    lone.setInputCloud(thinned);
    lone.setRadiusSearch(config_.lone_radius_m);
    lone.setMinNeighborsInRadius(config_.lone_min_neighbours);
    lone.filter(*kept);
    thinned = kept;
  }

  std::vector<Eigen::Vector3f> out;
  out.reserve(thinned->size());
  for (const auto& p : *thinned) out.emplace_back(p.x, p.y, p.z);
  return out;
}

}  // namespace skein::agent
