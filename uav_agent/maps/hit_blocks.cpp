#include "uav_agent/maps/hit_blocks.hpp"

#include <bit>

namespace skein::agent {
namespace {

constexpr int kHitBlockEdge = 4;  ///< memory: a block is a bit mask of 4^3 cells

/// Key of the region that contains a block.
std::uint64_t region_key(const Eigen::Vector3i& block) { return grid_key(HitBlocks::block_of(block)); }

/// Divides the blocks lo to hi along one axis by regions: calls `use` with the first and the last block in each region.
void each_region(int lo, int hi, const auto& use) {
  for (int from = lo; from <= hi; from = (from | (kHitBlockEdge - 1)) + 1) {
    use(from, std::min(hi, from | (kHitBlockEdge - 1)));
  }
}

}  // namespace

std::uint64_t HitBlocks::add(const Eigen::Vector3i& block, std::uint64_t cells) {
  std::uint64_t& known = regions_[region_key(block)][place_of(block)];
  const std::uint64_t news = cells & ~known;
  known |= cells;
  count_ += static_cast<std::size_t>(std::popcount(news));
  return news;
}

bool HitBlocks::test(const Vector3d& p_W) const {
  const Eigen::Vector3i c = cell(p_W), block = block_of(c);
  const Region* const region = regions_.find(region_key(block));
  return region != nullptr && ((*region)[place_of(block)] >> place_of(c) & 1U) != 0;
}

std::optional<double> HitBlocks::nearest_squared(const Vector3d& p_W, double radius, bool any) const {
  double best = radius * radius;
  bool found = false;
  const Eigen::Vector3i lo = block_of(cell(p_W - Vector3d::Constant(radius)));
  const Eigen::Vector3i hi = block_of(cell(p_W + Vector3d::Constant(radius)));
  const auto look_at = [&](const Region& region, const Eigen::Vector3i& block) {
    for (std::uint64_t bits = region[place_of(block)]; bits != 0 && !(any && found); bits &= bits - 1) {
      const double d2 = (centre(block, std::countr_zero(bits)) - p_W).squaredNorm();
      if (d2 > best) continue;
      best = d2;
      found = true;
    }
  };
  each_region(lo.z(), hi.z(), [&](int z_from, int z_to) {
    each_region(lo.y(), hi.y(), [&](int y_from, int y_to) {
      each_region(lo.x(), hi.x(), [&](int x_from, int x_to) {
        const Region* const region = any && found ? nullptr : regions_.find(region_key({x_from, y_from, z_from}));
        if (region == nullptr) return;
        for (int z = z_from; z <= z_to; ++z) {
          for (int y = y_from; y <= y_to; ++y) {
            for (int x = x_from; x <= x_to; ++x) look_at(*region, {x, y, z});
          }
        }
      });
    });
  });
  return found ? std::optional(best) : std::nullopt;
}

Eigen::Vector3i HitBlocks::cell_at(const Eigen::Vector3i& block, int bit) {
  return kHitBlockEdge * block + Eigen::Vector3i(bit & 3, bit >> 2 & 3, bit >> 4);
}

Vector3d HitBlocks::centre(const Eigen::Vector3i& block, int bit) const {
  return (cell_at(block, bit).cast<double>() + Vector3d::Constant(0.5)) * cell_m_;
}

}  // namespace skein::agent
