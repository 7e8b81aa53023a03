// How far ways from the LiDAR are clear of structure, for the many beams of a scan: the same answers as those of
// WorldMap::clear_way_m(), several times as fast. Most beams point at the sky, and most others pass few chunks with
// occupied cubes. So the directions are divided into the squares of a cube around the LiDAR, and each square has a list
// of the chunks whose occupied cubes may be seen in it.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class ClearWays {
 public:
  /// For the ways of a scan. @param map  must not change until the last of them.
  /// @param most_m  what is farther away does not matter: it counts as clear.
  void begin(const WorldMap& map, double most_m);
  /// Like WorldMap::clear_way_m(): distance along a unit vector to the first cube that is occupied and not in doubt;
  /// `reach_m` if it is not within `reach_m`, or not within `most_m`.
  double clear_way_m(const Vector3d& from_W, const Vector3d& direction_W, double reach_m);

 private:
  static constexpr int kSquares = 10;  ///< along an edge of a face; chosen: 9 degrees
  /// Distance from the place of look() within which its lists are valid; chosen: a scan at 0.5 m/s.
  static constexpr double kMovesM = 0.05;
  /// A chunk with occupied cubes, and the box around these.
  struct Box {
    WorldMap::Cube chunk;
    Vector3d low_W, high_W;
  };

  void look(const Vector3d& from_W);
  void list(std::uint32_t number, const Vector3d& low, const Vector3d& high);
  std::vector<std::uint32_t>& square(int face, int u, int v) {
    return squares_[static_cast<std::size_t>((face * kSquares + v) * kSquares + u)];
  }

  const WorldMap* map_ = nullptr;
  double most_m_ = 0.0;
  std::optional<Vector3d> looked_from_W_;  ///< nullopt: not yet in this scan
  std::vector<Box> boxes_;
  std::array<std::vector<std::uint32_t>, 6 * kSquares * kSquares> squares_;  ///< indices in boxes_; geometry: 6 faces
};

}  // namespace skein::agent
