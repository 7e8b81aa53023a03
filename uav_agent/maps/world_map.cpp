#include "uav_agent/maps/world_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr std::uint64_t kTidyEach = 20;  ///< scans between two passes; chosen
/// Growth since the last tidying that makes hear() tidy again: a quarter of the blocks, and kTidyAfterBlocks more.
/// Chosen.
constexpr std::size_t kTidyGrowth = 4, kTidyAfterBlocks = 256;
/// From this level on, windows are so large that the beams of a slowly moving LiDAR are not spread evenly over them.
/// The accepted probability is halved there. Chosen.
constexpr std::size_t kUneven = 2;
constexpr std::uint8_t kRowFree = std::numeric_limits<std::uint8_t>::max();  ///< a row of a chunk with all cubes free

}  // namespace

WorldMap::WorldMap(const Config& config) : config_(config), distances_(config.cell_m, config.distance_reach_m) {
  const std::size_t count = config.to_m.size();
  constexpr std::size_t kMostLevels = 4;  // chosen: the largest cubes have 8 times the edge of the smallest
  if (count < 1 || count > kMostLevels || !std::ranges::is_sorted(config.to_m)) {
    throw std::invalid_argument("WorldMap: to_m has one to four distances, the nearest first");
  }
  levels_.resize(count);
  for (std::size_t i = count; i-- > 0;) {
    const double cell_m = config.cell_m * (1 << i);
    if (config.to_m[i] > (MapLevel::kMostCells - MapLevel::kBlock) * cell_m) {
      throw std::invalid_argument("WorldMap: beams pass too many cubes");
    }
    MapLevel* const coarser = i + 1 < count ? levels_[i + 1].get() : nullptr;
    FreeCriterion criterion = config.criterion;
    if (i >= kUneven) criterion.unseen_p *= 0.5;
    levels_[i] = std::make_unique<MapLevel>(cell_m, criterion, coarser);
  }
}

void WorldMap::meet(const Cube& cube, Teller teller) {
  const bool news = levels_.front()->set(cube, Space::occupied, teller).space != Space::occupied;
  if (on_met_ && (news || teller == kOwn)) on_met_(cube, news);
}

void WorldMap::insert(std::span<const BeamBundle> bundles, std::span<const Eigen::Vector3f> hits_W) {
  Cube last = Cube::Constant(std::numeric_limits<int>::max());
  for (const Eigen::Vector3f& hit_W : hits_W) {
    if (hit_W.z() < config_.ground_m) continue;
    const Cube cube = cube_of(hit_W.cast<double>());
    if (cube != last) meet(cube, kOwn);
    last = cube;
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    MapLevel& level = *levels_[i];
    for (const BeamBundle& bundle : bundles) {
      const double free_m = i == 0 ? bundle.free_m : bundle.around_free_m - level.cell_m();
      const double from_m = i == 0 ? 0.0 : handed_over_m(bundle, i - 1);
      const double end_m = std::min(free_m, handed_over_m(bundle, i));
      if (end_m > from_m) level.pass(bundle, from_m, end_m);
    }
  }
  note_changes();
  if (++scans_ % kTidyEach != 0 || bundles.empty()) return;
  // Frees blocks far out of a level's reach. If needed again, they are restored from what the coarser level knows.
  for (std::size_t i = 0; i < levels_.size(); ++i) levels_[i]->tidy(bundles.front().from_W, 2.0 * config_.to_m[i]);
}

/// The beam changes levels at the nearest plane between two layers of the larger cubes, so that it passes each layer at
/// one level only.
double WorldMap::handed_over_m(const BeamBundle& bundle, std::size_t level) const {
  const double to_m = config_.to_m[level];
  if (level + 1 == levels_.size()) return to_m;
  int axis = 0;
  bundle.direction_W.cwiseAbs().maxCoeff(&axis);
  const double from = bundle.from_W[axis], along = bundle.direction_W[axis], larger_m = levels_[level + 1]->cell_m();
  const double plane = larger_m * std::round((from + to_m * along) / larger_m);
  return std::max(0.0, (plane - from) / along);
}

