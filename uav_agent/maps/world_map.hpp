// The world map: which cubes of space are free, occupied or unknown, according to all beams of this UAV's LiDAR and to
// the reports of other UAVs.
//
// A cube becomes occupied when a beam ends in it, and stays so: later beams that pass a thin member must not erase it.
// Only a cube that may have been a UAV can be taken back, by doubt() or vacate().
// A cube becomes free when so many beams have passed it that they would have hit a member in it (free_evidence.hpp).
// Until then it is unknown, and the map gathers evidence. Few beams reach a place far away, so the map has levels:
// cubes of 0.5 m for beams up to 8 m from the LiDAR, of 1 m up to 16 m, of 2 m beyond. For a larger cube, a beam counts
// only if it and the beams around it pass the whole cube: a cube half of which is hidden behind something is not free.
// The evidence of a cube is its own plus that of the larger cubes around it, which was gathered from farther away.
// Frame W.   Units: metres.   Threads: one.   Deterministic: no answer depends on an order in memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "uav_agent/maps/distance_field.hpp"
#include "uav_agent/maps/map_level.hpp"

namespace skein::agent {

/// A UAV's report of one cube, whose edge is 2^level smallest cubes.
struct HeardCube {
  Eigen::Vector3i cube = Eigen::Vector3i::Zero();  ///< index, in cubes of its level
  int level = 0;                                   ///< 0 to WorldMap::levels() - 1
  Space space = Space::unknown;                    ///< free; occupied only at level 0

  bool operator==(const HeardCube&) const = default;
};

class WorldMap {
 public:
  using Cube = Eigen::Vector3i;
  struct Config {
    double cell_m = 0.5;  ///< of the smallest cubes; chosen
    /// One to four distances from the LiDAR, ascending: up to about the first, beams are evidence for cubes of cell_m;
    /// up to the second, for cubes twice as large; and so on. Beyond the last, only hits count. Chosen.
    std::vector<double> to_m = {8.0, 16.0, 48.0};
    FreeCriterion criterion = {};
    double distance_reach_m = 4.0;  ///< search radius of structure_distance_m(): 1 to 8 times cell_m; chosen
    /// Hits below this height are the ground, which is known without a map (level, z = 0): they are not kept.
    /// Numeric: the default keeps all.
    double ground_m = -1e6;
  };
  /// Edge of a chunk, in smallest cubes. A chunk is a block of the finest level, and the unit of changed_at().
  static constexpr int kChunk = MapLevel::kBlock;
  static constexpr int kRegionBits = 2, kRegion = 1 << kRegionBits;  ///< memory: edge of a region, in chunks
  static constexpr int kRegionChunks = kRegion * kRegion * kRegion;
  /// The i-th chunk of a region, x first.
  static Cube chunk_of(const Cube& region, int i) {
    return kRegion * region + Cube(i % kRegion, i / kRegion % kRegion, i / (kRegion * kRegion));
  }
  /// The inverse of chunk_of(): i of a chunk in its region.
  static std::size_t place_in_region(const Cube& chunk) {
    const auto along = [&](int axis) { return static_cast<std::size_t>(chunk[axis] & (kRegion - 1)); };
    return along(0) + kRegion * (along(1) + kRegion * along(2));
  }

  /// @throws std::invalid_argument if to_m or distance_reach_m is out of range, or a beam could pass too many cubes.
  explicit WorldMap(const Config& config);

  /// Enters a scan; the caller has left out repeated beams (repeated_scans.hpp).
  /// @param hits_W  points at which beams ended.
  void insert(std::span<const BeamBundle> bundles, std::span<const Eigen::Vector3f> hits_W);
  /// Makes unknown cubes with a point within `radius_m` of p free, except below the ground (z = 0): for the place where
  /// the UAV itself is.
  void set_free(const Vector3d& p_W, double radius_m);
  /// Makes occupied cubes with a point within `radius_m` of p unknown, because beams hit a UAV there. The evidence
  /// about them, and about the larger cubes around them, is discarded.
  void vacate(const Vector3d& p_W, double radius_m);
  /// Doubts an occupied cube that may have been a UAV. It stays occupied until new beams prove it free, like an unknown
  /// cube, or until the UAV that reported it occupied reports it free. If a beam of this UAV ends in it again, the
  /// doubt is over and it stays occupied. Earlier evidence is discarded, as by vacate().
  /// @param cube  a smallest cube.
  void doubt(const Eigen::Vector3i& cube);
  bool doubted(const Eigen::Vector3i& cube) const { return levels_.front()->doubted(cube); }
  /// Enters what a teller reported. A report only raises a cube's state (unknown, free, occupied), or settles a doubt.
  void hear(std::span<const HeardCube> cubes, Teller teller);
  void hear(const Eigen::Vector3i& cube, int level, Space space, Teller teller);

