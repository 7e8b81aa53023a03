// What a UAV knows of the space around it, from all beams of its LiDAR and from what others tell: cubes that are free,
// occupied or unknown.
//
// A cube is occupied when a beam ended in it, for good: thin members must not be carved away by beams that pass them.
// Only what may have been a UAV can be taken back: doubt().
// It is free when so many beams have passed it that a member would have been seen (free_evidence.hpp); till then it
// is unknown, and evidence is gathered. A place far away is seen by few beams, so there cubes are larger: 0.5 m up to
// 8 m from the LiDAR, 1 m up to 16 m, 2 m beyond. In larger ones only beams count that pass all of the cube, and so
// do those around them: it is not free where half of it lies behind something. The evidence of a cube is its own and
// that of the larger ones about it, which have what was seen from farther off.
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

/// What somebody tells of a cube of (1 << level) smallest ones along each edge.
struct HeardCube {
  Eigen::Vector3i cube = Eigen::Vector3i::Zero();  ///< in cubes of its level
  int level = 0;                                   ///< 0 up to WorldMap::levels() - 1
  Space space = Space::unknown;                    ///< free, or occupied at level 0

  bool operator==(const HeardCube&) const = default;
};

class WorldMap {
 public:
  using Cube = Eigen::Vector3i;
  struct Config {
    double cell_m = 0.5;  ///< of the smallest cubes
    /// About up to there beams are evidence for cubes of cell_m, for those twice as large, and so on: one to four.
    /// Beyond the last, only what beams met counts.
    std::vector<double> to_m = {8.0, 16.0, 48.0};
    FreeCriterion criterion = {};
    double distance_reach_m = 4.0;  ///< structure_distance_m() looks so far
    /// What beams meet below is the ground, which is level at z = 0 and known without a map: it is not kept.
    double ground_m = -1e6;
  };
  /// Edge of what changed_at() is asked of, and of a block of the smallest cubes.
  static constexpr int kChunk = MapLevel::kBlock;
  static constexpr int kRegion = 4;  ///< chunks along an edge of a region
  static constexpr int kRegionChunks = kRegion * kRegion * kRegion;
  /// The i-th chunk of a region, x first.
  static Cube chunk_of(const Cube& region, int i) {
    return kRegion * region + Cube(i % kRegion, i / kRegion % kRegion, i / (kRegion * kRegion));
  }
  /// The other way round.
  static std::size_t place_in_region(const Cube& chunk) {
    const auto along = [&](int axis) { return static_cast<std::size_t>(chunk[axis] & (kRegion - 1)); };
    return along(0) + kRegion * (along(1) + kRegion * along(2));
  }

  explicit WorldMap(const Config& config);

  /// A scan, without beams that repeat others.
  /// @param hits_W  where beams ended.
  void insert(std::span<const BeamBundle> bundles, std::span<const Eigen::Vector3f> hits_W);
  /// Makes the cubes with a point within `radius_m` free, unless they are occupied or below the ground (z = 0): where
  /// the UAV itself stands.
  void set_free(const Vector3d& p_W, double radius_m);
  /// Makes occupied cubes with a point within `radius_m` unknown: a UAV was seen there that has moved on. Whatever was
  /// gathered about them, and about the larger cubes around them, counts no more.
  void vacate(const Vector3d& p_W, double radius_m);
  /// An occupied cube that may have been a UAV. It stays occupied until beams from now on prove it to be free, as they
  /// do of an unknown one, or until who told of it tells that it is free. When a beam ends in it again, it is occupied
  /// for good. What was gathered before counts no more, as with vacate().
  /// @param cube  a smallest one.
  void doubt(const Eigen::Vector3i& cube);
  bool doubted(const Eigen::Vector3i& cube) const { return levels_.front()->doubted(cube); }
  /// What somebody told. Less than what is known already is not taken.
  void hear(std::span<const HeardCube> cubes, Teller teller);
  void hear(const Eigen::Vector3i& cube, int level, Space space, Teller teller);

  Space at(const Vector3d& p_W) const { return known(cube_of(p_W)).space; }
  /// @param cube  a smallest one.
  MapLevel::Known known(const Eigen::Vector3i& cube) const;
  Eigen::Vector3i cube_of(const Vector3d& p_W) const { return levels_.front()->cell_of(p_W); }
  /// Of a smallest cube.
  Vector3d middle_W(const Cube& cube) const { return (cube.cast<double>() + Vector3d::Constant(0.5)) * config_.cell_m; }
  /// From the smallest cube about a place to the nearest occupied one, from surface to surface, so never more than it
  /// is from the place itself; distance_reach_m where none is nearer.
  double structure_distance_m(const Vector3d& p_W) const;
  /// Whether all cubes with a point within `radius_m` of the segment are free. For the tube of a body, that is its
  /// radius and kHaloM.
  bool tube_free(const Vector3d& a_W, const Vector3d& b_W, double radius_m) const;
  /// Whether all cubes with a point within `radius_m` of a place are free, those apart that lie below `lowest_m`.
  bool ball_free(const Vector3d& p_W, double radius_m, double lowest_m) const;
  /// Smallest cubes with a point within `radius_m` of a place that are not free, those apart that lie below `lowest_m`.
  void not_free_near(const Vector3d& p_W, double radius_m, double lowest_m, std::vector<Cube>& cubes) const;
  /// From a place to the nearest point of a smallest cube.
  double distance_to_m(const Cube& cube, const Vector3d& p_W) const {
    return ((p_W - middle_W(cube)).cwiseAbs().array() - 0.5 * config_.cell_m).max(0.0).matrix().norm();
  }
  /// How far along a unit vector no cube is occupied, but for those in doubt; asked in steps of half a cube: `reach_m`
  /// at most.
  double clear_way_m(const Vector3d& from_W, const Vector3d& direction_W, double reach_m) const;

