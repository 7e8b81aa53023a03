#include "uav_agent/maps/map_level.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr double kAskAgain = 0.15;  ///< growth of the beam count after which a cell is judged again; chosen

/// Rounds down without floor(), which is a function call on the target processors.
int down(double value) {
  const int whole = static_cast<int>(value);
  return whole - static_cast<int>(whole > value);
}

}  // namespace

MapLevel::MapLevel(double cell_m, const FreeCriterion& criterion, MapLevel* coarser)
    : cell_m_(cell_m), judge_(criterion), coarser_(coarser) {
  if (coarser != nullptr) coarser->finer_ = this;
}

MapLevel::Cell MapLevel::cell_of(const Vector3d& p_W) const {
  return {down(p_W.x() / cell_m_), down(p_W.y() / cell_m_), down(p_W.z() / cell_m_)};
}

MapLevel::Known MapLevel::known_at_all(const Cell& cell) const {
  const Known here = known(cell);
  return here.space != Space::unknown || coarser_ == nullptr ? here : coarser_->known_at_all(shifted(cell, 1));
}

BeamEvidence MapLevel::all_evidence(const Cell& cell) const {
  BeamEvidence evidence;
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  if (slot != nullptr && slot->number >= kFirst) {
    const Block& block = blocks_[slot->number - kFirst];
    if (block.evidence) evidence = (*block.evidence)[place_of(cell)];
  }
  if (coarser_ != nullptr) evidence.join(coarser_->all_evidence(shifted(cell, 1)));
  return evidence;
}

MapLevel::Block& MapLevel::new_block(const Cell& at, Slot& slot) {
  if (spare_.empty()) {
    slot.number = kFirst + static_cast<std::uint32_t>(blocks_.size());
    append(blocks_);
  } else {
    slot.number = kFirst + spare_.back();
    spare_.pop_back();
    blocks_[slot.number - kFirst] = {};
  }
  Block& block = blocks_[slot.number - kFirst];
  block.at = at;
  return block;
}

MapLevel::Block* MapLevel::block(const Cell& at) {
  Slot& slot = slots_[grid_key(at)];
  if (slot.number == kAllFree) return nullptr;
  if (slot.number != kNone) return &blocks_[slot.number - kFirst];
  Block& block = new_block(at, slot);
  if (coarser_ == nullptr) return &block;
  for (std::size_t i = 0; i < kCells; ++i) {
    const Cell in = in_block(i);
    if (((in.x() | in.y() | in.z()) & 1) != 0) continue;
    const Cell cell = at * kBlock + in;
    const Known known = coarser_->known_at_all(shifted(cell, 1));
    if (known.space != Space::free) continue;
    for (int corner = 0; corner < kCubeCorners; ++corner) {
      const std::size_t place = place_of(cell + corner_step(corner));
      block.space[place] = Space::free;
      block.teller[place] = known.teller;
      ++block.free;
      ++free_;
    }
  }
  return &block;
}

MapLevel::Evidence& MapLevel::evidence_of(Block& block) {
  if (!block.evidence) {
    block.evidence = std::make_unique<Evidence>();
    ++evidences_;
    for (std::size_t place = 0; place < kCells; ++place) {
      if (block.space[place] != Space::unknown) (*block.evidence)[place].never_remind();
    }
  }
  return *block.evidence;
}

MapLevel::Block& MapLevel::opened_block(const Cell& at) {
  Slot& slot = slots_[grid_key(at)];
  if (slot.number != kAllFree) return *block(at);
  const Teller teller = slot.teller;
  Block& opened = new_block(at, slot);
  opened.space.fill(Space::free);
  opened.teller.fill(teller);
  opened.free = kCells;
  return opened;
}

