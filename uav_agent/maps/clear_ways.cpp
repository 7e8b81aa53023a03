#include "uav_agent/maps/clear_ways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::agent {
namespace {

/// Added to all boxes, so that no list lacks a chunk because of rounding errors. Numeric.
constexpr double kRoundingM = 1e-3;
/// A way whose direction has the inverse of this, or less, as its coordinate does not enter or leave a box along that
/// axis. Numeric: it is always right to ask more boxes.
constexpr double kParallel = 1e9;

/// The part of a way in a box: from `enters_m` to `leaves_m`, both rounded; empty if that is less.
struct Part {
  double enters_m = 0.0, leaves_m = std::numeric_limits<double>::max();

  /// @param per_along  inverse of each coordinate of the direction.
  Part(const Vector3d& from_W, const Vector3d& per_along, const Vector3d& low_W, const Vector3d& high_W) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(per_along[axis]) > kParallel) continue;
      const double a_m = (low_W[axis] - from_W[axis]) * per_along[axis];
      const double b_m = (high_W[axis] - from_W[axis]) * per_along[axis];
      enters_m = std::max(enters_m, std::min(a_m, b_m));
      leaves_m = std::min(leaves_m, std::max(a_m, b_m));
    }
  }
};

/// Square of a face in which a slope, the ratio of two coordinates of a direction, lies.
int place_of_slope(double slope, int squares) {
  const double along = (std::clamp(slope, -1.0, 1.0) + 1.0) * 0.5 * squares;
  return std::min(static_cast<int>(along), squares - 1);
}

}  // namespace

void ClearWays::begin(const WorldMap& map, double most_m) {
  map_ = &map;
  most_m_ = most_m;
  looked_from_W_.reset();
}

/// Lists the chunks with occupied cubes for the squares in which they may be seen from within kMovesM of a place.
void ClearWays::look(const Vector3d& from_W) {
  looked_from_W_ = from_W;
  boxes_.clear();
  for (std::vector<std::uint32_t>& numbers : squares_) numbers.clear();
  const double cell_m = map_->config().cell_m, most_m = most_m_ + kMovesM + kRoundingM;
  for (const MapLevel::OccupiedBlock& occupied : map_->occupied_chunks()) {
    const Vector3d low_W = occupied.lowest.cast<double>() * cell_m;
    const Vector3d high_W = (occupied.highest + WorldMap::Cube::Ones()).cast<double>() * cell_m;
    const Vector3d low = low_W - from_W, high = high_W - from_W;
    if (low.cwiseMax(-high).cwiseMax(0.0).squaredNorm() > most_m * most_m) continue;
    const Vector3d margin = Vector3d::Constant(kMovesM + kRoundingM);
    list(static_cast<std::uint32_t>(boxes_.size()), low - margin, high + margin);
    boxes_.push_back({occupied.block, low_W, high_W});
  }
}

/// @param low, high  of the box, relative to the LiDAR.
void ClearWays::list(std::uint32_t number, const Vector3d& low, const Vector3d& high) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  for (int face = 0; face < 6; ++face) {  // geometry: of a cube
    const int axis = face / 2, sense = face % 2;
    const double far = sense == 0 ? high[axis] : -low[axis];
    if (far <= 0.0) continue;
    const double near = std::max(0.0, sense == 0 ? low[axis] : -high[axis]);
    std::array<int, 2> first = {}, last = {};
    bool seen = true;
    for (std::size_t side = 0; side < 2; ++side) {
      const int other = (axis + 1 + static_cast<int>(side)) % 3;  // geometry: the other axes
      const auto slope = [&](double at, bool steepest) {
        return steepest ? (near > 0.0 ? at / near : at * kFar) : at / far;
      };
      const double least = low[other] == 0.0 ? 0.0 : slope(low[other], low[other] < 0.0);
      const double most = high[other] == 0.0 ? 0.0 : slope(high[other], high[other] > 0.0);
      seen = seen && least <= 1.0 && most >= -1.0;
      first[side] = place_of_slope(least, kSquares);
      last[side] = place_of_slope(most, kSquares);
    }
    if (!seen) continue;
    for (int v = first[1]; v <= last[1]; ++v) {
      for (int u = first[0]; u <= last[0]; ++u) square(face, u, v).push_back(number);
    }
  }
}

double ClearWays::clear_way_m(const Vector3d& from_W, const Vector3d& direction_W, double reach_m) {
  if (!looked_from_W_ || (from_W - *looked_from_W_).squaredNorm() > kMovesM * kMovesM) look(from_W);
  int axis = 0;
  const double along = direction_W.cwiseAbs().maxCoeff(&axis);
  const int u = place_of_slope(direction_W[(axis + 1) % 3] / along, kSquares);  // geometry: the other axes
  const int v = place_of_slope(direction_W[(axis + 2) % 3] / along, kSquares);
  const double step_m = 0.5 * map_->config().cell_m;
  const Vector3d per_along = direction_W.cwiseInverse();
  double clear_m = std::min(reach_m, most_m_);
  bool met = false;
  for (const std::uint32_t number : square(2 * axis + (direction_W[axis] < 0.0 ? 1 : 0), u, v)) {
    const Box& box = boxes_[number];
    const Part part(from_W, per_along, box.low_W, box.high_W);
    // One sample more at each end, because of rounding.
    const double enters_m = part.enters_m - step_m, leaves_m = std::min(part.leaves_m + step_m, clear_m);
    if (!(enters_m <= leaves_m)) continue;
    const MapLevel::Structure structure = map_->structure_in(box.chunk);
    for (auto sample = static_cast<std::int64_t>(std::max(0.0, enters_m) / step_m);; ++sample) {
      const double way_m = static_cast<double>(sample) * step_m;
      if (!(way_m < clear_m) || way_m > leaves_m) break;
      const WorldMap::Cube cube = map_->cube_of(from_W + way_m * direction_W);
      if (MapLevel::block_of(cube) != box.chunk || !structure.at(cube)) continue;
      clear_m = way_m;
      met = true;
      break;
    }
  }
  return met ? clear_m : reach_m;
}

}  // namespace skein::agent
