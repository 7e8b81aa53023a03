// The map of key frames: occupied, free and unknown space by LiDAR key frames, in two OctoMap octrees, one of hits and
// a coarser one of free space (known_space.hpp).
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

/// The cells in which the hits of a key frame lie.
struct HitCells {
  struct Block {
    Eigen::Vector3i at;  ///< see HitBlocks
    std::uint64_t cells = 0;
    bool operator==(const Block&) const = default;
  };
  std::vector<Block> blocks;
};

/// The coarse cells that a key frame's rays pass, and the number of rays in each.
struct PassedCells {
  using Block = std::array<std::uint8_t, 64>;           ///< counts of 4 x 4 x 4 cells, 20 at most
  std::vector<std::pair<std::uint64_t, Block>> blocks;  ///< key: RayBlocks::block_of()
};

/// A key frame, traced: the costly part of its insertion into a map is done.
struct FrameCells {
  HitCells hits;
  PassedCells passed;
};

/// Number of rays that must have passed a coarse cell before it counts as free in and near boxes, where structure is
/// likely. Chosen.
inline constexpr int kProofRays = 12;

class OccupancyMap {
 public:
  struct Config {
    double resolution_m = 0.5;       ///< edge of an occupied cell; chosen
    double free_resolution_m = 2.0;  ///< edge of a free cell: 1, 2, 4, ... times resolution_m; chosen
    double ground_m = 0.3;           ///< hits below this height end a ray, but are not obstacles; chosen
    double free_range_m = 30.0;      ///< free space is traced only up to this distance from the sensor; chosen
    int max_free_rays = 400;         ///< about this many rays of a key frame are traced, evenly picked; chosen
  };

  OccupancyMap();
  explicit OccupancyMap(const Config& config);
  ~OccupancyMap();
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;

  /// Marks the hits as occupied, for good: thin members must not be carved away by later rays.
  /// @param p_WS position of the sensor. If it is known, the free space up to the hits is marked, too.
  void insert(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS);
  /// The same in two parts. trace() does not depend on the map's contents: its result serves all maps with this Config.
  void insert(const FrameCells& frame);
  FrameCells trace(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) const;

  const Config& config() const;
  bool empty() const;
  std::size_t occupied_cells() const;
  /// Number of calls of insert() and hear() that made a cell occupied.
  std::uint64_t revision() const;
  /// Number of all insert() calls.
  std::uint64_t key_frames() const;

  /// True when the cell of p holds a hit.
  bool occupied(const Vector3d& p_W) const;
  /// True when at least min(rays, 20) rays passed the coarse cell of p, and the cell of p holds no hit.
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

  /// The map as one OcTree in OctoMap's binary serialisation, as octomap_msgs/msg/Octomap carries it. Leaves are
  /// occupied where occupied() is true, free where known_free(p, rays) is true.
  std::string octomap_bytes(int rays = 3) const;
  /// Merges the octomap_bytes() of another UAV's map: its hits become hits, and its free cells count as passed by
  /// `rays` rays, or by more if more passed them here. Merging the same bytes again changes nothing.
  /// @returns false, and changes nothing, if the bytes are damaged, or describe more space (10^6 cells) than a UAV can
  /// know.
  bool hear(std::string_view bytes, int rays = 3);
  /// octomap_bytes() with OctoMap's header: the bytes of a .bt file, for octovis and other programs that use OctoMap.
  std::string octomap_file(int rays = 3) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