/// Starts with the largest cubes: if one is proved free, that may settle doubts in smaller cubes.
void WorldMap::note_changes() {
  for (int i = levels() - 1; i >= 0; --i) {
    MapLevel& level = *levels_[static_cast<std::size_t>(i)];
    for (const Cube& cube : level.take_changes()) {
      if (i > 0 && levels_.front()->doubts() > 0) {
        const bool proved = level.known(cube) == MapLevel::Known{Space::free, kOwn};
        if (proved) settle_free(cube, i, kOwn);
      }
      const Cube chunk = shifted(cube, MapLevel::kBlockBits - i);
      const Cube region = shifted(chunk, kRegionBits);
      chunks_[grid_key(chunk)].changed_at = ++changes_;
      RegionNote& note = in_regions_[grid_key(region)];
      if (note.changed_at == 0) regions_.push_back(region);
      note.changed_at = note.chunks[place_in_region(chunk)] = changes_;
    }
  }
  for (const Cube& cube : levels_.front()->take_structure_changes()) {
    distances_.changed(cube);
    const Cube chunk = MapLevel::block_of(cube);
    chunks_[grid_key(chunk)].structure_changed_at = changes_;
    structured_[grid_key(shifted(chunk, kRegionBits))] |= std::uint64_t{1} << place_in_region(chunk);
    structure_low_ = structure_low_.cwiseMin(cube);
    structure_high_ = structure_high_.cwiseMax(cube + Cube::Ones());
  }
}

std::uint64_t WorldMap::changed_at(const Cube& chunk) const {
  const ChunkNote* const found = chunks_.find(grid_key(chunk));
  return found == nullptr ? 0 : found->changed_at;
}

std::uint64_t WorldMap::region_changed_at(const Cube& region) const {
  const RegionNote* const found = in_regions_.find(grid_key(region));
  return found == nullptr ? 0 : found->changed_at;
}

template <class Visit>
bool WorldMap::all_near(const Vector3d& a_W, const Vector3d& b_W, double radius_m, Visit&& visit) const {
  const Vector3d reach = Vector3d::Constant(radius_m), ab = b_W - a_W;
  const Cube low = cube_of(a_W.cwiseMin(b_W) - reach), high = cube_of(a_W.cwiseMax(b_W) + reach);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Cube cube(x, y, z);
        const Vector3d centre = middle_W(cube);
        const double length2 = ab.squaredNorm();
        const double part = length2 > 0.0 ? std::clamp((centre - a_W).dot(ab) / length2, 0.0, 1.0) : 0.0;
        if (distance_to_m(cube, a_W + part * ab) <= radius_m && !visit(cube)) return false;
      }
    }
  }
  return true;
}

void WorldMap::set_free(const Vector3d& p_W, double radius_m) {
  all_near(p_W, p_W, radius_m, [&](const Cube& cube) {
    const bool underground = cube.z() < 0;
    if (!underground && known(cube).space == Space::unknown) levels_.front()->set(cube, Space::free, kOwn);
    return true;
  });
  note_changes();
}

void WorldMap::vacate(const Vector3d& p_W, double radius_m) {
  all_near(p_W, p_W, radius_m, [&](const Cube& cube) {
    if (levels_.front()->known(cube).space != Space::occupied) return true;
    unprove_around(cube);
    levels_.front()->forget(cube);
    return true;
  });
  note_changes();
}

void WorldMap::doubt(const Cube& cube) {
  if (levels_.front()->known(cube).space != Space::occupied) return;
  unprove_around(cube);
  levels_.front()->doubt(cube);
  note_changes();
}

/// Makes the larger cubes that contain this cube unknown, the largest first. If one of them was free, the smaller cubes
/// in it stay free, except for the one that contains this cube.
void WorldMap::unprove_around(const Cube& cube) {
  MapLevel::Known about;
  for (int i = levels() - 1; i > 0; --i) {
    const Cube larger = shifted(cube, i), next = shifted(cube, i - 1);
    MapLevel& level = *levels_[static_cast<std::size_t>(i)];
    if (const MapLevel::Known known = level.known(larger); known.space == Space::free) about = known;
    level.forget(larger);
    if (about.space != Space::free) continue;
    for (int corner = 0; corner < kCubeCorners; ++corner) {
      const Cube smaller = 2 * larger + corner_step(corner);
      if (smaller != next) levels_[static_cast<std::size_t>(i - 1)]->set(smaller, Space::free, about.teller);
    }
  }
}

