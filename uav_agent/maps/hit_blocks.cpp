#include "uav_agent/maps/hit_blocks.hpp"

namespace skein::agent {
namespace {

constexpr int kHitBlockEdge = 4;

Eigen::Vector3i hit_block(const Eigen::Vector3i& cell) { return {cell.x() >> 2, cell.y() >> 2, cell.z() >> 2}; }

std::uint64_t hit_bit(const Eigen::Vector3i& cell) {
  return std::uint64_t{1} << ((cell.x() & 3) | (cell.y() & 3) << 2 | (cell.z() & 3) << 4);
}

std::uint64_t hit_block_key(const Eigen::Vector3i& block) {
  constexpr std::uint64_t kMask = (1U << 21) - 1;
  return (static_cast<std::uint64_t>(block.x()) & kMask) | (static_cast<std::uint64_t>(block.y()) & kMask) << 21 |
         (static_cast<std::uint64_t>(block.z()) & kMask) << 42;
}

}  // namespace

bool HitBlocks::set(const Eigen::Vector3i& cell) {
  std::uint64_t& block = blocks_[hit_block_key(hit_block(cell))];
  if (block & hit_bit(cell)) return false;
  block |= hit_bit(cell);
  ++count_;
  return true;
}

bool HitBlocks::test(const Vector3d& p_W) const {
  const Eigen::Vector3i c = cell(p_W);
  const std::uint64_t* const block = blocks_.find(hit_block_key(hit_block(c)));
  return block != nullptr && (*block & hit_bit(c));
}

std::optional<double> HitBlocks::nearest_squared(const Vector3d& p_W, double radius, bool any) const {
  double best = radius * radius;
  bool found = false;
  const Eigen::Vector3i lo = hit_block(cell(p_W - Vector3d::Constant(radius)));
  const Eigen::Vector3i hi = hit_block(cell(p_W + Vector3d::Constant(radius)));
  for (int z = lo.z(); z <= hi.z(); ++z) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      for (int x = lo.x(); x <= hi.x(); ++x) {
        const std::uint64_t* const block = blocks_.find(hit_block_key({x, y, z}));
        if (block == nullptr) continue;
        for (std::uint64_t bits = *block; bits != 0; bits &= bits - 1) {
          const double d2 = (centre({x, y, z}, __builtin_ctzll(bits)) - p_W).squaredNorm();
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

Vector3d HitBlocks::centre(const Eigen::Vector3i& block, int bit) const {
  const Eigen::Vector3i c = kHitBlockEdge * block + Eigen::Vector3i(bit & 3, bit >> 2 & 3, bit >> 4);
  return (c.cast<double>() + Vector3d::Constant(0.5)) * cell_m_;
}

}  // namespace skein::agent
