#include "uav_agent/planners/xxh/worksite.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kSpareM = 0.4;  ///< distance of stops to structure, beyond the clearance; chosen
constexpr double kRoomM =
    1.0;  ///< stops lie this much farther out, where more is proved, if pictures are sharp; chosen
constexpr double kLimitRatio = 1.1;  ///< greatest distance of stops, in units of d*, without a better place; chosen

XxhRegionMap::Config map_config(const XxhConfig& config, const CameraReach& reach, double clearance_m) {
  XxhRegionMap::Config map;
  map.margin_m = config.margin_m;
  map.rim_m = config.rim_m;
  map.spiral_step = config.spiral_step;
  map.nearest_m = clearance_m + kSpareM;
  const double room_m = std::min(map.nearest_m + kRoomM, reach.sharp_distance_m);
  map.farthest_m = std::max({map.nearest_m, room_m, config.standoff_ratio * reach.sharp_distance_m});
  map.limit_m = std::max(map.farthest_m, kLimitRatio * reach.sharp_distance_m);
  return map;
}

/// Edges of a region's map, along those of its box.
Vector3d map_size(const XxhConfig& config, const OrientedBox& box) {
  return box.size + Vector3d::Constant(2.0 * config.margin_m);
}

}  // namespace

XxhWorksite::XxhWorksite(const XxhConfig& config, const AgentConfig& agent)
    : config_(config), reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)) {}

void XxhWorksite::enter(const XxhRegion& region, const OrientedBox& box, const Vector3d& came_from_W,
                        double clearance_m) {
  region_ = region;
  box_ = box;
  came_from_W_ = came_from_W;
  clearance_m_ = clearance_m;
  const auto foot = foot_end(box);
  decided_ = !foot || *config_.begin == XxhBegin::path;
  if (!decided_) region_.from_high_end = *foot == BoxEnd::high;
  lay_out();
  const double voxel_m = map_->grid().voxel_m();
  if (voxel_m > config_.voxel_m) {
    spdlog::warn("xxh: {}", coarse_voxels_text(config_.voxel_m, voxel_m, map_size(config_, map_->box())));
  }
}

void XxhWorksite::lay_out() {
  solid_ = false;
  const OrientedBox box = region_box(region_, box_);
  XxhRegionMap::Config config = map_config(config_, reach_, clearance_m_);
  config.voxel_m = fitting_voxel_m(config_.voxel_m, [&](double) { return map_size(config_, box); });
  map_.emplace(config, box, longest_axis(box_), region_.from_high_end);
  const auto spiral = map_->spiral(map_->section(0, 1, 1.0), came_from_W_);
  entry_W_ = spiral.empty() ? map_->box().center : spiral.front();
}

bool XxhWorksite::begins_in_the_open(const XxhRegionMap::Section& first, const FreeSpace& proved,
                                     const Vector3d& here_W) const {
  const auto turn = map_->spiral(first, here_W);
  return std::ranges::any_of(turn, [&](const Vector3d& place) { return proved.free(place); });
}

bool XxhWorksite::decide(bool from_high_end) {
  decided_ = true;
  if (from_high_end == region_.from_high_end) return false;
  region_.from_high_end = from_high_end;
  lay_out();
  return true;
}

void XxhWorksite::go_by_the_box() {
  if (!decided_) decide(!region_.from_high_end);
  solid_ = true;
  map_->assume_solid();
}

}  // namespace skein::agent
