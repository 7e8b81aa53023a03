#include "uav_agent/maps/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

/// A grid that is turned and shifted: 7 x 5 x 4 cubes of 2.5 m, in chunks of 32.
VoxelGrid turned_grid() {
  Isometry3d X_WG(Eigen::Translation3d(-3.0, 11.0, 0.5));
  X_WG.linear() = rotation_z(0.7);
  return {X_WG, {16.0, 12.5, 10.0}, 2.5, 32};
}

/// A repeatable draw from [0, 1).
class GridDraw {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1.0p-53;
  }
  Vector3d in(const Vector3d& lo, const Vector3d& hi) {
    return lo + Vector3d((*this)(), (*this)(), (*this)()).cwiseProduct(hi - lo);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>((*this)() * static_cast<double>(n)); }

 private:
  std::uint64_t state_ = 42;
};

void fill(VoxelGrid& grid, std::size_t count, GridDraw& draw) {
  for (std::size_t i = 0; i < count; ++i) {
    const Id id = static_cast<Id>(draw.below(grid.count()));
    grid.raise(id, draw() < 0.5 ? VoxelState::free : VoxelState::occupied);
    if (draw() < 0.3) grid.mark(id, static_cast<int>(draw.below(6)));
  }
}

bool same(const VoxelGrid& a, const VoxelGrid& b) {
  for (Id id = 0; id < a.count(); ++id) {
    if (a.state(id) != b.state(id)) return false;
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      if (a.marked(id, face) != b.marked(id, face)) return false;
    }
  }
  return true;
}

TEST(VoxelGrid, TheRangeOfCellsIncludesAllWithTheirCentreInTheCube) {
  const VoxelGrid grid = turned_grid();
  GridDraw draw;
  for (int drawn = 0; drawn < 300; ++drawn) {
    const Vector3d middle_W = draw.in({-25.0, -5.0, -10.0}, {25.0, 40.0, 20.0});
    const double half_edge_m = 8.0 * draw();
    const auto [low, high] = grid.cells_within(middle_W, half_edge_m);
    ASSERT_TRUE((low.array() >= 0).all() && (high.array() < grid.dims().array()).all());
    for (Id id = 0; id < grid.count(); ++id) {
      if (((grid.centre_W(id) - middle_W).cwiseAbs().array() > half_edge_m).any()) continue;
      const VoxelGrid::Cell cell = grid.cell(id);
      ASSERT_TRUE((cell.array() >= low.array()).all() && (cell.array() <= high.array()).all()) << id;
    }
  }
}

TEST(VoxelGrid, FindsEachCubeByItsCentreAndByItsCell) {
  const VoxelGrid grid = turned_grid();
  EXPECT_EQ(grid.dims(), Eigen::Vector3i(7, 5, 4));
  for (Id id = 0; id < grid.count(); ++id) {
    EXPECT_EQ(grid.at(grid.centre_W(id)), id);
    EXPECT_EQ(grid.at(grid.cell(id)), id);
  }
}

TEST(VoxelGrid, NeighboursLieBeyondTheirFace) {
  const VoxelGrid grid = turned_grid();
  for (Id id = 0; id < grid.count(); ++id) {
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      const auto next = grid.neighbour(id, face);
      const Vector3d beyond = grid.centre_W(id) + 2.5 * grid.normal_W(face);
      EXPECT_EQ(next, grid.at(beyond));
      EXPECT_TRUE(!next || grid.neighbour(*next, VoxelGrid::opposite(face)) == id);
    }
  }
}

TEST(VoxelGrid, PlacesOutsideHaveNoCubeHoweverFar) {
  const VoxelGrid grid = turned_grid();
  for (const Vector3d& p : {Vector3d(1e30, 0, 0), Vector3d(0, 0, -1), Vector3d(NAN, 0, 0), Vector3d(-40, 11, 2)}) {
    EXPECT_FALSE(grid.at(p));
  }
  EXPECT_THROW(VoxelGrid(Isometry3d::Identity(), {1e9, 1e9, 1e9}, 1.0), std::invalid_argument);
  EXPECT_THROW(VoxelGrid(Isometry3d::Identity(), {1, 1, 1}, 0.0), std::invalid_argument);
}

