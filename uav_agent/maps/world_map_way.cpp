#include <algorithm>
#include <cstdint>
#include <limits>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

/// A way from the point p along a unit vector.
class Way {
 public:
  Way(const Vector3d& from_W, const Vector3d& direction_W)
      : from_W_(from_W), direction_W_(direction_W), per_along_(direction_W.cwiseInverse()) {}

  Vector3d at(double way_m) const { return from_W_ + way_m * direction_W_; }
  /// Distance from p beyond which no point of the way is in a box, rounded; at most `reach_m`.
  double leaves_m(const Vector3d& low_W, const Vector3d& high_W, double reach_m) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (direction_W_[axis] == 0.0) continue;
      const double plane_m = direction_W_[axis] > 0.0 ? high_W[axis] : low_W[axis];
      reach_m = std::min(reach_m, (plane_m - from_W_[axis]) * per_along_[axis]);
    }
    return reach_m;
  }

 private:
  Vector3d from_W_, direction_W_, per_along_;
};

}  // namespace

/// Passes over chunks and whole regions without structure, and ends where the way leaves the box around all structure.
/// It goes on one sample before such an end, or at it, because of rounding.
double WorldMap::clear_way_m(const Vector3d& from_W, const Vector3d& direction_W, double reach_m) const {
  const double cell_m = config_.cell_m, step_m = 0.5 * cell_m;
  const Way way(from_W, direction_W);
  const Vector3d low_W = structure_low_.cast<double>() * cell_m, high_W = structure_high_.cast<double>() * cell_m;
  const double last_m = std::min(reach_m, way.leaves_m(low_W, high_W, reach_m) + step_m);
  Cube last_chunk = Cube::Constant(std::numeric_limits<int>::max());  // of the last sample; at first none
  bool any_structure = false;                                         // in that chunk
  MapLevel::Structure structure;                                      // of that chunk
  for (std::int64_t sample = 0;;) {
    const double way_m = static_cast<double>(sample) * step_m;
    if (!(way_m < last_m)) return reach_m;
    const Cube cube = cube_of(way.at(way_m)), chunk = MapLevel::block_of(cube);
    const std::uint64_t* chunks = nullptr;
    if (!any_structure || chunk != last_chunk) {
      chunks = structured_.find(grid_key(shifted(chunk, kRegionBits)));
      any_structure = chunks != nullptr && (*chunks >> place_in_region(chunk) & 1) != 0;
      last_chunk = chunk;
      if (any_structure) structure = structure_in(chunk);
    }
    if (any_structure) {
      if (structure.at(cube)) return way_m;
      ++sample;
      continue;
    }
    const int bits = MapLevel::kBlockBits + (chunks == nullptr ? kRegionBits : 0);
    const Vector3d corner_W = (shifted(cube, bits) * (1 << bits)).cast<double>() * cell_m;
    const double end_m = way.leaves_m(corner_W, corner_W + Vector3d::Constant((1 << bits) * cell_m), last_m);
    sample += std::max<std::int64_t>(1, static_cast<std::int64_t>((end_m - way_m) / step_m));
  }
}

}  // namespace skein::agent
