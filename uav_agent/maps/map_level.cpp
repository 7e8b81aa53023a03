#include "uav_agent/maps/map_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::agent {
namespace {

/// Rounded down by hand: floor() is a call on the processors that we build for.
int down(double value) {
  const int whole = static_cast<int>(value);
  return whole - static_cast<int>(whole > value);
}

/// How many layers of cells a beam passes in a block, from a place in it on, for who moves `slope` cells a layer.
int layers_within(float place, float slope, int low, int high) {
  constexpr float kNever = 1000.0F;
  if (slope == 0.0F) return static_cast<int>(kNever);
  const float left = slope > 0.0F ? static_cast<float>(high) - place : static_cast<float>(low) - place;
  return static_cast<int>(std::min(left / slope, kNever));
}

}  // namespace

MapLevel::MapLevel(double cell_m, const FreeCriterion& criterion, const MapLevel* coarser)
    : cell_m_(cell_m), criterion_(criterion), coarser_(coarser) {
  // From all sides alike they leave the fewest members unseen: exp(-2 K / 3), and count for sqrt(3) at most.
  const double least_k = -1.5 * std::log(criterion.unseen_p);
  first_ask_per_m2_ = least_k / (criterion.member_width_m * criterion.member_in_halo_m) / std::sqrt(3.0);
}

std::size_t MapLevel::place_of(const Cell& cell) {
  const auto along = [&](int axis) { return static_cast<std::size_t>(cell[axis] & (kBlock - 1)); };
  return along(0) | along(1) << kBlockBits | along(2) << 2 * kBlockBits;
}

MapLevel::Cell MapLevel::cell_of(const Vector3d& p_W) const {
  return {down(p_W.x() / cell_m_), down(p_W.y() / cell_m_), down(p_W.z() / cell_m_)};
}

std::pair<MapLevel::Known, BeamEvidence> MapLevel::inherited(const Cell& cell) const {
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  if (slot != nullptr && slot->number == kAllFree) return {{Space::free, slot->teller}, {}};
  if (slot != nullptr && slot->number != kNone) {
    const Block& block = blocks_[slot->number - kFirst];
    const std::size_t place = place_of(cell);
    return {{block.space[place], block.teller[place]}, block.evidence[place]};
  }
  if (coarser_ == nullptr) return {};
  return coarser_->inherited({cell.x() >> 1, cell.y() >> 1, cell.z() >> 1});
}

MapLevel::Block& MapLevel::new_block(const Cell& at, Slot& slot) {
  if (spare_.empty()) {
    slot.number = kFirst + static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back();
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
  for (int i = 0; i < kCells; ++i) {
    const Cell in_block(i & (kBlock - 1), i >> kBlockBits & (kBlock - 1), i >> 2 * kBlockBits);
    if (((in_block.x() | in_block.y() | in_block.z()) & 1) != 0) continue;
    const Cell cell = at * kBlock + in_block;
    auto [known, evidence] = coarser_->inherited({cell.x() >> 1, cell.y() >> 1, cell.z() >> 1});
    if (known.space == Space::free) evidence.never_remind();
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t place = place_of(cell + Cell(corner & 1, corner >> 1 & 1, corner >> 2));
      block.evidence[place] = evidence;
      if (known.space != Space::free) continue;
      block.space[place] = Space::free;
      block.teller[place] = known.teller;
      ++block.free;
      ++free_;
    }
  }
  return &block;
}

MapLevel::Block& MapLevel::opened_block(const Cell& at) {
  Slot& slot = slots_[grid_key(at)];
  if (slot.number != kAllFree) return *block(at);
  const Teller teller = slot.teller;
  Block& opened = new_block(at, slot);
  opened.space.fill(Space::free);
  opened.teller.fill(teller);
  for (BeamEvidence& evidence : opened.evidence) evidence.never_remind();
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
  count(block.space[place], -1);
  count(space, 1);
  block.space[place] = space;
  block.teller[place] = teller;
  block.evidence[place].never_remind();
  const auto at = static_cast<int>(place);
  changes_.push_back(block.at * kBlock +
                     Cell(at & (kBlock - 1), at >> kBlockBits & (kBlock - 1), at >> 2 * kBlockBits));
}

void MapLevel::set(const Cell& cell, Space space, Teller teller) {
  const Known before = known(cell);
  if (before.space >= space) return;
  change(opened_block(block_of(cell)), place_of(cell), space, teller);
}

void MapLevel::vacate(const Cell& cell) {
  if (known(cell).space != Space::occupied) return;
  Block& block = opened_block(block_of(cell));
  change(block, place_of(cell), Space::unknown, kOwn);
  block.evidence[place_of(cell)] = {};
}

void MapLevel::gather(Block& block, std::size_t place, const BeamEvidence& beams) {
  BeamEvidence& evidence = block.evidence[place];
  evidence.add(beams);
  if (!evidence.due()) return;
  if (evidence.per_m2() >= first_ask_per_m2_ && evidence.unseen_probability(criterion_) <= criterion_.unseen_p) {
    return change(block, place, Space::free, kOwn);
  }
  if (evidence.full()) return evidence.never_remind();
  evidence.remind_at(std::max(first_ask_per_m2_, 1.15 * evidence.per_m2()));
}