  Space at(const Vector3d& p_W) const { return known(cube_of(p_W)).space; }
  /// State and teller of a smallest cube, at the finest level that knows it.
  MapLevel::Known known(const Eigen::Vector3i& cube) const;
  Eigen::Vector3i cube_of(const Vector3d& p_W) const { return levels_.front()->cell_of(p_W); }
  /// The smallest cubes of a chunk that are occupied and not in doubt. Valid until the map changes.
  MapLevel::Structure structure_in(const Cube& chunk) const {
    const std::uint64_t* const chunks = structured_.find(grid_key(shifted(chunk, kRegionBits)));
    const bool any = chunks != nullptr && (*chunks >> place_in_region(chunk) & 1) != 0;
    return any ? levels_.front()->structure_in(chunk) : MapLevel::Structure();
  }
  /// All chunks with occupied cubes, in no particular order. Valid until the map changes.
  const std::vector<MapLevel::OccupiedBlock>& occupied_chunks() const { return levels_.front()->occupied_blocks(); }
  /// Centre of a smallest cube.
  Vector3d middle_W(const Cube& cube) const { return (cube.cast<double>() + Vector3d::Constant(0.5)) * config_.cell_m; }
  /// Distance between the surfaces of the smallest cube that contains p and of the nearest occupied cube [m]: at most
  /// the distance from p itself, and at most distance_reach_m.
  double structure_distance_m(const Vector3d& p_W) const;
  /// Whether all cubes with a point within `radius_m` of the segment are free. For the tube of a body, radius_m is the
  /// body's radius plus kHaloM.
  bool tube_free(const Vector3d& a_W, const Vector3d& b_W, double radius_m) const;
  /// Whether all cubes with a point within `radius_m` of p are free; cubes entirely below the height `lowest_m` are
  /// ignored.
  bool ball_free(const Vector3d& p_W, double radius_m, double lowest_m) const;
  /// Appends the smallest cubes that make ball_free() false.
  void not_free_near(const Vector3d& p_W, double radius_m, double lowest_m, std::vector<Cube>& cubes) const;
  /// Distance from p to the nearest point of a smallest cube [m].
  double distance_to_m(const Cube& cube, const Vector3d& p_W) const {
    return ((p_W - middle_W(cube)).cwiseAbs().array() - 0.5 * config_.cell_m).max(0.0).matrix().norm();
  }
  /// Distance along a unit vector to the first occupied cube that is not in doubt, at most `reach_m` [m]. Sampled at
  /// multiples of half a cube.
  double clear_way_m(const Vector3d& from_W, const Vector3d& direction_W, double reach_m) const;

  using Chunk = std::array<MapLevel::Known, MapLevel::kCells>;  ///< its smallest cubes, x first
  /// known() of all cubes of a chunk.
  void read(const Eigen::Vector3i& chunk, Chunk& known) const;
  /// The cubes of a chunk that known() tells to have this state.
  CellRows rows(const Eigen::Vector3i& chunk, Space space) const;
  /// Number of the map's last change in a chunk, or in a region of 4^3 chunks: 1, 2, ...; 0: nothing was ever known.
  std::uint64_t changed_at(const Eigen::Vector3i& chunk) const;
  std::uint64_t region_changed_at(const Eigen::Vector3i& region) const;
  /// Number of the map's last change.
  std::uint64_t changes() const { return changes_; }
  using ChunksChangedAt = std::array<std::uint64_t, kRegionChunks>;
  /// changed_at() of all chunks of a region, in the order of chunk_of(). Valid until the map changes.
  /// @param region  one of regions().
  const ChunksChangedAt& chunks_changed_at(const Eigen::Vector3i& region) const {
    return in_regions_.find(grid_key(region))->chunks;
  }
  /// A number that rises whenever a cube of the chunk becomes occupied, or ceases to be occupied.
  std::uint64_t structure_changed_at(const Eigen::Vector3i& chunk) const {
    const ChunkNote* const found = chunks_.find(grid_key(chunk));
    return found == nullptr ? 0 : found->structure_changed_at;
  }
  /// All regions with a cube that was ever known, in order of their first change.
  const std::vector<Eigen::Vector3i>& regions() const { return regions_; }