  using Chunk = std::array<MapLevel::Known, MapLevel::kCells>;  ///< of its smallest cubes, x first
  /// All of a chunk at once.
  void read(const Eigen::Vector3i& chunk, Chunk& known) const;
  /// When something of a chunk, or of a region of 4^3 chunks, became known last: 1, 2, ...; 0: nothing is known.
  std::uint64_t changed_at(const Eigen::Vector3i& chunk) const;
  std::uint64_t region_changed_at(const Eigen::Vector3i& region) const;
  using ChunksChangedAt = std::array<std::uint64_t, kRegionChunks>;
  /// changed_at() of all chunks of a region, in the order of chunk_of(). Good until the map changes.
  /// @param region  one of regions().
  const ChunksChangedAt& chunks_changed_at(const Eigen::Vector3i& region) const {
    return in_regions_.find(grid_key(region))->chunks;
  }
  /// Differs from what it was whenever one of a chunk's cubes has become occupied since, or is so no longer.
  std::uint64_t structure_changed_at(const Eigen::Vector3i& chunk) const {
    const ChunkNote* const found = chunks_.find(grid_key(chunk));
    return found == nullptr ? 0 : found->structure_changed_at;
  }
  /// All regions of which something is known, in the order in which they became so.
  const std::vector<Eigen::Vector3i>& regions() const { return regions_; }

  const Config& config() const { return config_; }
  /// Is called with each smallest cube in which beams of this UAV end, and with those that others newly tell to be
  /// occupied; and whether that is news.
  using OnMet = std::function<void(const Eigen::Vector3i& cube, bool news)>;
  void on_met(OnMet on_met) { on_met_ = std::move(on_met); }

  int levels() const { return static_cast<int>(levels_.size()); }

  struct Counts {
    std::vector<std::size_t> free;  ///< cubes, by level
    std::size_t occupied = 0;
    std::size_t blocks = 0;     ///< that are neither free all over nor forgotten
    std::size_t bytes = 0;      ///< of memory
    std::uint64_t windows = 0;  ///< that beams have passed, those of cubes that were known among them
  };
  Counts counts() const;

 private:
  /// Of a chunk: changed_at(), and which of its smallest cubes are free, worked out anew when that is asked for.
  struct ChunkNote {
    std::uint64_t changed_at = 0, structure_changed_at = 0;
    mutable std::uint64_t read_at = 0;                                ///< free_rows are of that change
    mutable std::array<std::uint8_t, kChunk* kChunk> free_rows = {};  ///< a bit for each x; y first
    mutable bool all_free = false;                                    ///< so are all bits of them
  };
  struct RegionNote {
    std::uint64_t changed_at = 0;
    ChunksChangedAt chunks = {};
  };
  struct Ball {
    Vector3d p_W;
    double radius_m, lowest_m;
    Cube low, high;  ///< no cubes but those from the one to the other have a point in it
  };

  class FreeCubes;

  /// Up to where a beam is evidence for cubes of a level.
  double handed_over_m(const BeamBundle& bundle, std::size_t level) const;
  void meet(const Cube& cube, Teller teller);
  void tidy_if_grown();
  void take(const HeardCube& heard, Teller teller);
  void settle_free(const Cube& cube, int level, Teller teller);
  void unprove_around(const Cube& cube);
  void note_changes();
  /// nullptr: nothing is known of it.
  const ChunkNote* free_rows(const Cube& chunk) const;
  template <class Test>
  bool all_chunks(const Cube& lowest, const Cube& highest, const Test& test) const;
  bool ball_free_in(const Cube& chunk, const Ball& ball) const;
  template <class Visit>
  bool all_near(const Vector3d& a_W, const Vector3d& b_W, double radius_m, Visit&& visit) const;

  Config config_;
  std::vector<std::unique_ptr<MapLevel>> levels_;  ///< the smallest cubes first
  mutable DistanceField distances_;                ///< of occupied cubes, worked out when they are asked for
  BlockTable<ChunkNote> chunks_;
  BlockTable<RegionNote> in_regions_;
  std::vector<Eigen::Vector3i> regions_;
  std::uint64_t changes_ = 0, scans_ = 0;
  std::size_t tidied_blocks_ = 0;  ///< that there were after the last time
  OnMet on_met_;
};

}  // namespace skein::agent