TEST(VoxelGrid, KnowledgeOnlyGrows) {
  VoxelGrid grid = turned_grid();
  EXPECT_TRUE(grid.raise(3, VoxelState::free));
  EXPECT_TRUE(grid.mark(3, 5));
  EXPECT_FALSE(grid.mark(3, 5)) << "the mark is known already";
  EXPECT_TRUE(grid.raise(3, VoxelState::occupied));
  EXPECT_FALSE(grid.raise(3, VoxelState::free));
  EXPECT_EQ(grid.state(3), VoxelState::occupied);
  EXPECT_TRUE(grid.marked(3, 5));
  EXPECT_FALSE(grid.marked(3, 4));
  EXPECT_EQ(grid.take_changed(), (std::vector<Id>{3, 3})) << "marks are not changes of state";
  EXPECT_TRUE(grid.take_changed().empty());
}

TEST(VoxelGrid, ASegmentPassesTheCubesThatItsPointsLieIn) {
  const VoxelGrid grid = turned_grid();
  GridDraw draw;
  for (int i = 0; i < 200; ++i) {
    const Vector3d a = draw.in({-25, 0, -5}, {25, 35, 15}), b = draw.in({-25, 0, -5}, {25, 35, 15});
    std::set<Id> passed, sampled;
    std::optional<Id> last;
    grid.along(a, b, [&](Id id) {
      EXPECT_TRUE(!last || (grid.cell(id) - grid.cell(*last)).cwiseAbs().sum() == 1) << "no cube is left out";
      last = id;
      passed.insert(id);
      return true;
    });
    for (int j = 0; j <= 4000; ++j) {
      if (const auto id = grid.at(Vector3d(a + (b - a) * (j / 4000.0)))) sampled.insert(*id);
    }
    for (const Id id : sampled) EXPECT_TRUE(passed.contains(id)) << "segment " << i;
    EXPECT_LE(passed.size(), sampled.size() + 2) << "but for corners that no sample hit";
  }
}

TEST(VoxelGrid, AnOccupiedCubeBlocksTheView) {
  VoxelGrid grid(Isometry3d::Identity(), {10, 1, 1}, 1.0);
  const Vector3d a(0.5, 0.5, 0.5), b(9.5, 0.5, 0.5);
  EXPECT_TRUE(grid.sees(a, b)) << "unknown cubes do not hide";
  grid.raise(9, VoxelState::occupied);
  EXPECT_TRUE(grid.sees(a, b)) << "b does not hide itself";
  grid.raise(5, VoxelState::occupied);
  EXPECT_FALSE(grid.sees(a, b));
}

TEST(VoxelGrid, ChunksCarryTheWholeMap) {
  VoxelGrid from = turned_grid(), to = turned_grid();
  GridDraw draw;
  fill(from, 100, draw);
  ASSERT_EQ(from.chunks(), 5U) << "140 cubes in chunks of 32";
  for (std::size_t chunk = 0; chunk < from.chunks(); ++chunk) {
    PayloadWriter writer;
    from.write_chunk(chunk, writer);
    EXPECT_LE(writer.size(), from.chunk_bytes());
    PayloadReader reader(writer.data());
    EXPECT_TRUE(to.merge_chunk(chunk, reader));
    EXPECT_TRUE(reader.at_end());
    EXPECT_EQ(from.chunk_hash(chunk), to.chunk_hash(chunk));
  }
  EXPECT_TRUE(same(from, to));
}

