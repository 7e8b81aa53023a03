#include "uav_agent/maps/clutter_filter.hpp"

#include <limits>

namespace skein::agent {
namespace {

/// Number of returns in a cube at this distance from the LiDAR that drops are very unlikely to cause.
int needed(double range_m) {
  // Measured (clutter_filter.hpp).
  if (range_m >= 6.0) return 2;
  return range_m >= 3.0 ? 3 : range_m >= 1.5 ? 5 : 8;  // measured, as above
}

}  // namespace

bool ClutterFilter::confirmed(double scan_s, double range_m, bool in_doubt, const WorldMap::Cube& cube) {
  Returns& returns = returns_[grid_key(cube)];
  if (returns.since_s == kNever) ++cubes_;
  if (scan_s - returns.since_s > kConfirmedWithinS) returns = {scan_s, 0};
  ++returns.count;
  const int enough = needed(range_m) - (in_doubt ? 1 : 0);
  if (returns.count < enough) return false;
  returns = {scan_s, 0};
  return true;
}

void ClutterFilter::keep_confirmed(double scan_s, const Vector3d& p_WL, const WorldMap& map,
                                   std::vector<Eigen::Vector3f>& hits_W) {
  constexpr std::size_t kMostCubes = 200'000;  // memory: then all are forgotten
  if (cubes_ > kMostCubes) {
    returns_.clear();
    cubes_ = 0;
  }
  new_.clear();
  // Most returns end in cubes that are known to be structure, and consecutive returns often in one chunk.
  WorldMap::Cube chunk = WorldMap::Cube::Constant(std::numeric_limits<int>::max());  // at first none
  MapLevel::Structure structure;                                                     // of that chunk
  std::erase_if(hits_W, [&](const Eigen::Vector3f& hit_W) {
    const Vector3d p_W = hit_W.cast<double>();
    const WorldMap::Cube cube = map.cube_of(p_W);
    if (MapLevel::block_of(cube) != chunk) {
      chunk = MapLevel::block_of(cube);
      structure = map.structure_in(chunk);
    }
    if (structure.at(cube)) return false;
    const bool in_doubt = map.doubted(cube);
    if (!in_doubt && map.known(cube).space == Space::occupied) return false;
    if (!confirmed(scan_s, (p_W - p_WL).norm(), in_doubt, cube)) return true;
    if (!in_doubt && (new_.empty() || new_.back() != cube)) new_.push_back(cube);
    return false;
  });
}

void ClutterFilter::doubt_new(WorldMap& map) {
  for (const WorldMap::Cube& cube : new_) map.doubt(cube);
}

}  // namespace skein::agent
