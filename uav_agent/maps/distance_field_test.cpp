#include "uav_agent/maps/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
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

void expect_exact(DistanceField& field, const std::vector<Cell>& occupied) {
  const auto occupied_in = [&](const Cell& block) {
    CellRows rows = {};
    for (const Cell& cell : occupied) {
      if (shifted(cell, 3) != block) continue;
      const auto row = static_cast<std::size_t>((cell.z() & 7) * 8 + (cell.y() & 7));
      rows[row] |= static_cast<std::uint8_t>(1 << (cell.x() & 7));
    }
    return rows;
  };
  for (int i = 0; i < 48 * 48 * 48; i += 5) {
    const Cell cell = Cell(i % 48, i / 48 % 48, i / (48 * 48)) - Cell::Constant(24);
    ASSERT_NEAR(field.distance_m(cell, occupied_in), slow_distance_m(occupied, cell), 1e-12) << cell.transpose();
  }
}

TEST(DistanceField, IsTheDistanceToTheNearestCellAsCellsComeAndGo) {
  for (std::uint64_t world = 1; world <= 6; ++world) {
    RandomStream random(world, "distance", 0);
    DistanceField field(kCubeM, kReachM);
    std::vector<Cell> occupied;
    expect_exact(field, occupied);
    for (int change = 0; change < 5; ++change) {
      if (change == 3) {
        for (int i = 0; i < 6; ++i) {
          field.changed(occupied.back());
          occupied.pop_back();
        }
      }
      for (const Cell& cell : drawn_cells(random, world == 1 ? 3 : 5)) {
        occupied.push_back(cell);
        field.changed(cell);
      }
      expect_exact(field, occupied);
    }
  }
}

TEST(DistanceField, ComputesABlockAgainOnlyIfSomethingNearItHasChanged) {
  DistanceField field(kCubeM, kReachM);
  int asked = 0;
  const auto occupied_in = [&](const Cell& block) {
    ++asked;
    CellRows rows = {};
    if (block == Cell(0, 0, 0)) rows[9] = 2;  // the cell (1, 1, 1)
    return rows;
  };
  EXPECT_EQ(field.distance_m({5, 1, 1}, occupied_in), kReachM);
  EXPECT_EQ(asked, 0) << "nothing is occupied";
  field.changed({1, 1, 1});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(field.distance_m({5, 1, 1}, occupied_in), 1.5);
  EXPECT_EQ(asked, 1);
  field.changed({100, 1, 1});
  field.distance_m({5, 1, 1}, occupied_in);
  EXPECT_EQ(asked, 1);
  field.changed({8, 1, 1});
  field.distance_m({5, 1, 1}, occupied_in);
  EXPECT_EQ(asked, 3) << "it asks for both blocks that have changed";
}

TEST(DistanceField, RejectsAReachOfLessThanACellOrMoreThanABlock) {
  EXPECT_THROW(DistanceField(0.5, 4.5), std::invalid_argument);
  EXPECT_THROW(DistanceField(0.5, 0.2), std::invalid_argument);
}

}  // namespace
}  // namespace skein::agent
