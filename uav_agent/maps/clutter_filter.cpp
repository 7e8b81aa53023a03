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

void ClutterFilter::begin_scan(double scan_s) {
  constexpr std::size_t kMostCubes = 200'000;  // memory: then all are forgotten
  if (cubes_ > kMostCubes) {
    groups_.clear();
    underground_.clear();
    cubes_ = 0;
  }
  group_at_ = kNoCube;
  ++scan_;
  recent_s_.push_back(scan_s);
  while (scan_s - recent_s_.front() > kConfirmedWithinS) recent_s_.pop_front();
  first_recent_ = scan_ + 1 - static_cast<std::uint32_t>(recent_s_.size());
}

ClutterFilter::Returns& ClutterFilter::returns_in(const WorldMap::Cube& cube) {
  const WorldMap::Cube at(cube.x() >> kGroupBits[0], cube.y() >> kGroupBits[1], cube.z() >> kGroupBits[2]);
  if (at != group_at_) group_ = &groups_[grid_key(at)];
  group_at_ = at;
  const auto along = [&](int axis) {
    return static_cast<std::size_t>(cube[axis] & ((1 << kGroupBits[static_cast<std::size_t>(axis)]) - 1));
  };
  return (*group_)[along(0) | along(1) << kGroupBits[0] | along(2) << (kGroupBits[0] + kGroupBits[1])];
}

bool ClutterFilter::underground(const WorldMap::Cube& cube, const WorldMap& map) {
  constexpr int kBits = 3, kMask = (1 << kBits) - 1;  // memory: one bit for each of 8 x 8 cubes
  std::uint64_t& cubes = underground_[grid_key({cube.x() >> kBits, cube.y() >> kBits, cube.z()})];
  const std::uint64_t bit = std::uint64_t{1} << ((cube.y() & kMask) << kBits | (cube.x() & kMask));
  if ((cubes & bit) != 0) return true;
  if (map.structure_in(MapLevel::block_of(cube)).at(cube)) return false;
  cubes |= bit;
  ++cubes_;
  return true;
}

bool ClutterFilter::confirmed(double range_m, bool in_doubt, const WorldMap::Cube& cube) {
  Returns& returns = returns_in(cube);
  if (returns == kNever) ++cubes_;
  const Returns none = scan_ << kCountBits;
  if (returns >> kCountBits < first_recent_) returns = none;
  ++returns;
  const int count = static_cast<int>(returns & ((1U << kCountBits) - 1));
  if (count < needed(range_m) - (in_doubt ? 1 : 0)) return false;
  returns = none;
  return true;
}

void ClutterFilter::keep_confirmed(double scan_s, const Vector3d& p_WL, const WorldMap& map,
                                   std::vector<Eigen::Vector3f>& hits_W) {
  begin_scan(scan_s);
  new_.clear();
  const int ground_z = map.cube_of(Vector3d(0.0, 0.0, map.config().ground_m)).z();
  // Most returns end in cubes that are known to be structure, and consecutive returns often in one chunk.
  WorldMap::Cube chunk = kNoCube;
  MapLevel::Structure structure;  // of that chunk
  std::erase_if(hits_W, [&](const Eigen::Vector3f& hit_W) {
    const Vector3d p_W = hit_W.cast<double>();
    const WorldMap::Cube cube = map.cube_of(p_W);
    if (cube.z() < ground_z && underground(cube, map)) return true;
    if (MapLevel::block_of(cube) != chunk) {
      chunk = MapLevel::block_of(cube);
      structure = map.structure_in(chunk);
    }
    if (structure.at(cube)) return false;
    const bool in_doubt = structure.occupied(cube);
    if (!confirmed((p_W - p_WL).norm(), in_doubt, cube)) return true;
    if (!in_doubt && (new_.empty() || new_.back() != cube)) new_.push_back(cube);
    return false;
  });
}

void ClutterFilter::doubt_new(WorldMap& map) {
  for (const WorldMap::Cube& cube : new_) map.doubt(cube);
}

}  // namespace skein::agent