/// From layer to layer, from window to window.
void MapLevel::pass(const BeamBundle& bundle, double from_m, double to_m) {
  int axis = 0;
  bundle.direction_W.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto per_m2 = static_cast<float>(bundle.beams / (cell_m_ * cell_m_));
  const BeamEvidence evidence(bundle.direction_W, axis, per_m2);
  const float along = bundle.direction_W[axis];
  const double layer_m = cell_m_ / std::abs(along);
  const float slope_u = bundle.direction_W[u] / std::abs(along), slope_v = bundle.direction_W[v] / std::abs(along);
  const int sense = along > 0.0F ? 1 : -1;
  const Vector3d from = bundle.from_W / cell_m_;
  Cell cell = Cell::Zero();
  // The first layer whose middle lies ahead, then the first beyond from_m, and how many there are up to the end.
  cell[axis] = sense > 0 ? down(from[axis] + 0.5) : -down(0.5 - from[axis]) - 1;
  double first_layers = (cell[axis] + 0.5 - from[axis]) * sense;
  const int before = std::max(0, -down(first_layers - from_m / layer_m));
  cell[axis] += sense * before;
  first_layers += before;
  int left = -down(first_layers - to_m / layer_m);
  // From the corner of the first block on: there a float is exact to a hundredth of a millimetre.
  const Cell corner = {down(from.x()) & ~(kBlock - 1), down(from.y()) & ~(kBlock - 1), down(from.z()) & ~(kBlock - 1)};
  const auto start = [&](int side, float slope) {
    return static_cast<float>(from[side] - corner[side] + first_layers * slope);
  };
  float at_u = start(u, slope_u), at_v = start(v, slope_v);
  Cell block_at = Cell::Constant(std::numeric_limits<int>::max());
  Block* here = nullptr;
  while (left > 0) {
    cell[u] = corner[u] + down(at_u);
    cell[v] = corner[v] + down(at_v);
    if (const Cell at = block_of(cell); at != block_at) {
      block_at = at;
      here = block(at);
    }
    int layers = 1;
    if (here == nullptr) {  // all of this block is free: on to the next
      const auto rest = [&](int side, float place, float slope) {
        const int low = block_at[side] * kBlock - corner[side];
        return layers_within(place, slope, low, low + kBlock);
      };
      const int low = block_at[axis] * kBlock;
      layers = sense > 0 ? low + kBlock - cell[axis] : cell[axis] - low + 1;
      layers = std::max(1, std::min({layers, rest(u, at_u, slope_u), rest(v, at_v, slope_v)}));
    } else {
      gather(*here, place_of(cell), evidence);
      ++windows_;
    }
    left -= layers;
    cell[axis] += sense * layers;
    at_u += slope_u * static_cast<float>(layers);
    at_v += slope_v * static_cast<float>(layers);
  }
}

MapLevel::Known MapLevel::known(const Cell& cell) const {
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  if (slot == nullptr || slot->number == kNone) return {};
  if (slot->number == kAllFree) return {Space::free, slot->teller};
  const Block& block = blocks_[slot->number - kFirst];
  const std::size_t place = place_of(cell);
  return {block.space[place], block.teller[place]};
}

void MapLevel::read(const Cell& block, std::array<Known, kCells>& known) const {
  const Slot* const slot = slots_.find(grid_key(block));
  if (slot == nullptr || slot->number == kNone) return known.fill({});
  if (slot->number == kAllFree) return known.fill({Space::free, slot->teller});
  const Block& read = blocks_[slot->number - kFirst];
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = {read.space[i], read.teller[i]};
}

bool MapLevel::all_free(const Cell& block) const {
  const Slot* const slot = slots_.find(grid_key(block));
  if (slot == nullptr || slot->number == kNone) return false;
  return slot->number == kAllFree || blocks_[slot->number - kFirst].free == kCells;
}

void MapLevel::tidy(const Vector3d& p_W, double forget_m) {
  const double block_m = kBlock * cell_m_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& block = blocks_[i];
    Slot& slot = slots_[grid_key(block.at)];
    if (slot.number != kFirst + i) continue;
    const Vector3d centre_W = (block.at.cast<double>() + Vector3d::Constant(0.5)) * block_m;
    // A block that several have told of stays: who told what would be lost.
    const bool all_free = block.free == kCells && std::ranges::all_of(block.teller, [&](Teller teller) {
                            return teller == block.teller.front();
                          });
    const bool forgotten = block.free + block.occupied == 0 && (centre_W - p_W).norm() > forget_m;
    if (!all_free && !forgotten) continue;
    slot = {all_free ? kAllFree : kNone, all_free ? block.teller.front() : kOwn};
    spare_.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace skein::agent
