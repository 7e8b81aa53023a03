#include "uav_agent/maps/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random_stream.hpp"
#include "core/types.hpp"

namespace skein::agent {
namespace {

using Cell = DistanceField::Cell;

constexpr double kCubeM = 0.5, kReachM = 4.0;

std::vector<Cell> drawn_cells(RandomStream& random, int count) {
  std::vector<Cell> cells;
  for (int i = 0; i < count; ++i) {
    const auto along = [&] { return static_cast<int>(std::floor(random.uniform(-14.0, 14.0))); };
    cells.emplace_back(along(), along(), along());
  }
  return cells;
}

double slow_distance_m(const std::vector<Cell>& occupied, const Cell& cell) {
  double least = kReachM;
  for (const Cell& other : occupied) {
    const Vector3d gap = ((other - cell).cwiseAbs().array() - 1).max(0).matrix().cast<double>();
    least = std::min(least, kCubeM * gap.norm());
  }
  return least;
}

void expect_exact(const DistanceField& field, const std::vector<Cell>& occupied) {
  for (int i = 0; i < 48 * 48 * 48; i += 5) {
    const Cell cell = Cell(i % 48, i / 48 % 48, i / (48 * 48)) - Cell::Constant(24);
    ASSERT_NEAR(field.distance_m(cell), slow_distance_m(occupied, cell), 1e-12) << cell.transpose();
  }
}

TEST(DistanceField, IsTheDistanceToTheNearestOfAllCells) {
  for (std::uint64_t world = 1; world <= 6; ++world) {
    RandomStream random(world, "distance", 0);
    DistanceField field(kCubeM, kReachM);
    const std::vector<Cell> occupied = drawn_cells(random, world == 1 ? 1 : 12);
    for (const Cell& cell : occupied) field.add(cell);
    expect_exact(field, occupied);
  }
}

TEST(DistanceField, ForgetsWhatIsOccupiedNoMore) {
  for (std::uint64_t world = 1; world <= 4; ++world) {
    RandomStream random(world, "distance", 1);
    DistanceField field(kCubeM, kReachM);
    std::vector<Cell> occupied = drawn_cells(random, 25);
    for (const Cell& cell : occupied) field.add(cell);
    const std::vector<Cell> gone(occupied.end() - 6, occupied.end());
    std::erase_if(occupied, [&](const Cell& cell) { return std::ranges::find(gone, cell) != gone.end(); });
    field.remove(gone, [&](const Cell& block) {
      std::vector<Cell> in_block;
      for (const Cell& cell : occupied) {
        if (Cell(cell.x() >> 3, cell.y() >> 3, cell.z() >> 3) == block) in_block.push_back(cell);
      }
      return in_block;
    });
    expect_exact(field, occupied);
  }
}

TEST(DistanceField, KnowsNothingNearWhereNothingIs) {
  const DistanceField field(kCubeM, kReachM);
  EXPECT_EQ(field.distance_m({0, 0, 0}), kReachM);
  EXPECT_THROW(DistanceField(0.5, 8.0), std::invalid_argument);
}

}  // namespace
}  // namespace skein::agent
