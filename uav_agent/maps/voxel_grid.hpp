// A bounded grid of cubes. Each cube has a state (unknown, free, occupied) and a mark for each of its six faces, whose
// meaning the planner defines. Knowledge only grows: occupied replaces free, free replaces unknown, a mark stays. So
// two UAVs' grids merge cube by cube into the greater of both, in any order and any number of times, and UAVs that hear
// each other come to equal grids. Cubes are numbered x first, then y, then z; a run of consecutive numbers is a chunk,
// the unit of exchange by radio (map_exchange.hpp).
// Frames: W world, G grid (its origin is the grid's lowest corner, its axes are the cubes').   Units: metres.
// Threads: one.   Deterministic.
// Source: the voxel graph and the merged occupancy map of KIOS, the map chunks of RACER.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/api/payload.hpp"

namespace skein::agent {

enum class VoxelState : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

class VoxelGrid {
 public:
  using Id = std::uint32_t;
  using Cell = Eigen::Vector3i;
  static constexpr int kFaces = 6;  ///< geometry: +x -x +y -y +z -z of G
  /// Most chunks of a grid that chooses the size of its chunks. A message of MapExchange has a hash of each chunk, and
  /// must fit into a radio payload (uav_agent/api/payload.hpp) with all else that a planner puts into it. Chosen.
  static constexpr std::size_t kMostChunks = 1400;
  static constexpr double kMostVoxels = 16e6;  ///< most cubes of a grid; memory

  /// @param X_WG  pose of the lowest corner.   @param size_m  is rounded up to whole cubes, at least one.
  /// @param chunk_voxels  cubes in a chunk; nullopt: 512, or more if there were more than kMostChunks chunks otherwise.
  /// @throws std::invalid_argument for an edge that is not positive, empty chunks or chunks of more than 65,535 cubes,
  ///   or more than kMostVoxels cubes.
  VoxelGrid(const Isometry3d& X_WG, const Vector3d& size_m, double voxel_m,
            std::optional<std::size_t> chunk_voxels = std::nullopt);

  double voxel_m() const { return voxel_m_; }
  const Cell& dims() const { return dims_; }
  Id count() const { return static_cast<Id>(voxels_.size()); }
  /// Hash of the grid's pose, size, cubes and chunks. Grids may exchange chunks if their fingerprints are equal.
  std::uint32_t fingerprint() const;

  /// nullopt outside the grid.
  std::optional<Id> at(const Vector3d& p_W) const;
  std::optional<Id> at(const Cell& cell) const;
  Cell cell(Id id) const;
  /// The lowest and the highest cell of a range that includes all cells with their centre in a cube with axes along
  /// W's, given by its middle and half its edge. If no cell of the grid is in it, lowest > highest along some axis.
  std::pair<Cell, Cell> cells_within(const Vector3d& middle_W, double half_edge_m) const;
  Vector3d centre_W(Id id) const;
  /// The cube on the other side of a face; nullopt at the grid's boundary.
  std::optional<Id> neighbour(Id id, int face) const;
  /// Outward unit normal of a face.
  Vector3d normal_W(int face) const;
  static int opposite(int face) { return face ^ 1; }

  VoxelState state(Id id) const { return static_cast<VoxelState>(voxels_[id] & kStateBits); }
  bool marked(Id id, int face) const { return (voxels_[id] & mark_bit(face)) != 0; }
  /// raise() sets a state if it is greater than the present one. Both return whether they changed anything.
  bool raise(Id id, VoxelState state);
  bool mark(Id id, int face);
  /// Cubes whose state has changed since the last call, in the order of change; a cube may occur twice.
  std::vector<Id> take_changed();
  /// Grows whenever anything changes.
  std::uint64_t revision() const { return revision_; }

  /// Calls `visit` with the cubes that the segment passes, in order, until it returns false. Parts of the segment
  /// outside the grid are skipped. Source: Amanatides and Woo 1987.
  void along(const Vector3d& a_W, const Vector3d& b_W, const std::function<bool(Id)>& visit) const;
  /// Whether no occupied cube lies on the segment; the cubes of both ends do not count.
  bool sees(const Vector3d& a_W, const Vector3d& b_W) const;
  /// Calls `visit` with all cubes within `steps` cubes of one, itself included.
  template <class Visit>
  void around(Id id, int steps, Visit&& visit) const;

