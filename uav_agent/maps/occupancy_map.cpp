#include "uav_agent/maps/occupancy_map.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace skein::agent {
namespace {

constexpr int kCountedRays = 20;  ///< through a coarse cell; more make no difference
constexpr int kFineSteps = 8;     ///< of cast(), for each coarse one; even

/// Occupied cells in blocks of 4 x 4 x 4, one bit each, found by hash: only ever looked up, never walked through.
class CellBlocks {
 public:
  explicit CellBlocks(double cell_m) : cell_m_(cell_m) {}

  /// @returns true when the cell was not set before.
  bool set(const Vector3d& p) {
    const Eigen::Vector3i c = cell(p);
    if (const std::uint64_t its_key = key(block(c)); last_ == nullptr || its_key != last_key_) {
      last_ = &blocks_[its_key];
      last_key_ = its_key;
    }
    const std::uint64_t bit = bit_of(c);
    if (*last_ & bit) return false;
    *last_ |= bit;
    ++count_;
    return true;
  }
  bool test(const Vector3d& p) const {
    const Eigen::Vector3i c = cell(p);
    const auto it = blocks_.find(key(block(c)));
    return it != blocks_.end() && (it->second & bit_of(c));
  }
  std::size_t count() const { return count_; }

  /// Smallest squared distance from p to the centre of an occupied cell, if it is at most `radius`^2.
  /// With `any`, stops at the first cell within the radius.
  std::optional<double> nearest_squared(const Vector3d& p, double radius, bool any) const {
    double best = radius * radius;
    bool found = false;
    const Eigen::Vector3i lo = block(cell(p - Vector3d::Constant(radius)));
    const Eigen::Vector3i hi = block(cell(p + Vector3d::Constant(radius)));
    for (int z = lo.z(); z <= hi.z(); ++z) {
      for (int y = lo.y(); y <= hi.y(); ++y) {
        for (int x = lo.x(); x <= hi.x(); ++x) {
          const auto it = blocks_.find(key({x, y, z}));
          if (it == blocks_.end()) continue;
          for (std::uint64_t bits = it->second; bits != 0; bits &= bits - 1) {
            const double d2 = (centre({x, y, z}, __builtin_ctzll(bits)) - p).squaredNorm();
            if (d2 > best) continue;
            best = d2;
            found = true;
            if (any) return best;
          }
        }
      }
    }
    return found ? std::optional(best) : std::nullopt;
  }

 private:
  static constexpr int kEdge = 4;

  Eigen::Vector3i cell(const Vector3d& p) const { return (p / cell_m_).array().floor().matrix().cast<int>(); }
  static Eigen::Vector3i block(const Eigen::Vector3i& c) { return {c.x() >> 2, c.y() >> 2, c.z() >> 2}; }
  static std::uint64_t bit_of(const Eigen::Vector3i& c) {
    return std::uint64_t{1} << ((c.x() & 3) | (c.y() & 3) << 2 | (c.z() & 3) << 4);
  }
  static std::uint64_t key(const Eigen::Vector3i& b) {
    constexpr std::uint64_t kMask = (1U << 21) - 1;
    return (static_cast<std::uint64_t>(b.x()) & kMask) | (static_cast<std::uint64_t>(b.y()) & kMask) << 21 |
           (static_cast<std::uint64_t>(b.z()) & kMask) << 42;
  }
  Vector3d centre(const Eigen::Vector3i& b, int bit) const {
    const Eigen::Vector3i c = kEdge * b + Eigen::Vector3i(bit & 3, bit >> 2 & 3, bit >> 4);
    return (c.cast<double>() + Vector3d::Constant(0.5)) * cell_m_;
  }