void MapLevel::change(Block& block, std::size_t place, Space space, Teller teller) {
  const auto count = [&](Space of, int by) {
    if (of == Space::free) {
      block.free += by;
      free_ += static_cast<std::size_t>(by);
    } else if (of == Space::occupied) {
      block.occupied += by;
      occupied_ += static_cast<std::size_t>(by);
    }
  };
  settle(block, place);
  const bool was_occupied = block.space[place] == Space::occupied, is_occupied = space == Space::occupied;
  count(block.space[place], -1);
  count(space, 1);
  block.space[place] = space;
  if (was_occupied != is_occupied) {
    structure_changes_.push_back(cell_at(block, place));
    is_occupied ? note_occupied(block, cell_at(block, place)) : note_not_occupied(block);
  }
  block.teller[place] = teller;
  changes_.push_back(cell_at(block, place));
}

/// Call it when a cell of the block became occupied.
void MapLevel::note_occupied(Block& block, const Cell& cell) {
  if (block.occupied == 1) {
    block.occupied_number = static_cast<std::uint32_t>(occupied_blocks_.size());
    occupied_blocks_.push_back({block.at, cell, cell});
    return;
  }
  OccupiedBlock& noted = occupied_blocks_[block.occupied_number];
  noted.lowest = noted.lowest.cwiseMin(cell);
  noted.highest = noted.highest.cwiseMax(cell);
}

/// Call it when a cell of the block is no longer occupied, which is rare.
void MapLevel::note_not_occupied(const Block& block) {
  OccupiedBlock& noted = occupied_blocks_[block.occupied_number];
  if (block.occupied == 0) {
    noted = occupied_blocks_.back();
    opened_block(noted.block).occupied_number = block.occupied_number;
    return occupied_blocks_.pop_back();
  }
  noted.lowest = block.at * kBlock + Cell::Constant(kBlock - 1);
  noted.highest = block.at * kBlock;
  for (std::size_t place = 0; place < kCells; ++place) {
    if (block.space[place] != Space::occupied) continue;
    noted.lowest = noted.lowest.cwiseMin(cell_at(block, place));
    noted.highest = noted.highest.cwiseMax(cell_at(block, place));
  }
}

/// Ends a doubt, and stops judging the cell's evidence.
void MapLevel::settle(Block& block, std::size_t place) {
  if (doubted(block, place)) --doubts_;
  block.maybe_doubted[place] = false;
  if (block.evidence) (*block.evidence)[place].never_remind();
}

MapLevel::Known MapLevel::set(const Cell& cell, Space space, Teller teller) {
  const Known before = known(cell);
  const bool met_again = space == Space::occupied && teller == kOwn;
  if (before.space < space) {
    change(opened_block(block_of(cell)), place_of(cell), space, teller);
  } else if (met_again && doubts_ > 0) {
    settle(opened_block(block_of(cell)), place_of(cell));
  }
  return before;
}

void MapLevel::forget(const Cell& cell) {
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  if (slot == nullptr || slot->number == kNone) return;
  Block& block = opened_block(block_of(cell));
  change(block, place_of(cell), Space::unknown, kOwn);
  if (block.evidence) (*block.evidence)[place_of(cell)] = {};
}

void MapLevel::doubt(const Cell& cell) {
  if (known(cell).space != Space::occupied) return;
  Block& block = opened_block(block_of(cell));
  settle(block, place_of(cell));
  evidence_of(block)[place_of(cell)] = {};
  block.maybe_doubted[place_of(cell)] = true;
  ++doubts_;
}

bool MapLevel::doubted(const Cell& cell) const {
  if (doubts_ == 0) return false;
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  return slot != nullptr && slot->number >= kFirst && doubted(blocks_[slot->number - kFirst], place_of(cell));
}

void MapLevel::settle_free(const Cell& lowest, int edge, Teller teller) {
  if (doubts_ == 0) return;
  const Slot* const slot = slots_.find(grid_key(block_of(lowest)));
  if (slot == nullptr || slot->number < kFirst) return;
  Block& block = blocks_[slot->number - kFirst];
  if (block.occupied == 0) return;
  for (int i = 0; i < edge * edge * edge; ++i) {
    const std::size_t place = place_of(lowest + Cell(i % edge, i / edge % edge, i / edge / edge));
    const bool told = teller == kOwn || block.teller[place] == teller;
    if (told && doubted(block, place)) change(block, place, Space::free, teller);
  }
}

