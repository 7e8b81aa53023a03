#include "sim_server/viz/seen_map.hpp"

namespace skein::sim::viz {
namespace {

/// Avoids std::floor, which is a call into libm on baseline x86-64: this is called for every point of every key frame.
std::int32_t floor_of(double x) {
  const auto whole = static_cast<std::int32_t>(x);
  return x < whole ? whole - 1 : whole;
}

}  // namespace

bool SeenMap::add(std::span<const Eigen::Vector3f> points_W) {
  constexpr int kKeyBits = 21;
  const std::size_t before = points_.size();
  std::uint64_t at = 0;
  Block* block = nullptr;
  for (const Eigen::Vector3f& p : points_W) {
    std::array<std::int32_t, 3> cell;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = floor_of(p[axis] * cells_per_m_);
      key = (key << kKeyBits) | (static_cast<std::uint32_t>(cell[axis] >> 3) & ((1U << kKeyBits) - 1));
    }
    if (block == nullptr || key != at) block = &blocks_[key];
    at = key;
    std::uint64_t& word = (*block)[cell[2] & 7];
    const std::uint64_t bit = std::uint64_t{1} << ((cell[0] & 7) | ((cell[1] & 7) << 3));
    if ((word & bit) == 0) points_.push_back(p);
    word |= bit;
  }
  return points_.size() > before;
}

}  // namespace skein::sim::viz