TEST(VoxelGrid, ChunksWithMoreCubesThanAMessageCanNumberAreRefused) {
  const auto grid_of = [](std::size_t chunk) { return VoxelGrid(Isometry3d::Identity(), {60, 60, 40}, 1.0, chunk); };
  for (const std::size_t chunk : {0U, 65'536U, 70'000U, 144'000U, 1'000'000U}) {
    EXPECT_THROW(grid_of(chunk), std::invalid_argument) << chunk;
  }
  VoxelGrid from = grid_of(65'535), to = grid_of(65'535);
  GridDraw draw;
  fill(from, 200'000, draw);  // so dense that the chunks are written cube by cube
  for (std::size_t chunk = 0; chunk < from.chunks(); ++chunk) {
    PayloadWriter writer;
    from.write_chunk(chunk, writer);
    PayloadReader reader(writer.data());
    EXPECT_TRUE(to.merge_chunk(chunk, reader) && reader.at_end()) << chunk;
  }
  EXPECT_TRUE(same(from, to));
}

TEST(VoxelGrid, MergingGivesTheSameGridInAnyOrderAndMayBeRepeated) {
  VoxelGrid a = turned_grid(), b = turned_grid();
  GridDraw draw;
  fill(a, 90, draw);
  fill(b, 90, draw);
  const auto merge = [](VoxelGrid& to, const VoxelGrid& from) {
    for (std::size_t chunk = 0; chunk < from.chunks(); ++chunk) {
      PayloadWriter writer;
      from.write_chunk(chunk, writer);
      PayloadReader reader(writer.data());
      EXPECT_TRUE(to.merge_chunk(chunk, reader));
    }
  };
  VoxelGrid ab = a, ba = b;
  merge(ab, b);
  merge(ba, a);
  EXPECT_TRUE(same(ab, ba));
  const std::uint64_t revision = ab.revision();
  merge(ab, b);
  EXPECT_EQ(ab.revision(), revision) << "merging the same map again changes nothing";
}

TEST(VoxelGrid, RandomBytesLeaveStatesValidAndACutChunkIsRefused) {
  VoxelGrid grid = turned_grid();
  GridDraw draw;
  for (int i = 0; i < 2000; ++i) {
    PayloadWriter writer;
    const std::size_t length = draw.below(80);
    for (std::size_t j = 0; j < length; ++j) writer.u8(static_cast<std::uint8_t>(draw.below(256)));
    PayloadReader reader(writer.data());
    grid.merge_chunk(draw.below(7), reader);
    for (Id id = 0; id < grid.count(); ++id) ASSERT_LE(static_cast<int>(grid.state(id)), 2);
  }
  PayloadWriter cut;
  grid.write_chunk(0, cut);
  PayloadReader reader(std::span(cut.data()).first(cut.size() - 1));
  EXPECT_FALSE(grid.merge_chunk(0, reader));
}

TEST(VoxelGrid, TheOperationalVolumeHoldsBoxesAndStarts) {
  OrientedBox box;
  box.center = {10.0, 0.0, 15.0};
  box.size = {20.0, 4.0, 30.0};
  box.R_WO = rotation_z(0.5);
  const std::vector<Vector3d> starts = {{-20.0, 3.0, 0.0}};
  const VoxelGrid grid = operational_volume({box}, starts, 5.0, 0.0, 5.0);
  EXPECT_TRUE(grid.at(Vector3d(-20.0, 3.0, 0.1)));
  EXPECT_TRUE(grid.at(Vector3d(box.center + box.R_WO * (0.5 * box.size))));
  EXPECT_FALSE(grid.at(Vector3d(0.0, 0.0, -0.1)));
  EXPECT_NE(grid.fingerprint(), operational_volume({box}, starts, 5.0, 0.0, 4.0).fingerprint());
  EXPECT_EQ(grid.fingerprint(), operational_volume({box}, starts, 5.0, 0.0, 5.0).fingerprint());
}

TEST(VoxelGrid, CubesGrowOnlyIfThereWereTooManyAndNoMoreThanNeeded) {
  GridDraw draw;
  int larger = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d size_m = draw.in(Vector3d::Constant(1.0), {1500.0, 1500.0, 200.0});
    const double asked_m = 1.0 + 2.0 * draw();
    const auto cubes = [&](double edge_m) { return (size_m / edge_m).array().ceil().prod(); };
    const double edge_m = fitting_voxel_m(asked_m, [&](double) { return size_m; });
    EXPECT_LE(cubes(edge_m), VoxelGrid::kMostVoxels);
    if (cubes(asked_m) <= VoxelGrid::kMostVoxels) {
      EXPECT_EQ(edge_m, asked_m) << "to the last bit";
    } else {
      EXPECT_GT(cubes(edge_m / 1.11), VoxelGrid::kMostVoxels);
      ++larger;
    }
  }
  EXPECT_GT(larger, 20);
}

TEST(VoxelGrid, TheMessageAboutTooManyCubesSaysWhatWouldFit) {
  EXPECT_EQ(coarse_voxels_text(1.0, 2.14, {1200.0, 1000.0, 100.0}),
            "voxel_m is 2.14 m instead of 1 m: the map of 1200 x 1000 x 100 m would have 120 million cubes, and 16 "
            "million are the most; with voxel_m=1, a map of 400 x 400 x 100 m fits");
}

TEST(VoxelGrid, TheOperationalVolumeHasTheSizeThatIsComputedForIt) {
  const OrientedBox box{.name = "", .center = {10.0, 0.0, 15.0}, .size = {20.0, 4.0, 30.0}};
  for (const double voxel_m : {1.0, 2.5, 6.0}) {
    const Vector3d size_m = operational_size({box}, {}, voxel_m, 0.0, voxel_m);
    const VoxelGrid::Cell dims = (size_m / voxel_m).array().ceil().cast<int>();
    EXPECT_EQ(operational_volume({box}, {}, voxel_m, 0.0, voxel_m).dims(), dims);
  }
}

}  // namespace
}  // namespace skein::agent