  const Config& config() const { return config_; }
  /// Callback for each smallest cube in which a beam of this UAV ends, and for each that a report of another UAV makes
  /// occupied. @param news  whether the cube was not occupied before.
  using OnMet = std::function<void(const Eigen::Vector3i& cube, bool news)>;
  void on_met(OnMet on_met) { on_met_ = std::move(on_met); }
  /// Other UAVs' reports that a smallest cube is occupied are ignored if this map has proved the cube free, and
  /// `ignores` is true of it: a UAV's report of this UAV itself (own_trail.hpp).
  using Ignores = std::function<bool(const Eigen::Vector3i& cube)>;
  void ignore_reports(Ignores ignores) { ignores_ = std::move(ignores); }

  int levels() const { return static_cast<int>(levels_.size()); }

  struct Counts {
    std::vector<std::size_t> free;  ///< number of free cubes, by level
    std::size_t occupied = 0;
    std::size_t blocks = 0;     ///< stored blocks, see MapLevel::tidy()
    std::size_t bytes = 0;      ///< memory
    std::uint64_t windows = 0;  ///< windows that beams have passed, those of known cubes included
  };
  Counts counts() const;

 private:
  /// The map's note of a chunk: changed_at(), and a cache of its free smallest cubes, updated on demand.
  struct ChunkNote {
    std::uint64_t changed_at = 0, structure_changed_at = 0;
    mutable std::uint64_t read_at = 0;  ///< changed_at to which free_rows belongs
    mutable CellRows free_rows = {};
    mutable bool all_free = false;  ///< whether all bits of free_rows are set
  };
  struct RegionNote {
    std::uint64_t changed_at = 0;
    ChunksChangedAt chunks = {};
  };
  struct Ball {
    Vector3d p_W;
    double radius_m, lowest_m;
    Cube low, high;  ///< range of cubes that may have a point in the ball
  };

  class FreeCubes;

  /// Distance from the LiDAR at which the bundle stops being evidence for this level, and the next level takes over.
  double handed_over_m(const BeamBundle& bundle, std::size_t level) const;
  void meet(const Cube& cube, Teller teller);
  void tidy_if_grown();
  void take(const HeardCube& heard, Teller teller);
  void settle_free(const Cube& cube, int level, Teller teller);
  void unprove_around(const Cube& cube);
  void note_changes();
  /// The chunk's note with an up-to-date free_rows; nullptr: nothing is known of the chunk.
  const ChunkNote* free_rows(const Cube& chunk) const;
  template <class Test>
  bool all_chunks(const Cube& lowest, const Cube& highest, const Test& test) const;
  bool ball_free_in(const Cube& chunk, const Ball& ball) const;
  template <class Visit>
  bool all_near(const Vector3d& a_W, const Vector3d& b_W, double radius_m, Visit&& visit) const;

  Config config_;
  std::vector<std::unique_ptr<MapLevel>> levels_;  ///< the smallest cubes first
  mutable DistanceField distances_;                ///< distances to occupied cubes, computed on demand
  BlockTable<ChunkNote> chunks_;
  BlockTable<RegionNote> in_regions_;
  std::vector<Eigen::Vector3i> regions_;
  /// The chunks in which cubes ever were occupied: by region, one bit for each chunk, in the order of chunk_of(). And
  /// the box around all such cubes, in cubes. For clear_way_m() and structure_in(), which are
  /// asked about many places far from any structure.
  BlockTable<std::uint64_t> structured_;
  Cube structure_low_ = Cube::Zero(), structure_high_ = Cube::Zero();
  std::uint64_t changes_ = 0, scans_ = 0;
  std::size_t tidied_blocks_ = 0;  ///< number of blocks after the last tidy_if_grown() that tidied
  OnMet on_met_;
  Ignores ignores_;
};

}  // namespace skein::agent