  const double cell_m_;
  std::unordered_map<std::uint64_t, std::uint64_t> blocks_;
  std::uint64_t* last_ = nullptr;  ///< block that was set last: the next is most often the same
  std::uint64_t last_key_ = 0;
  std::size_t count_ = 0;
};

octomap::point3d to_octomap(const Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

/// How many rays have passed each cell of a coarse grid, in blocks of 4 x 4 x 4 found by hash: a ray passes some cells
/// of each, and the octree that lends its keys is far slower to ask. Only ever looked up, never walked through.
class RayCounts {
 public:
  explicit RayCounts(double cell_m) : grid_(cell_m) {}

  void add(const PassedCells& passed) {
    for (const auto& [key, counts] : passed.blocks) {
      PassedCells::Block& block = blocks_[key];
      for (std::size_t i = 0; i < block.size(); ++i) block[i] = counted(block[i] + counts[i]);
    }
  }
  int at(const Vector3d& p) const {
    octomap::OcTreeKey key;
    if (!grid_.coordToKeyChecked(to_octomap(p), key)) return 0;
    const auto found = blocks_.find(block_key(key));
    return found == blocks_.end() ? 0 : found->second[cell_in_block(key)];
  }

  /// Of one key frame.
  class Trace {
   public:
    explicit Trace(const RayCounts& counts) : grid_(counts.grid_) {}

    void add_ray(const Vector3d& from, const Vector3d& to) {
      if (!grid_.computeRayKeys(to_octomap(from), to_octomap(to), ray_)) return;
      PassedCells::Block* block = nullptr;
      std::uint64_t its_key = 0;
      for (const octomap::OcTreeKey& key : ray_) {
        if (block == nullptr || block_key(key) != its_key) {
          its_key = block_key(key);
          const auto [found, is_new] = places_.try_emplace(its_key, passed_.blocks.size());
          if (is_new) passed_.blocks.push_back({its_key, {}});
          block = &passed_.blocks[found->second].second;
        }
        std::uint8_t& count = (*block)[cell_in_block(key)];
        count = counted(count + 1);
      }
    }
    PassedCells passed() && { return std::move(passed_); }

   private:
    const octomap::OcTree& grid_;
    octomap::KeyRay ray_;
    PassedCells passed_;
    std::unordered_map<std::uint64_t, std::size_t> places_;  ///< in `passed_`, by block
  };

 private:
  static std::uint8_t counted(int rays) { return static_cast<std::uint8_t>(std::min(rays, kCountedRays)); }
  static std::uint64_t block_key(const octomap::OcTreeKey& key) {
    return std::uint64_t{key[0]} >> 2 | std::uint64_t{key[1]} >> 2 << 16 | std::uint64_t{key[2]} >> 2 << 32;
  }
  static std::size_t cell_in_block(const octomap::OcTreeKey& key) {
    return (key[0] & 3U) | (key[1] & 3U) << 2 | (key[2] & 3U) << 4;
  }

  const octomap::OcTree grid_;  ///< empty
  std::unordered_map<std::uint64_t, PassedCells::Block> blocks_;
};

struct OccupancyMap::Impl {
  explicit Impl(const Config& c) : config(c), hits(c.resolution_m), free(c.free_resolution_m), cells(c.resolution_m) {}

  const Config config;
  octomap::OcTree hits;  ///< fine; only hits
  RayCounts free;        ///< coarse; only what rays passed
  CellBlocks cells;      ///< the same cells as `hits`
  std::uint64_t revision = 0;
};

OccupancyMap::OccupancyMap() : OccupancyMap(Config()) {}
OccupancyMap::OccupancyMap(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
OccupancyMap::~OccupancyMap() = default;
OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;

PassedCells OccupancyMap::trace(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) const {
  const Config& config = impl_->config;
  if (!p_WS) return {};
  RayCounts::Trace trace(impl_->free);
  const std::size_t stride = std::max<std::size_t>(1, hits_W.size() / std::max(1, config.max_free_rays));
  for (std::size_t i = 0; i < hits_W.size(); i += stride) {
    const Vector3d to_hit = hits_W[i].cast<double>() - *p_WS;
    // The cell of the hit itself is not free, and one cell short of it the ray only grazes what it will hit.
    const double length = std::min(to_hit.norm() - config.free_resolution_m, config.free_range_m);
    if (length <= 0.0) continue;
    trace.add_ray(*p_WS, *p_WS + to_hit.normalized() * length);
  }
  return std::move(trace).passed();
}

void OccupancyMap::insert(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) {
  insert(hits_W, trace(hits_W, p_WS));
}

void OccupancyMap::insert(const std::vector<Eigen::Vector3f>& hits_W, const PassedCells& passed) {
  bool changed = false;
  for (const Eigen::Vector3f& hit : hits_W) {
    const Vector3d p = hit.cast<double>();
    if (p.z() < impl_->config.ground_m) continue;
    octomap::OcTreeKey key;
    if (!impl_->hits.coordToKeyChecked(to_octomap(p), key)) continue;  // beyond the tree: kilometres away
    // Both structures must agree on the cell, so the grid takes the centre of the tree's cell.
    const octomap::point3d c = impl_->hits.keyToCoord(key);
    if (!impl_->cells.set(Vector3d(c.x(), c.y(), c.z()))) continue;
    impl_->hits.updateNode(key, true, true);
    changed = true;
  }
  if (changed) ++impl_->revision;
  impl_->free.add(passed);
}

bool OccupancyMap::empty() const { return impl_->cells.count() == 0; }
std::size_t OccupancyMap::occupied_cells() const { return impl_->cells.count(); }
std::uint64_t OccupancyMap::revision() const { return impl_->revision; }

bool OccupancyMap::occupied(const Vector3d& p_W) const { return impl_->cells.test(p_W); }

bool OccupancyMap::known_free(const Vector3d& p_W, int rays) const {
  const int passed = impl_->free.at(p_W);
  return passed > 0 && passed >= std::min(rays, kCountedRays) && !occupied(p_W);
}

bool OccupancyMap::any_occupied_within(const Vector3d& p_W, double radius) const {
  return impl_->cells.nearest_squared(p_W, radius, true).has_value();
}

std::optional<double> OccupancyMap::distance_to_occupied(const Vector3d& p_W, double max_distance) const {
  const auto squared = impl_->cells.nearest_squared(p_W, max_distance, false);
  return squared ? std::optional(std::sqrt(*squared)) : std::nullopt;
}

bool OccupancyMap::segment_clear(const Vector3d& a_W, const Vector3d& b_W, double radius) const {
  const double length = (b_W - a_W).norm();
  if (length < 1e-9) return !any_occupied_within(a_W, radius);
  return !cast(a_W, (b_W - a_W) / length, length, radius).has_value();
}

std::optional<double> OccupancyMap::cast(const Vector3d& from_W, const Vector3d& direction, double max_distance,
                                         double radius) const {
  // A ball around each of samples h apart covers a tube of `radius` where ball^2 = radius^2 + (h/2)^2. Coarse balls
  // find out fast that nothing is near; fine ones say where, a few per cent on the safe side.
  const double h = std::max(2.0 * radius, impl_->config.resolution_m);
  const double fine_h = h / kFineSteps;
  const double ball = std::hypot(radius, 0.5 * h), fine_ball = std::hypot(radius, 0.5 * fine_h);
  const int samples = static_cast<int>(std::ceil(max_distance / h));
  for (int i = 0; i <= samples; ++i) {
    const double s = std::min(i * h, max_distance);
    if (!any_occupied_within(from_W + s * direction, ball)) continue;
    for (int j = -kFineSteps / 2; j <= kFineSteps / 2; ++j) {
      const double t = std::clamp(s + j * fine_h, 0.0, max_distance);
      if (any_occupied_within(from_W + t * direction, fine_ball)) return t;
    }
  }
  return std::nullopt;
}

void OccupancyMap::visit_occupied(const OrientedBox& box, const std::function<void(const Vector3d&)>& visit) const {
  const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
  const octomap::point3d lo = to_octomap(box.center - half), hi = to_octomap(box.center + half);
  const auto end = impl_->hits.end_leafs_bbx();
  for (auto it = impl_->hits.begin_leafs_bbx(lo, hi); it != end; ++it) {
    const Vector3d p(it.getX(), it.getY(), it.getZ());
    if (box.contains(p)) visit(p);
  }
}

}  // namespace skein::agent
