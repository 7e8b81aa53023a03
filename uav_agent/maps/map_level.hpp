// One level of a WorldMap: the cells of one size, which are free, occupied or unknown, and the free-space evidence
// about the unknown ones (free_evidence.hpp). Cells are stored in blocks of 8^3; tidy() frees the memory of a block
// whose cells are all free.
// Frame W.   Units: metres.   Threads: one.   Deterministic: no answer depends on an order in memory.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/cell_rows.hpp"
#include "uav_agent/maps/free_evidence.hpp"

namespace skein::agent {

enum class Space : std::uint8_t { unknown, free, occupied };

/// Adjacent beams of the LiDAR that are treated as one; or a single beam.
struct BeamBundle {
  Vector3d from_W = Vector3d::Zero();
  Eigen::Vector3f direction_W = Eigen::Vector3f::UnitX();  ///< unit vector: the middle of the beams
  float free_m = 0.0F;                                     ///< distance from `from_W` up to which no beam met anything
  float around_free_m = 0.0F;                              ///< the same for the bundles around, too; at most free_m
  int beams = 1;
};

/// The UAV that determined a cell's state: kOwn, or the UAV whose map message reported it (teller_of()).
using Teller = std::uint8_t;
inline constexpr Teller kOwn = 0;

class MapLevel {
 public:
  using Cell = Eigen::Vector3i;
  /// Memory: edge of a block, in cells.
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits, kCells = kBlock * kBlock * kBlock;
  static constexpr int kMostCells = 256;  ///< numeric: a beam passes fewer cells than this along an axis

  struct Known {
    Space space = Space::unknown;
    Teller teller = kOwn;

    bool operator==(const Known&) const = default;
  };

  /// @param coarser  level with cells twice as large, for beams from farther away; nullptr: none. What is free there is
  ///                 free here, and its evidence counts here, too. It must outlive this level, to which it keeps a
  ///                 pointer: new evidence there may prove cells of this level free.
  MapLevel(double cell_m, const FreeCriterion& criterion, MapLevel* coarser);
  MapLevel(const MapLevel&) = delete;
  MapLevel& operator=(const MapLevel&) = delete;

  double cell_m() const { return cell_m_; }
  Cell cell_of(const Vector3d& p_W) const;

  /// Adds the bundle's beams to the evidence of the cells that it passes between two distances from its origin. Layers
  /// are normal to the axis of W that the beam is closest to. In each layer, the beams count for the one cell whose
  /// window, its section at the layer's middle, they pass.
  void pass(const BeamBundle& bundle, double from_m, double to_m);
  /// Raises a cell's state: free replaces unknown, occupied replaces both. An occupied cell stays so until forget(),
  /// settle_free(), or free-space evidence after doubt(). Occupied by kOwn ends a doubt.
  /// @returns the state before.
  Known set(const Cell& cell, Space space, Teller teller);
  /// Makes a cell of this level unknown, and discards its evidence. Coarser levels stay as they are, and may still call
  /// it free.
  void forget(const Cell& cell);
  /// Doubts an occupied cell: it stays occupied, and its evidence restarts at zero. New evidence that proves the cell
  /// free makes it free, like an unknown cell.
  void doubt(const Cell& cell);
  bool doubted(const Cell& cell) const;
  std::size_t doubts() const { return doubts_; }
  /// For a cube that `teller` knows to be free: makes its doubted cells free, all of them if the teller is kOwn, else
  /// those that this teller had reported occupied.   @param edge  of the cube, in cells; it lies within one block.
  void settle_free(const Cell& lowest, int edge, Teller teller);

  /// State at this level alone.
  Known known(const Cell& cell) const;
  class Structure;
  /// A block with occupied cells.
  struct OccupiedBlock {
    Cell block = Cell::Zero();
    Cell lowest = Cell::Zero(), highest = Cell::Zero();  ///< of the smallest box around all its occupied cells
  };
  /// All of them, in no particular order. Valid until the map changes.
  const std::vector<OccupiedBlock>& occupied_blocks() const { return occupied_blocks_; }
  /// For many questions about cells of one block. Valid until the map changes.
  Structure structure_in(const Cell& block) const;
  /// The same for all cells of a block, x first.
  void read(const Cell& block, std::array<Known, kCells>& known) const;
  /// The cells of a block that have this state at this level.
  CellRows rows(const Cell& block, Space space) const;

  /// Frees the memory of blocks whose cells are all free by the same teller, and of blocks whose cells are all unknown
  /// and which are farther than `forget_m` from p. Their evidence is lost.
  void tidy(const Vector3d& p_W, double forget_m);
  /// The same for free blocks only.
  void tidy() { tidy(Vector3d::Zero(), std::numeric_limits<double>::infinity()); }
  /// Cells whose state was set anew since the last call; a cell may occur twice.
  std::vector<Cell> take_changes() { return std::exchange(changes_, {}); }
  /// Cells that became occupied, or ceased to be occupied, since the last call.
  std::vector<Cell> take_structure_changes() { return std::exchange(structure_changes_, {}); }

