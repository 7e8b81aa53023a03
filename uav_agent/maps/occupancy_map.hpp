// What this UAV knows of the space around it, from LiDAR key frames: occupied, free and unknown, kept by OctoMap in an
// octree of hits and a coarser one of free space (known_space.hpp).
// Frame W.   Units: metres.   Threads: one.   Deterministic: no answer depends on a hash order.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// Which cells the hits of a key frame lie in.
struct HitCells {
  struct Block {
    Eigen::Vector3i at;  ///< see HitBlocks
    std::uint64_t cells = 0;
    bool operator==(const Block&) const = default;
  };
  std::vector<Block> blocks;
};

/// How many of a key frame's rays pass which coarse cells.
struct PassedCells {
  using Block = std::array<std::uint8_t, 64>;  ///< 4 x 4 x 4 cells; counts end at 20
  std::vector<std::pair<std::uint64_t, Block>> blocks;
};

/// A key frame as a map takes it in: all that inserting it takes time for.
struct FrameCells {
  HitCells hits;
  PassedCells passed;
};

/// So many rays must have passed a place before it is believed to be free where something may well be: in and beside
/// boxes.
inline constexpr int kProofRays = 12;

class OccupancyMap {
 public:
  struct Config {
    double resolution_m = 0.5;       ///< edge of an occupied cell
    double free_resolution_m = 2.0;  ///< free space is traced on a grid this coarse: 1, 2, 4, ... times the other
    double ground_m = 0.3;           ///< hits below end a ray, but are no obstacle
    double free_range_m = 30.0;      ///< and only this far from the sensor
    int max_free_rays = 400;         ///< a key frame; evenly picked
  };

  OccupancyMap();
  explicit OccupancyMap(const Config& config);
  ~OccupancyMap();
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;

  /// Marks the hits as occupied, for good: thin members must not be carved away by later rays.
  /// @param p_WS where the sensor stood, if known: free space up to the hits is marked, too.
  void insert(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS);
  /// The same in two parts: trace() asks for nothing that is in the map, and serves all maps of a Config.
  void insert(const FrameCells& frame);
  FrameCells trace(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) const;

  const Config& config() const;
  bool empty() const;
  std::size_t occupied_cells() const;
  /// Number of insert() calls that changed anything that is occupied.
  std::uint64_t revision() const;
  /// Number of all insert() calls.
  std::uint64_t key_frames() const;

  /// True when the cell of p holds a hit.
  bool occupied(const Vector3d& p_W) const;
  /// True when at least so many rays (20 at most) passed the coarse cell of p, and nothing was hit at p.
  bool known_free(const Vector3d& p_W, int rays = 3) const;
  /// True when the centre of an occupied cell lies within `radius` of p.
  bool any_occupied_within(const Vector3d& p_W, double radius) const;
  /// Distance from p to the nearest centre of an occupied cell, or nullopt if there is none within `max_distance`.
  std::optional<double> distance_to_occupied(const Vector3d& p_W, double max_distance) const;
  /// True when no centre of an occupied cell lies within `radius` of the segment ab.
  bool segment_clear(const Vector3d& a_W, const Vector3d& b_W, double radius) const;
  /// Distance along the unit vector `direction` to the first occupied cell that comes within `radius` of the ray,
  /// or nullopt if there is none up to `max_distance`.
  std::optional<double> cast(const Vector3d& from_W, const Vector3d& direction, double max_distance,
                             double radius) const;
  /// Calls `visit` with the centre of every occupied cell that is inside the box, in a fixed order.
  void visit_occupied(const OrientedBox& box, const std::function<void(const Vector3d&)>& visit) const;

  /// All of it as one OcTree in OctoMap's binary serialisation: a leaf is occupied where occupied() is true, free where
  /// known_free() is with so many rays. What octomap_msgs/msg/Octomap carries.
  std::string octomap_bytes(int rays = 3) const;
  /// Takes in what the octomap_bytes() of another UAV's map say: its hits, and of places that were free to it as if so
  /// many rays had passed here, too, unless more did. To hear the same twice changes nothing.
  /// @returns false, and takes nothing, when these are no such bytes, or tell of more space than a UAV can know.
  bool hear(std::string_view bytes, int rays = 3);
  /// The same with its head: a file of the kind .bt, for octovis and whatever else stands on OctoMap.
  std::string octomap_file(int rays = 3) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