double WorldMap::structure_distance_m(const Vector3d& p_W) const {
  const auto occupied_in = [this](const Cube& block) { return levels_.front()->rows(block, Space::occupied); };
  return distances_.distance_m(cube_of(p_W), occupied_in);
}

void WorldMap::hear(const Cube& cube, int level, Space space, Teller teller) {
  const HeardCube heard = {cube, level, space};
  hear(std::span(&heard, 1), teller);
}

void WorldMap::hear(std::span<const HeardCube> cubes, Teller teller) {
  for (const HeardCube& heard : cubes) take(heard, teller);
  note_changes();
  tidy_if_grown();
}

/// Tidies only after the map has grown so much that a pass over all blocks costs no more than creating them did.
void WorldMap::tidy_if_grown() {
  const auto blocks = [&] {
    std::size_t count = 0;
    for (const auto& level : levels_) count += level->blocks();
    return count;
  };
  if (blocks() <= tidied_blocks_ + tidied_blocks_ / kTidyGrowth + kTidyAfterBlocks) return;
  for (const auto& level : levels_) level->tidy();
  tidied_blocks_ = blocks();
}

void WorldMap::take(const HeardCube& heard, Teller teller) {
  if (heard.space == Space::occupied) {
    if (ignores_ && known(heard.cube).space == Space::free && ignores_(heard.cube)) return;
    return meet(heard.cube, teller);
  }
  settle_free(heard.cube, heard.level, teller);
  for (int i = heard.level; i < levels(); ++i) {
    if (levels_.at(static_cast<std::size_t>(i))->known(shifted(heard.cube, i - heard.level)).space != Space::unknown)
      return;
  }
  levels_.at(static_cast<std::size_t>(heard.level))->set(heard.cube, Space::free, teller);
}

/// Settles the doubts within a cube that is free now: this UAV's beams have proved it, or the teller that reported the
/// smaller cubes occupied now reports them free.
void WorldMap::settle_free(const Cube& cube, int level, Teller teller) {
  const int edge = 1 << level;
  levels_.front()->settle_free(cube * edge, edge, teller);
}

MapLevel::Known WorldMap::known(const Cube& cube) const {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const MapLevel::Known known = levels_[i]->known(shifted(cube, static_cast<int>(i)));
    if (known.space != Space::unknown) return known;
  }
  return {};
}

/// Whether a smallest cube is free. Keeps the last chunk, because queries are for cubes near each other.
class WorldMap::FreeCubes {
 public:
  explicit FreeCubes(const WorldMap& map) : map_(map) {}

  bool operator()(const Cube& cube) {
    const Cube chunk = MapLevel::block_of(cube);
    if (chunk != chunk_) note_ = map_.free_rows(chunk);
    chunk_ = chunk;
    const std::size_t place = MapLevel::place_of(cube);
    return note_ != nullptr && (note_->free_rows[place / kChunk] >> place % kChunk & 1) != 0;
  }

 private:
  const WorldMap& map_;
  Cube chunk_ = Cube::Constant(std::numeric_limits<int>::max());  ///< of the last query; at first none
  const ChunkNote* note_ = nullptr;
};

/// Calls `test` with all chunks between those of two cubes, until it returns false.
template <class Test>
bool WorldMap::all_chunks(const Cube& lowest, const Cube& highest, const Test& test) const {
  const Cube low = MapLevel::block_of(lowest), high = MapLevel::block_of(highest);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        if (!test(Cube(x, y, z))) return false;
      }
    }
  }
  return true;
}

bool WorldMap::tube_free(const Vector3d& a_W, const Vector3d& b_W, double radius_m) const {
  const Vector3d reach = Vector3d::Constant(radius_m);
  // Where a UAV flies, all cubes of most chunks are free.
  const Cube low = cube_of(a_W.cwiseMin(b_W) - reach), high = cube_of(a_W.cwiseMax(b_W) + reach);
  const bool chunks_free = all_chunks(low, high, [&](const Cube& chunk) {
    const ChunkNote* const note = free_rows(chunk);
    return note != nullptr && note->all_free;
  });
  if (chunks_free) return true;
  return all_near(a_W, b_W, radius_m, FreeCubes(*this));
}

