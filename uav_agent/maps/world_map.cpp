#include "uav_agent/maps/world_map.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr int kFirstAsk = 12;            // beams: fewer are never enough
constexpr std::uint64_t kTidyEach = 50;  // scans

/// Rounded down by hand: floor() is a call on the processors that we build for.
int down(double value) {
  const int whole = static_cast<int>(value);
  return whole - static_cast<int>(whole > value);
}

/// How many layers of cubes a beam passes in a block, from a place in it on, for who moves `slope` cubes a layer.
int layers_within(float place, float slope, int low, int high) {
  constexpr float kNever = 1000.0F;
  if (slope == 0.0F) return static_cast<int>(kNever);
  const float left = slope > 0.0F ? static_cast<float>(high) - place : static_cast<float>(low) - place;
  return static_cast<int>(std::min(left / slope, kNever));
}

}  // namespace

std::uint64_t WorldMap::key_of(const Cube& block) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  const auto along = [&](int axis) { return static_cast<std::uint64_t>(block[axis]) & kMask; };
  return along(0) | along(1) << 21 | along(2) << 42;
}

std::size_t WorldMap::place_of(const Cube& cube) {
  const auto along = [&](int axis) { return static_cast<std::size_t>(cube[axis] & (kBlock - 1)); };
  return along(0) | along(1) << kBlockBits | along(2) << 2 * kBlockBits;
}

WorldMap::Cube WorldMap::cube_of(const Vector3d& p_W) const {
  return {down(p_W.x() / config_.cell_m), down(p_W.y() / config_.cell_m), down(p_W.z() / config_.cell_m)};
}

WorldMap::Block* WorldMap::block(const Cube& at) {
  std::uint32_t& number = numbers_[key_of(at)];
  if (number == kAllFree) return nullptr;
  if (number == kNone) {
    if (spare_.empty()) {
      number = kFirst + static_cast<std::uint32_t>(blocks_.size());
      blocks_.emplace_back();
    } else {
      number = kFirst + spare_.back();
      spare_.pop_back();
      blocks_[number - kFirst] = {};
    }
    blocks_[number - kFirst].at = at;
    blocks_[number - kFirst].ask_at.fill(kFirstAsk);
  }
  return &blocks_[number - kFirst];
}

void WorldMap::set(Block& block, std::size_t place, Space space) {
  const Space before = std::exchange(block.space[place], space);
  if (before == Space::unknown) ++block.known;
  if (before == Space::free) {
    --block.free;
    --counts_.free;
  }
  if (space == Space::free) {
    ++block.free;
    ++counts_.free;
  } else {
    ++counts_.occupied;
  }
}

void WorldMap::gather(Block& block, std::size_t place, const BeamEvidence& beam) {
  BeamEvidence& evidence = block.evidence[place];
  if (evidence.beams() >= BeamEvidence::kMostBeams) return;
  evidence.add(beam);
  std::uint8_t& ask_at = block.ask_at[place];
  if (evidence.beams() < ask_at) return;
  const double window_m2 = config_.cell_m * config_.cell_m;
  if (evidence.unseen_probability(window_m2, config_.criterion) <= config_.criterion.unseen_p) {
    set(block, place, Space::free);
  }
  ask_at = static_cast<std::uint8_t>(std::min(BeamEvidence::kMostBeams, ask_at + ask_at / 6 + 1));
}

/// From layer to layer, from window to window.
void WorldMap::pass(const Beam& beam) {
  int axis = 0;
  beam.direction_W.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const BeamEvidence evidence(beam.direction_W, axis);
  const float along = beam.direction_W[axis];
  const double layer_m = config_.cell_m / std::abs(along);
  const float slope_u = beam.direction_W[u] / std::abs(along), slope_v = beam.direction_W[v] / std::abs(along);
  const int sense = along > 0.0F ? 1 : -1;
  const Vector3d from = beam.from_W / config_.cell_m;
  Cube cube = Cube::Zero();
  // The first layer whose middle lies ahead, and how many there are up to the end.
  cube[axis] = sense > 0 ? down(from[axis] + 0.5) : -down(0.5 - from[axis]) - 1;
  const double first_layers = (cube[axis] + 0.5 - from[axis]) * sense;
  const double end_m = std::min<double>(beam.free_m, config_.evidence_range_m);
  int left = static_cast<int>(std::ceil(end_m / layer_m - first_layers));
  // From the corner of the first block on: there a float is exact to a hundredth of a millimetre.
  const Cube corner = {down(from.x()) & ~(kBlock - 1), down(from.y()) & ~(kBlock - 1), down(from.z()) & ~(kBlock - 1)};
  const auto start = [&](int side, float slope) {
    return static_cast<float>(from[side] - corner[side] + first_layers * slope);
  };
  float at_u = start(u, slope_u), at_v = start(v, slope_v);
  Cube block_at = Cube::Constant(std::numeric_limits<int>::max());
  Block* here = nullptr;
  while (left > 0) {
    cube[u] = corner[u] + down(at_u);
    cube[v] = corner[v] + down(at_v);
    if (const Cube at = block_of(cube); at != block_at) {
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
      layers = sense > 0 ? low + kBlock - cube[axis] : cube[axis] - low + 1;
      layers = std::max(1, std::min({layers, rest(u, at_u, slope_u), rest(v, at_v, slope_v)}));
    } else if (const std::size_t place = place_of(cube); here->space[place] == Space::unknown) {
      gather(*here, place, evidence);
    }
    counts_.windows += here == nullptr ? 0 : 1;
    left -= layers;
    cube[axis] += sense * layers;
    at_u += slope_u * static_cast<float>(layers);
    at_v += slope_v * static_cast<float>(layers);
  }
}

