// Space in cubes: what is known of each (unknown, free, occupied) and six marks a cube, for whatever a planner keeps
// count of on its six faces. Knowledge only grows: occupied wins over free, free over unknown, a mark stays. So the
// maps of two UAVs merge by taking the greater of both, in any order and as often as wanted, and all who hear each
// other end up with the same map. Cubes are numbered x first, then y, then z; a run of them is a chunk, the unit of
// exchange by radio (map_exchange.hpp).
// Frames: W world, G grid (its origin is the grid's lowest corner, its axes are the cubes').   Units: metres.
// Threads: one.   Deterministic.
// Source: the voxel graph and the merged occupancy map of KIOS, the map chunks of RACER.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/api/payload.hpp"

namespace skein::agent {

enum class VoxelState : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

class VoxelGrid {
 public:
  using Id = std::uint32_t;
  using Cell = Eigen::Vector3i;
  static constexpr int kFaces = 6;  ///< +x -x +y -y +z -z of G

  /// @param X_WG  pose of the lowest corner.   @param size_m  is rounded up to whole cubes.
  /// @throws std::invalid_argument for an empty grid or one of more than 16 million cubes.
  VoxelGrid(const Isometry3d& X_WG, const Vector3d& size_m, double voxel_m, std::size_t chunk_voxels = 512);

  double voxel_m() const { return voxel_m_; }
  const Cell& dims() const { return dims_; }
  Id count() const { return static_cast<Id>(voxels_.size()); }
  /// The same for grids whose chunks may be exchanged: of the same place, size and cubes.
  std::uint32_t fingerprint() const;

  /// nullopt outside the grid.
  std::optional<Id> at(const Vector3d& p_W) const;
  std::optional<Id> at(const Cell& cell) const;
  Cell cell(Id id) const;
  /// The lowest and the highest cell of all that have their middle in a cube along W's axes, and of some beside them;
  /// the lowest lies above the highest along some axis where none is in the grid.
  std::pair<Cell, Cell> cells_within(const Vector3d& middle_W, double half_edge_m) const;
  Vector3d centre_W(Id id) const;
  /// The cube on the other side of a face; nullopt at the rim.
  std::optional<Id> neighbour(Id id, int face) const;
  /// Outward unit normal of a face.
  Vector3d normal_W(int face) const;
  static int opposite(int face) { return face ^ 1; }

  VoxelState state(Id id) const { return static_cast<VoxelState>(voxels_[id] & kStateBits); }
  bool marked(Id id, int face) const { return (voxels_[id] & mark_bit(face)) != 0; }
  /// Both return whether that was news.
  bool raise(Id id, VoxelState state);
  bool mark(Id id, int face);
  /// Takes occupied cubes back to unknown where `seen` says so: for a copy, not for a grid that is exchanged.
  void forget_occupied(const std::function<bool(Id)>& seen);
  /// Cubes whose state changed since this was asked last, in the order of change; some twice.
  std::vector<Id> take_changed();
  /// Grows whenever anything changes.
  std::uint64_t revision() const { return revision_; }

  /// Calls `visit` with the cubes that the segment passes, in order, until it returns false. What lies outside the
  /// grid is left out. (Amanatides and Woo 1987.)
  void along(const Vector3d& a_W, const Vector3d& b_W, const std::function<bool(Id)>& visit) const;
  /// Whether no occupied cube lies on the segment; the cubes of both ends do not count.
  bool sees(const Vector3d& a_W, const Vector3d& b_W) const;
  /// Calls `visit` with all cubes within `steps` cubes of one, itself included.
  void around(Id id, int steps, const std::function<void(Id)>& visit) const;

  std::size_t chunks() const { return chunk_revision_.size(); }
  /// Of the grid, when the chunk last changed; 0: nothing is known in it.
  std::uint64_t chunk_revision(std::size_t chunk) const { return chunk_revision_[chunk]; }
  /// Of the chunk's content; 0 when nothing is known in it.
  std::uint16_t chunk_hash(std::size_t chunk) const;
  /// At most chunk_bytes(): repeated cubes are counted, or the cubes one by one if that is shorter.
  void write_chunk(std::size_t chunk, PayloadWriter& writer) const;
  std::size_t chunk_bytes() const { return chunk_voxels_ + 3; }
  /// Merges what write_chunk() wrote. @returns false, and takes nothing, when it is no such thing.
  bool merge_chunk(std::size_t chunk, PayloadReader& reader);

 private:
  static constexpr std::uint8_t kStateBits = 3;
  static std::uint8_t mark_bit(int face) { return static_cast<std::uint8_t>(4U << face); }
  bool set(Id id, std::uint8_t voxel);
  std::pair<Id, Id> chunk_range(std::size_t chunk) const;

  Isometry3d X_WG_, X_GW_;
  double voxel_m_;
  Cell dims_;
  std::size_t chunk_voxels_;
  std::vector<std::uint8_t> voxels_;  ///< state in the lowest two bits, then the marks
  std::vector<std::uint64_t> chunk_revision_;
  mutable std::vector<std::pair<std::uint64_t, std::uint16_t>> chunk_hash_;  ///< of which revision
  std::uint64_t revision_ = 0;
  std::vector<Id> changed_;
};

/// Makes every cube with its middle in a box occupied: for whoever has nothing to find out with what is inside.
void fill_boxes(const std::vector<OrientedBox>& boxes, VoxelGrid& grid);

/// The smallest box along W's axes that holds all boxes; empty without any.
Eigen::AlignedBox3d extent_of(const std::vector<OrientedBox>& boxes);

/// The smallest grid with axes along W's that holds all boxes and points, and `margin_m` more on each side; nothing
/// of it is below `lowest_m`. KIOS's operational volume.
VoxelGrid operational_volume(const std::vector<OrientedBox>& boxes, const std::vector<Vector3d>& points_W,
                             double margin_m, double lowest_m, double voxel_m, std::size_t chunk_voxels = 512);

}  // namespace skein::agent