void MapLevel::ask(Block& block, std::size_t place) {
  ask(block, place, coarser_ == nullptr ? BeamEvidence() : coarser_->all_evidence(shifted(cell_at(block, place), 1)));
}

void MapLevel::ask(Block& block, std::size_t place, const BeamEvidence& beyond) {
  BeamEvidence& evidence = (*block.evidence)[place];
  const double here = evidence.per_m2();
  BeamEvidence all = evidence;
  all.join(beyond);
  if (judge_.proved(all)) return change(block, place, Space::free, kOwn);
  if (evidence.full()) return settle(block, place);
  const double lacking = judge_.fewest_per_m2() - all.per_m2();
  evidence.remind_at(here + std::max(finer_ == nullptr ? lacking : 0.0, kAskAgain * all.per_m2()));
  if (finer_ != nullptr) finer_->ask_within(cell_at(block, place), all);
}

void MapLevel::ask_within(const Cell& coarser_cell, const BeamEvidence& beyond) {
  const Slot* const slot = slots_.find(grid_key(block_of(2 * coarser_cell)));
  if (slot == nullptr || slot->number < kFirst) return;
  Block& block = blocks_[slot->number - kFirst];
  if (!block.evidence) return;
  for (int corner = 0; corner < kCubeCorners; ++corner) {
    const std::size_t place = place_of(2 * coarser_cell + corner_step(corner));
    const bool open = block.space[place] == Space::unknown || doubted(block, place);
    if (open && (*block.evidence)[place].per_m2() > 0.0) ask(block, place, beyond);
  }
}

/// Follows a beam through the cells, layer by layer. Layers are normal to the axis that the beam is closest to; in
/// each, the beam is in the cell where it passes the layer's middle. Coordinates are relative to a corner below the
/// beam's whole path, so they are never negative.
struct MapLevel::Walk {
  int axis = 0, u = 1, v = 2;
  int sense = 1;                         ///< 1: up the axis, -1: down
  int layer = 0, left = 0;               ///< the current layer, and the number of layers left, this one included
  float at_u = 0.0F, at_v = 0.0F;        ///< where the beam passes the middle of the layer [cells]
  float slope_u = 0.0F, slope_v = 0.0F;  ///< cells per layer
  Cell corner = Cell::Zero();            ///< that corner, a corner of a block

  Walk(const BeamBundle& bundle, double cell_m, double from_m, double to_m) {
    bundle.direction_W.cwiseAbs().maxCoeff(&axis);
    u = (axis + 1) % 3;
    v = (axis + 2) % 3;
    const float along = bundle.direction_W[axis], steep = std::abs(along);
    const double layer_m = cell_m / steep;
    slope_u = bundle.direction_W[u] / steep;
    slope_v = bundle.direction_W[v] / steep;
    sense = along > 0.0F ? 1 : -1;
    const Vector3d from = bundle.from_W / cell_m;
    // First the layer whose middle is next ahead, then the first one beyond from_m, then the number of layers to to_m.
    layer = sense > 0 ? down(from[axis] + 0.5) : -down(0.5 - from[axis]) - 1;
    double first_layers = (layer + 0.5 - from[axis]) * sense;
    const int before = std::max(0, -down(first_layers - from_m / layer_m));
    layer += sense * before;
    first_layers += before;
    left = -down(first_layers - to_m / layer_m);
    // Relative to this corner, a float is exact to a hundredth of a millimetre.
    for (int i = 0; i < 3; ++i) corner[i] = (down(from[i]) & ~(kBlock - 1)) - kMostCells;
    layer -= corner[axis];
    at_u = static_cast<float>(from[u] - corner[u] + first_layers * slope_u);
    at_v = static_cast<float>(from[v] - corner[v] + first_layers * slope_v);
  }

