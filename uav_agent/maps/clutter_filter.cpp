#include "uav_agent/maps/clutter_filter.hpp"

namespace skein::agent {

void ClutterFilter::keep_confirmed(double scan_s, const WorldMap& map, std::vector<Eigen::Vector3f>& hits_W) {
  constexpr std::size_t kMostCubes = 200'000;
  if (cubes_ > kMostCubes) {
    last_.clear();
    cubes_ = 0;
  }
  new_.clear();
  std::erase_if(hits_W, [&](const Eigen::Vector3f& hit_W) {
    const WorldMap::Cube cube = map.cube_of(hit_W.cast<double>());
    if (map.known(cube).space == Space::occupied) return false;
    LastReturn& last = last_[grid_key(cube)];
    const bool confirmed = scan_s - last.at_s <= kConfirmedWithinS;
    if (last.at_s == kNever) ++cubes_;
    last.at_s = scan_s;
    if (confirmed && (new_.empty() || new_.back() != cube)) new_.push_back(cube);
    return !confirmed;
  });
}

void ClutterFilter::doubt_new(WorldMap& map) {
  for (const WorldMap::Cube& cube : new_) map.doubt(cube);
}

}  // namespace skein::agent