const WorldMap::ChunkNote* WorldMap::free_rows(const Cube& chunk) const {
  const ChunkNote* const note = chunks_.find(grid_key(chunk));
  if (note == nullptr || note->read_at == note->changed_at) return note;
  note->free_rows = rows(chunk, Space::free);
  note->all_free = std::ranges::all_of(note->free_rows, [](auto row) { return row == kRowFree; });
  note->read_at = note->changed_at;
  return note;
}

/// Checks the chunk row by row, with one bit for each cube of a row. Rows with all cubes free are skipped.
bool WorldMap::ball_free_in(const Cube& chunk, const Ball& ball) const {
  const ChunkNote* const note = free_rows(chunk);
  if (note != nullptr && note->all_free) return true;
  const double cell_m = config_.cell_m;
  const Cube first = chunk * kChunk;
  std::array<int, 3> begin = {}, end = {};
  std::array<std::array<double, kChunk>, 3> gap2;  // by axis: squared distance from the ball's centre to the cubes
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<std::size_t>(axis);
    begin[along] = std::max(0, ball.low[axis] - first[axis]);
    end[along] = std::min(kChunk, ball.high[axis] + 1 - first[axis]);
    for (int i = begin[along]; i < end[along]; ++i) {
      const double low_m = (first[axis] + i) * cell_m;
      const double gap_m = std::max({0.0, low_m - ball.p_W[axis], ball.p_W[axis] - low_m - cell_m});
      gap2[along][static_cast<std::size_t>(i)] = gap_m * gap_m;
    }
  }
  const double radius2 = ball.radius_m * ball.radius_m;
  for (int z = begin[2]; z < end[2]; ++z) {
    const double gap2_z = gap2[2][static_cast<std::size_t>(z)];
    if (gap2_z > radius2 || (first.z() + z + 1) * cell_m <= ball.lowest_m) continue;
    for (int y = begin[1]; y < end[1]; ++y) {
      const unsigned free = note == nullptr ? 0 : note->free_rows[static_cast<std::size_t>(z * kChunk + y)];
      if (free == kRowFree) continue;
      const double left2 = radius2 - gap2_z - gap2[1][static_cast<std::size_t>(y)];
      unsigned touched = 0;
      for (int x = begin[0]; x < end[0]; ++x) {
        touched |= static_cast<unsigned>(gap2[0][static_cast<std::size_t>(x)] <= left2) << x;
      }
      if ((touched & ~free) != 0) return false;
    }
  }
  return true;
}

/// Asks about the cube at the centre first: most places that are not free lie in unknown space.
bool WorldMap::ball_free(const Vector3d& p_W, double radius_m, double lowest_m) const {
  const Cube centre = cube_of(p_W);
  const bool counts = radius_m > 0.0 && (centre.z() + 1) * config_.cell_m > lowest_m;
  if (counts && !FreeCubes(*this)(centre)) return false;
  const Vector3d reach = Vector3d::Constant(radius_m);
  const Cube low = cube_of(p_W - reach), high = cube_of(p_W + reach);
  // One cube more on each side: for a cube that begins exactly at the radius, rounding may differ from ball_free_in().
  const Ball ball = {p_W, radius_m, lowest_m, low - Cube::Ones(), high + Cube::Ones()};
  return all_chunks(low, high, [&](const Cube& chunk) { return ball_free_in(chunk, ball); });
}

void WorldMap::not_free_near(const Vector3d& p_W, double radius_m, double lowest_m, std::vector<Cube>& cubes) const {
  FreeCubes is_free(*this);
  all_near(p_W, p_W, radius_m, [&](const Cube& cube) {
    const bool asked = (cube.z() + 1) * config_.cell_m > lowest_m;
    if (asked && !is_free(cube)) cubes.push_back(cube);
    return true;
  });
}

WorldMap::Counts WorldMap::counts() const {
  Counts counts;
  for (const auto& level : levels_) {
    counts.free.push_back(level->free_cells());
    counts.blocks += level->blocks();
    counts.bytes += level->bytes();
    counts.windows += level->windows();
  }
  counts.bytes += distances_.bytes() + chunks_.bytes() + in_regions_.bytes() + structured_.bytes();
  counts.occupied = levels_.front()->occupied_cells();
  return counts;
}

}  // namespace skein::agent