void WorldMap::insert(std::span<const Beam> beams) {
  for (const Beam& beam : beams) {
    if (!beam.returned) continue;
    const Vector3d hit_W = beam.from_W + static_cast<double>(beam.free_m) * beam.direction_W.cast<double>();
    const Cube cube = cube_of(hit_W);
    std::uint32_t& number = numbers_[key_of(block_of(cube))];
    if (number == kAllFree) {  // no longer
      number = kNone;
      Block* const opened = block(block_of(cube));
      opened->space.fill(Space::free);
      opened->known = opened->free = kCubes;
    }
    Block& hit = *block(block_of(cube));
    if (hit.space[place_of(cube)] != Space::occupied) set(hit, place_of(cube), Space::occupied);
  }
  for (const Beam& beam : beams) pass(beam);
  if (++scans_ % kTidyEach == 0 && !beams.empty()) tidy(beams.front().from_W);
}

void WorldMap::tidy(const Vector3d& p_WS) {
  const double block_m = kBlock * config_.cell_m;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    const bool all_free = block.free == kCubes;
    const Vector3d centre_W = (block.at.cast<double>() + Vector3d::Constant(0.5)) * block_m;
    const bool forgotten = block.known == 0 && (centre_W - p_WS).norm() > config_.forget_m;
    std::uint32_t& number = numbers_[key_of(block.at)];
    if ((!all_free && !forgotten) || number != kFirst + i) continue;
    number = all_free ? kAllFree : kNone;
    spare_.push_back(static_cast<std::uint32_t>(i));
  }
}

template <class Visit>
bool WorldMap::all_near(const Vector3d& a_W, const Vector3d& b_W, double radius_m, const Visit& visit) const {
  const Vector3d reach = Vector3d::Constant(radius_m), ab = b_W - a_W;
  const Cube low = cube_of(a_W.cwiseMin(b_W) - reach), high = cube_of(a_W.cwiseMax(b_W) + reach);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Cube cube(x, y, z);
        const Vector3d centre = (cube.cast<double>() + Vector3d::Constant(0.5)) * config_.cell_m;
        const double length2 = ab.squaredNorm();
        const double part = length2 > 0.0 ? std::clamp((centre - a_W).dot(ab) / length2, 0.0, 1.0) : 0.0;
        const Vector3d off = ((a_W + part * ab - centre).cwiseAbs().array() - 0.5 * config_.cell_m).max(0.0).matrix();
        if (off.norm() <= radius_m && !visit(cube)) return false;
      }
    }
  }
  return true;
}

void WorldMap::set_free(const Vector3d& p_W, double radius_m) {
  all_near(p_W, p_W, radius_m, [&](const Cube& cube) {
    Block* const here = block(block_of(cube));
    if (here != nullptr && here->space[place_of(cube)] == Space::unknown) set(*here, place_of(cube), Space::free);
    return true;
  });
}

Space WorldMap::space_of(const Cube& cube) const {
  const std::uint32_t* const number = numbers_.find(key_of(block_of(cube)));
  if (number == nullptr || *number == kNone) return Space::unknown;
  return *number == kAllFree ? Space::free : blocks_[*number - kFirst].space[place_of(cube)];
}

Space WorldMap::at(const Vector3d& p_W) const { return space_of(cube_of(p_W)); }

bool WorldMap::tube_free(const Vector3d& a_W, const Vector3d& b_W, double radius_m) const {
  return all_near(a_W, b_W, radius_m, [&](const Cube& cube) { return space_of(cube) == Space::free; });
}

WorldMap::Counts WorldMap::counts() const {
  Counts counts = counts_;
  counts.blocks = blocks_.size() - spare_.size();
  counts.bytes = blocks_.capacity() * sizeof(Block);
  return counts;
}

}  // namespace skein::agent