  std::size_t chunks() const { return chunk_revision_.size(); }
  /// The grid's revision() at the chunk's last change; 0: nothing is known in it.
  std::uint64_t chunk_revision(std::size_t chunk) const { return chunk_revision_[chunk]; }
  /// Hash of the chunk's content; 0 if the chunk has never changed, else not 0.
  std::uint16_t chunk_hash(std::size_t chunk) const;
  /// Appends a chunk in at most chunk_bytes(): run-length coded, or cube by cube if that is shorter.
  void write_chunk(std::size_t chunk, PayloadWriter& writer) const;
  std::size_t chunk_bytes() const { return chunk_voxels_ + 3; }
  /// Reads and merges what write_chunk() wrote. @returns false, and merges nothing, if it is damaged.
  bool merge_chunk(std::size_t chunk, PayloadReader& reader);

 private:
  static constexpr std::uint8_t kStateBits = 3;  ///< format: mask of the two bits of a state
  static std::uint8_t mark_bit(int face) { return static_cast<std::uint8_t>(4U << face); }
  bool set(Id id, std::uint8_t voxel);
  template <class Visit>
  void walk(const Vector3d& a_W, const Vector3d& b_W, Visit&& visit) const;
  std::pair<Id, Id> chunk_range(std::size_t chunk) const;

  Isometry3d X_WG_, X_GW_;
  double voxel_m_;
  Cell dims_;
  std::size_t chunk_voxels_;
  std::vector<std::uint8_t> voxels_;  ///< state in the lowest two bits, then the marks
  std::vector<std::uint64_t> chunk_revision_;
  mutable std::vector<std::pair<std::uint64_t, std::uint16_t>> chunk_hash_;  ///< hash at a revision
  std::uint64_t revision_ = 0;
  std::vector<Id> changed_;
};

template <class Visit>
void VoxelGrid::around(Id id, int steps, Visit&& visit) const {
  const Cell c = cell(id);
  const Cell lo = (c.array() - steps).max(0), hi = (c.array() + steps).min(dims_.array() - 1);
  for (int z = lo.z(); z <= hi.z(); ++z) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      const Id first = static_cast<Id>((z * dims_.y() + y) * dims_.x());
      for (int x = lo.x(); x <= hi.x(); ++x) visit(first + static_cast<Id>(x));
    }
  }
}

/// Makes every cube with its centre in a box occupied: for planners that cannot find out what is inside.
void fill_boxes(const std::vector<OrientedBox>& boxes, VoxelGrid& grid);

/// The smallest box with axes along W's that holds all boxes; empty if there are no boxes.
Eigen::AlignedBox3d extent_of(const std::vector<OrientedBox>& boxes);

/// The smallest grid with axes along W's that holds all boxes and points, and `margin_m` more on each side; nothing
/// of it is below `lowest_m`. KIOS's operational volume.
VoxelGrid operational_volume(const std::vector<OrientedBox>& boxes, const std::vector<Vector3d>& points_W,
                             double margin_m, double lowest_m, double voxel_m);
/// The size of that grid before it is rounded up to whole cubes.
Vector3d operational_size(const std::vector<OrientedBox>& boxes, const std::vector<Vector3d>& points_W, double margin_m,
                          double lowest_m, double voxel_m);
/// The edge of the cubes of a grid that should have cubes of `voxel_m`: larger if there were more than
/// VoxelGrid::kMostVoxels cubes, else the same.   @param size_of  the grid's size, which may depend on the edge.
double fitting_voxel_m(double voxel_m, const std::function<Vector3d(double voxel_m)>& size_of);
/// For the log of a planner whose parameter voxel_m should be `voxel_m`, and is `fitting_m` as above: why, and up to
/// which size of a site it would be `voxel_m`.   @param size_m  of the grid with cubes of `voxel_m`.
std::string coarse_voxels_text(double voxel_m, double fitting_m, const Vector3d& size_m);
/// The operational volume of the boxes, with cubes of `voxel_m`, or larger if there were more than `max_voxels`.
VoxelGrid limited_volume(const std::vector<OrientedBox>& boxes, double margin_m, double voxel_m, int max_voxels);

}  // namespace skein::agent
