// What a UAV knows of the space around it, from all beams of its LiDAR: cubes that are free, occupied or unknown.
//
// A cube is occupied when a beam ended in it, for good: thin members must not be carved away by beams that pass them.
// It is free when so many beams have passed it that a member would have been seen (free_evidence.hpp); till then it is
// unknown, and evidence is gathered. A beam counts in each layer of cubes across the axis of W that it is nearest to,
// for the cube whose window in the middle of that layer it passes.
// Frame W.   Units: metres.   Threads: one.   Deterministic: no answer depends on an order in memory.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/free_evidence.hpp"

namespace skein::agent {

/// A beam of the LiDAR.
struct Beam {
  Vector3d from_W = Vector3d::Zero();
  Eigen::Vector3f direction_W = Eigen::Vector3f::UnitX();  ///< unit vector
  float free_m = 0.0F;                                     ///< from `from_W` on, it met nothing so far
  bool returned = false;                                   ///< there it met something
};

enum class Space : std::uint8_t { unknown, free, occupied };

class WorldMap {
 public:
  struct Config {
    double cell_m = 0.5;
    double evidence_range_m = 50.0;  ///< of a beam; beyond it only where the beam ended counts
    double forget_m = 70.0;          ///< from the sensor: blocks of cubes that are all unknown, evidence and all
    FreeCriterion criterion = {};
  };

  explicit WorldMap(const Config& config) : config_(config) {}

  /// The beams of a scan, those that repeat others left out.
  void insert(std::span<const Beam> beams);
  /// Makes the cubes with a point within `radius_m` free, unless they are occupied: where the UAV itself stands.
  void set_free(const Vector3d& p_W, double radius_m);

  Space at(const Vector3d& p_W) const;
  /// Whether all cubes with a point within `radius_m` of the segment are free. For the tube of a body, that is its
  /// radius and kHaloM.
  bool tube_free(const Vector3d& a_W, const Vector3d& b_W, double radius_m) const;

  struct Counts {
    std::size_t free = 0, occupied = 0;  ///< cubes
    std::size_t blocks = 0;              ///< that are neither free all over nor forgotten
    std::size_t bytes = 0;               ///< of memory
    std::uint64_t windows = 0;           ///< that beams have passed, those of cubes that were known among them
  };
  Counts counts() const;

 private:
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits, kCubes = kBlock * kBlock * kBlock;
  using Cube = Eigen::Vector3i;

  struct Block {
    Cube at = Cube::Zero();  ///< its number
    int known = 0, free = 0;
    std::array<BeamEvidence, kCubes> evidence = {};
    std::array<Space, kCubes> space = {};
    std::array<std::uint8_t, kCubes> ask_at = {};  ///< so many beams: when the criterion is asked next
  };

  static std::uint64_t key_of(const Cube& block);
  static Cube block_of(const Cube& cube) {
    return {cube.x() >> kBlockBits, cube.y() >> kBlockBits, cube.z() >> kBlockBits};
  }
  static std::size_t place_of(const Cube& cube);
  Cube cube_of(const Vector3d& p_W) const;
  /// Made if there is none. nullptr where all of it is free.
  Block* block(const Cube& at);
  void set(Block& block, std::size_t place, Space space);
  void pass(const Beam& beam);
  void gather(Block& block, std::size_t place, const BeamEvidence& beam);
  /// Takes blocks back that are free all over, or far away and unknown.
  void tidy(const Vector3d& p_WS);
  Space space_of(const Cube& cube) const;
  template <class Visit>
  bool all_near(const Vector3d& a_W, const Vector3d& b_W, double radius_m, const Visit& visit) const;

  Config config_;
  BlockTable<std::uint32_t> numbers_;  ///< of blocks: kNone, kAllFree or 2 and more
  static constexpr std::uint32_t kNone = 0, kAllFree = 1, kFirst = 2;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> spare_;  ///< in blocks_
  std::uint64_t scans_ = 0;
  Counts counts_;
};

}  // namespace skein::agent