  std::size_t free_cells() const { return free_; }
  std::size_t occupied_cells() const { return occupied_; }
  std::size_t blocks() const { return blocks_.size() - spare_.size(); }
  std::size_t bytes() const {
    return blocks_.capacity() * sizeof(Block) + evidences_ * sizeof(Evidence) + slots_.bytes() +
           occupied_blocks_.capacity() * sizeof(OccupiedBlock);
  }
  std::uint64_t windows() const { return windows_; }

  static Cell block_of(const Cell& cell) { return shifted(cell, kBlockBits); }
  /// Index of a cell within its block, x first.
  static std::size_t place_of(const Cell& cell) {
    const auto along = [&](int axis) { return static_cast<std::size_t>(cell[axis] & (kBlock - 1)); };
    return along(0) | along(1) << kBlockBits | along(2) << 2 * kBlockBits;
  }
  /// The inverse: the cell's indices within its block.
  static Cell in_block(std::size_t place) {
    const auto at = static_cast<int>(place);
    return {at & (kBlock - 1), at >> kBlockBits & (kBlock - 1), at >> 2 * kBlockBits};
  }

 private:
  using Evidence = std::array<BeamEvidence, kCells>;
  struct Block {
    Cell at = Cell::Zero();  ///< index of the block, see block_of()
    int free = 0, occupied = 0;
    std::uint32_t occupied_number = 0;        ///< index in occupied_blocks_, if any cell is occupied
    std::unique_ptr<Evidence> evidence = {};  ///< nullptr until a beam passes or a cell is doubted
    std::array<Space, kCells> space = {};
    std::array<Teller, kCells> teller = {};
    /// Contains all doubted cells, so that questions about other cells need not read the evidence.
    std::bitset<kCells> maybe_doubted = {};
  };
  /// The place of a stored block, or the note that all its cells are free.
  struct Slot {
    std::uint32_t number = kNone;  ///< kNone, kAllFree, or kFirst + index in blocks_
    Teller teller = kOwn;          ///< if kAllFree: of all cells
  };
  struct Walk;
  static constexpr std::uint32_t kNone = 0, kAllFree = 1, kFirst = 2;  ///< format of Slot::number

  static Cell cell_at(const Block& block, std::size_t place) { return block.at * kBlock + in_block(place); }
  /// The block with this index; created if there is none. nullptr if all its cells are free.
  Block* block(const Cell& at);
  /// The same, but never nullptr: a block that was stored as all free gets its cells again.
  Block& opened_block(const Cell& at);
  Block& new_block(const Cell& at, Slot& slot);
  /// State at this level, or, if unknown here, at the finest coarser level that knows it.
  Known known_at_all(const Cell& cell) const;
  /// Evidence of this level and of all coarser ones.
  BeamEvidence all_evidence(const Cell& cell) const;
  void change(Block& block, std::size_t place, Space space, Teller teller);
  static bool doubted(const Block& block, std::size_t place) {
    return block.maybe_doubted[place] && block.space[place] == Space::occupied && (*block.evidence)[place].may_remind();
  }
  void note_occupied(Block& block, const Cell& cell);
  void note_not_occupied(const Block& block);
  void settle(Block& block, std::size_t place);
  /// The block's evidence; created if there is none.
  Evidence& evidence_of(Block& block);
  void ask(Block& block, std::size_t place);
  /// Makes the cell free if its evidence proves it; else asks the same for the finer cells in it.
  /// @param beyond  evidence of all coarser levels.
  void ask(Block& block, std::size_t place, const BeamEvidence& beyond);
  void ask_within(const Cell& coarser_cell, const BeamEvidence& beyond);

  double cell_m_;
  FreeJudge judge_;
  const MapLevel* coarser_;
  MapLevel* finer_ = nullptr;
  BlockTable<Slot> slots_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> spare_;  ///< indices in blocks_ that are free for reuse
  std::vector<Cell> changes_, structure_changes_;
  std::size_t free_ = 0, occupied_ = 0, doubts_ = 0, evidences_ = 0;
  std::uint64_t windows_ = 0;
  std::vector<OccupiedBlock> occupied_blocks_;
};

/// Tells which cells of a block are structure: occupied, and not in doubt.
class MapLevel::Structure {
 public:
  Structure() = default;
  /// Whether a cell is occupied, even if it is in doubt.   @param cell  in the block
  bool occupied(const Cell& cell) const {
    return block_ != nullptr && block_->space[place_of(cell)] == Space::occupied;
  }
  /// @param cell  in the block
  bool at(const Cell& cell) const {
    if (block_ == nullptr) return false;
    const std::size_t place = place_of(cell);
    return block_->space[place] == Space::occupied && !doubted(*block_, place);
  }

 private:
  friend class MapLevel;
  explicit Structure(const Block* block) : block_(block) {}

  const Block* block_ = nullptr;  ///< nullptr: none of its cells is occupied
};

}  // namespace skein::agent
