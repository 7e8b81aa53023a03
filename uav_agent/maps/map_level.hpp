// What a UAV knows of the space around it at one size of cells: which are free, occupied or unknown, and the evidence
// that was gathered about those that are unknown. Cells lie in blocks of 8^3; a block that is free all over takes no
// memory.
// Frame W.   Units: metres.   Threads: one.   Deterministic: no answer depends on an order in memory.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/free_evidence.hpp"

namespace skein::agent {

enum class Space : std::uint8_t { unknown, free, occupied };

/// Beams of the LiDAR that leave beside each other, taken as one; or one alone.
struct BeamBundle {
  Vector3d from_W = Vector3d::Zero();
  Eigen::Vector3f direction_W = Eigen::Vector3f::UnitX();  ///< unit vector: their middle
  float free_m = 0.0F;                                     ///< from `from_W` on, none of them met anything so far
  float around_free_m = 0.0F;                              ///< nor did those around them; at most free_m
  int beams = 1;
};

/// By whom a cell became what it is: by this UAV's own LiDAR, or by one of the fleet (its index + 1), who told it.
using Teller = std::uint8_t;
inline constexpr Teller kOwn = 0;

class MapLevel {
 public:
  using Cell = Eigen::Vector3i;
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits, kCells = kBlock * kBlock * kBlock;
  static constexpr int kMostCells = 256;  ///< that a beam passes along an axis are fewer

  struct Known {
    Space space = Space::unknown;
    Teller teller = kOwn;

    bool operator==(const Known&) const = default;
  };

  /// @param coarser  of cells twice as large, for beams from farther off: what is free there is free here, and its
  ///                 evidence counts here, too. It outlives this, and tells this of its evidence. Or nullptr.
  MapLevel(double cell_m, const FreeCriterion& criterion, MapLevel* coarser);
  MapLevel(const MapLevel&) = delete;
  MapLevel& operator=(const MapLevel&) = delete;

  double cell_m() const { return cell_m_; }
  Cell cell_of(const Vector3d& p_W) const;

  /// Counts beams in each layer across the axis of W that they are nearest to, for the cell whose window in the middle
  /// of that layer they pass, from one distance to another.
  void pass(const BeamBundle& bundle, double from_m, double to_m);
  /// Occupied overwrites all else, and nothing overwrites it but forget() and what doubt() says. A doubt is over when
  /// this UAV finds the cell occupied again.
  /// @returns what it was before.
  Known set(const Cell& cell, Space space, Teller teller);
  /// Makes a cell unknown, whatever it was, and what was gathered about it is gone. At coarser levels it may still be
  /// free.
  void forget(const Cell& cell);
  /// From now on an occupied cell gathers evidence from nothing, and becomes free as an unknown one does.
  void doubt(const Cell& cell);
  bool doubted(const Cell& cell) const;
  std::size_t doubts() const { return doubts_; }
  /// Makes those cells of a cube within a block free that are in doubt, if this UAV itself knows them to be free now,
  /// or whoever told of them.   @param edge  in cells.
  void settle_free(const Cell& lowest, int edge, Teller teller);

  /// Of this level alone.
  Known known(const Cell& cell) const;
  /// Of all cells of a block, x first.
  void read(const Cell& block, std::array<Known, kCells>& known) const;

  /// Takes memory back: of blocks that are free all over, and of those of which nothing is known, farther than
  /// `forget_m` from a place, evidence and all.
  void tidy(const Vector3d& p_W, double forget_m);
  /// Only of the former.
  void tidy() { tidy(Vector3d::Zero(), std::numeric_limits<double>::infinity()); }
  /// Cells of which something new was said since it was asked last.
  std::vector<Cell> take_changes() { return std::exchange(changes_, {}); }
  /// Cells that became occupied, or are so no longer, since it was asked last.
  std::vector<Cell> take_structure_changes() { return std::exchange(structure_changes_, {}); }

  std::size_t free_cells() const { return free_; }
  std::size_t occupied_cells() const { return occupied_; }
  std::size_t blocks() const { return blocks_.size() - spare_.size(); }
  std::size_t bytes() const {
    return blocks_.capacity() * sizeof(Block) + evidences_ * sizeof(Evidence) + slots_.bytes();
  }
  std::uint64_t windows() const { return windows_; }

  static Cell block_of(const Cell& cell) { return shifted(cell, kBlockBits); }
  /// Of a cell in its block, x first.
  static std::size_t place_of(const Cell& cell) {
    const auto along = [&](int axis) { return static_cast<std::size_t>(cell[axis] & (kBlock - 1)); };
    return along(0) | along(1) << kBlockBits | along(2) << 2 * kBlockBits;
  }
  /// Of the cell at a place of a block, x first: where it is in the block.
  static Cell in_block(std::size_t place) {
    const auto at = static_cast<int>(place);
    return {at & (kBlock - 1), at >> kBlockBits & (kBlock - 1), at >> 2 * kBlockBits};
  }

 private:
  using Evidence = std::array<BeamEvidence, kCells>;
  struct Block {
    Cell at = Cell::Zero();  ///< its number
    int free = 0, occupied = 0;
    std::unique_ptr<Evidence> evidence = {};  ///< none before a beam passes: a map that is only told of has none at all
    std::array<Space, kCells> space = {};
    std::array<Teller, kCells> teller = {};
  };
  /// Where a block is, or what all of it is.
  struct Slot {
    std::uint32_t number = kNone;  ///< kNone, kAllFree or kFirst and more: in blocks_
    Teller teller = kOwn;          ///< of kAllFree
  };
  struct Walk;
  static constexpr std::uint32_t kNone = 0, kAllFree = 1, kFirst = 2;

  static Cell cell_at(const Block& block, std::size_t place) { return block.at * kBlock + in_block(place); }
  /// Made if there is none. nullptr where all of it is free.
  Block* block(const Cell& at);
  /// Made even if all of it is free.
  Block& opened_block(const Cell& at);
  Block& new_block(const Cell& at, Slot& slot);
  /// Of this level, or of the coarser one about it.
  Known known_at_all(const Cell& cell) const;
  /// Of this level and of all coarser ones.
  BeamEvidence all_evidence(const Cell& cell) const;
  void change(Block& block, std::size_t place, Space space, Teller teller);
  static bool doubted(const Block& block, std::size_t place) {
    return block.space[place] == Space::occupied && block.evidence && (*block.evidence)[place].may_remind();
  }
  void settle(Block& block, std::size_t place);
  /// Made if there is none.
  Evidence& evidence_of(Block& block);
  void ask(Block& block, std::size_t place);
  /// Whether it is free by now, or some of the finer cells in it.
  /// @param beyond  evidence of all coarser levels.
  void ask(Block& block, std::size_t place, const BeamEvidence& beyond);
  void ask_within(const Cell& coarser_cell, const BeamEvidence& beyond);

  double cell_m_;
  FreeJudge judge_;
  const MapLevel* coarser_;
  MapLevel* finer_ = nullptr;
  BlockTable<Slot> slots_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> spare_;  ///< in blocks_
  std::vector<Cell> changes_, structure_changes_;
  std::size_t free_ = 0, occupied_ = 0, doubts_ = 0, evidences_ = 0;
  std::uint64_t windows_ = 0;
};

}  // namespace skein::agent