  Cell block() const {
    Cell block = Cell::Zero();
    block[axis] = (layer + corner[axis]) >> kBlockBits;
    block[u] = (static_cast<int>(at_u) + corner[u]) >> kBlockBits;
    block[v] = (static_cast<int>(at_v) + corner[v]) >> kBlockBits;
    return block;
  }
  void advance(int layers) {
    left -= layers;
    layer += sense * layers;
    at_u += slope_u * static_cast<float>(layers);
    at_v += slope_v * static_cast<float>(layers);
  }
  /// Number of layers up to the end of the current block, or one less because of rounding; at least one.
  int layers_in_block() const {
    const auto within = [](float at, float slope) {
      const int low = static_cast<int>(at) & ~(kBlock - 1);
      const float rest = slope > 0.0F ? static_cast<float>(low + kBlock) - at : at - static_cast<float>(low);
      return slope == 0.0F ? kBlock : static_cast<int>(std::min(rest / std::abs(slope), static_cast<float>(kBlock)));
    };
    const int in_block = layer & (kBlock - 1);
    const int along = sense > 0 ? kBlock - in_block : in_block + 1;
    return std::max(1, std::min({along, within(at_u, slope_u), within(at_v, slope_v)}));
  }
};

void MapLevel::pass(const BeamBundle& bundle, double from_m, double to_m) {
  Walk walk(bundle, cell_m_, from_m, to_m);
  if (walk.left <= 0) return;
  const BeamEvidence evidence(bundle.direction_W, walk.axis, static_cast<float>(bundle.beams / (cell_m_ * cell_m_)));
  const int bits_u = kBlockBits * walk.u, bits_v = kBlockBits * walk.v, bits_layer = kBlockBits * walk.axis;
  while (walk.left > 0) {
    Block* const here = block(walk.block());
    if (here == nullptr || here->free == kCells) {  // the whole block is free: skips it
      walk.advance(walk.layers_in_block());
      continue;
    }
    int u = static_cast<int>(walk.at_u), v = static_cast<int>(walk.at_v);
    const int block_u = u >> kBlockBits, block_v = v >> kBlockBits, block_layer = walk.layer >> kBlockBits;
    constexpr int kIn = kBlock - 1;
    Evidence& gathered = evidence_of(*here);
    const int left_before = walk.left;
    do {
      const auto place =
          static_cast<std::size_t>((u & kIn) << bits_u | (v & kIn) << bits_v | (walk.layer & kIn) << bits_layer);
      // Only finer cells use the evidence of free cells. Without finer cells it is not read, which saves cache misses.
      if (finer_ != nullptr || here->space[place] != Space::free) {
        gathered[place].add(evidence);
        if (gathered[place].due()) ask(*here, place);
      }
      walk.advance(1);
      u = static_cast<int>(walk.at_u);
      v = static_cast<int>(walk.at_v);
    } while (walk.left > 0 && u >> kBlockBits == block_u && v >> kBlockBits == block_v &&
             walk.layer >> kBlockBits == block_layer);
    windows_ += static_cast<std::uint64_t>(left_before - walk.left);
  }
}

void MapLevel::tidy(const Vector3d& p_W, double forget_m) {
  const double block_m = kBlock * cell_m_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    Slot& slot = slots_[grid_key(block.at)];
    if (slot.number != kFirst + i) continue;
    const Vector3d centre_W = (block.at.cast<double>() + Vector3d::Constant(0.5)) * block_m;
    // A free block with several tellers is kept: otherwise it would be lost which cell has which teller.
    const bool all_free = block.free == kCells && std::ranges::all_of(block.teller, [&](Teller teller) {
                            return teller == block.teller.front();
                          });
    const bool forgotten = block.free + block.occupied == 0 && (centre_W - p_W).norm() > forget_m;
    if (!all_free && !forgotten) continue;
    if (block.evidence) --evidences_;
    block.evidence.reset();
    slot = {all_free ? kAllFree : kNone, all_free ? block.teller.front() : kOwn};
    spare_.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace skein::agent
