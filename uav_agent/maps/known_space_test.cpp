#include "uav_agent/maps/known_space.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <set>
#include <sstream>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kCellM = 0.5, kFreeCellM = 2.0;
const Vector3d kFarW = Vector3d::Constant(1000.0);

Vector3d drawn(RandomStream& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

/// Reads a file as any tool does that uses OctoMap.
std::unique_ptr<octomap::OcTree> read_back(const std::string& file) {
  std::istringstream in(file);
  auto tree = std::make_unique<octomap::OcTree>(0.1);
  EXPECT_TRUE(tree->readBinary(in));
  return tree;
}

enum class Known { nothing, free, occupied };

Known known_at(const octomap::OcTree& tree, const Vector3d& p_W) {
  const octomap::OcTreeNode* const node = tree.search(p_W.x(), p_W.y(), p_W.z());
  if (node == nullptr) return Known::nothing;
  return tree.isNodeOccupied(node) ? Known::occupied : Known::free;
}

Known known_at(const KnownSpace& space, const Vector3d& p_W, int rays) {
  if (space.hits().test(p_W)) return Known::occupied;
  return space.rays_at(p_W) >= rays ? Known::free : Known::nothing;
}

/// Some key frames: hits about the origin, rays to most of them from one place.
class DrawnSpace : public testing::TestWithParam<std::uint64_t> {
 protected:
  DrawnSpace() {
    for (int frame = 0; frame < 12; ++frame) {
      std::vector<Vector3d> ends_W;
      const Vector3d from_W = drawn(random_, 15.0);
      for (int i = 0; i < 60; ++i) {
        const Vector3d hit_W = drawn(random_, 25.0);
        space_.add_hit(hit_W);
        ends_W.push_back(from_W + 0.8 * (hit_W - from_W));
      }
      space_.add_rays(space_.passed_by_rays(from_W, ends_W));
    }
  }

  RandomStream random_{GetParam(), "known", 0};
  KnownSpace space_{kCellM, kFreeCellM};
};

TEST_P(DrawnSpace, IndexesHoldTheSameAsTheTrees) {
  HitBlocks hits(kCellM);
  space_.visit_hits(-kFarW, kFarW, [&](const Vector3d& p_W) {
    const Eigen::Vector3i cell = (p_W / kCellM).array().floor().cast<int>();
    hits.add(HitBlocks::block_of(cell), std::uint64_t{1} << HitBlocks::place_of(cell));
  });
  EXPECT_GT(hits.count(), 500U);
  EXPECT_EQ(space_.hits().count(), hits.count());
  EXPECT_TRUE(space_.hits() == hits);
  RayBlocks rays;
  std::set<int> counts;
  space_.visit_free([&](const RayBlocks::Cell& cell, int passed) {
    PassedCells one{{{RayBlocks::block_of(cell), {}}}};
    one.blocks.front().second[RayBlocks::place_of(cell)] = static_cast<std::uint8_t>(passed);
    rays.add(one, [](const RayBlocks::Cell&, int) {});
    counts.insert(passed);
  });
  EXPECT_TRUE(space_.rays() == rays);
  for (int passed = 1; passed <= 6; ++passed) EXPECT_TRUE(counts.contains(passed)) << passed;
}

TEST_P(DrawnSpace, HitsInABoxComeInTheOrderOfOctoMap) {
  const auto tree = read_back(space_.octomap_file(kCountedRays + 1));
  tree->expand();
  const auto point = [](const Vector3d& p_W) {
    const Eigen::Vector3f p = p_W.cast<float>();
    return octomap::point3d(p.x(), p.y(), p.z());
  };
  std::size_t seen = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d a_W = drawn(random_, 28.0), b_W = drawn(random_, 28.0);
    const Vector3d lowest_W = a_W.cwiseMin(b_W), highest_W = a_W.cwiseMax(b_W);
    std::vector<Vector3d> wanted, told;
    for (auto leaf = tree->begin_leafs_bbx(point(lowest_W), point(highest_W)); leaf != tree->end_leafs_bbx(); ++leaf) {
      wanted.push_back({leaf.getX(), leaf.getY(), leaf.getZ()});
    }
    space_.visit_hits(lowest_W, highest_W, [&](const Vector3d& p_W) { told.push_back(p_W); });
    ASSERT_EQ(told, wanted);
    seen += told.size();
  }
  EXPECT_GT(seen, 1000U);
}

TEST_P(DrawnSpace, OctoMapReadsTheSameSpaceFromTheFile) {
  for (const int rays : {1, 3, 6}) {
    const auto tree = read_back(space_.octomap_file(rays));
    EXPECT_EQ(tree->getResolution(), kCellM);
    int times[3] = {};
    for (int i = 0; i < 8000; ++i) {
      const Vector3d p_W = drawn(random_, 26.0);
      const Known known = known_at(space_, p_W, rays);
      ASSERT_EQ(known_at(*tree, p_W), known) << p_W.transpose() << ", " << rays;
      ++times[static_cast<int>(known)];
    }
    for (const int count : times) EXPECT_GT(count, 0);
    EXPECT_EQ(tree->size(), tree->calcNumNodes());
    const std::string bytes = space_.octomap_bytes(rays), file = space_.octomap_file(rays);
    EXPECT_TRUE(file.ends_with("\ndata\n" + bytes));
    tree->prune();
    std::ostringstream again;
    tree->writeBinaryConst(again);
    EXPECT_EQ(again.str(), file) << "OctoMap writes the same bytes, and has nothing to prune";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnSpace, testing::Range<std::uint64_t>(0, 5));

TEST(KnownSpace, HitsAreNeverUndoneAndRaysAreCountedOneByOne) {
  KnownSpace space(kCellM, kFreeCellM);
  const Vector3d hit_W(3.2, 0.7, 5.1);
  EXPECT_TRUE(space.add_hit(hit_W));
  for (int i = 1; i <= 100; ++i) {
    space.add_rays(space.passed_by_rays({-9.0, 0.7, 5.1}, {{15.0, 0.7, 5.1}}));
    ASSERT_EQ(space.rays_at(hit_W), std::min(i, kCountedRays));
    std::set<int> in_tree;
    space.visit_free([&](const RayBlocks::Cell&, int rays) { in_tree.insert(rays); });
    ASSERT_EQ(in_tree, std::set<int>{std::min(i, kCountedRays)});
  }
  EXPECT_TRUE(space.hits().test(hit_W));
  EXPECT_FALSE(space.add_hit(hit_W));
  const auto tree = read_back(space.octomap_file(kCountedRays));
  EXPECT_EQ(known_at(*tree, hit_W), Known::occupied);
  EXPECT_EQ(known_at(*tree, hit_W + Vector3d(0.0, 0.5, 0.0)), Known::free);
  EXPECT_EQ(known_at(*tree, hit_W + Vector3d(0.0, 0.0, 4.0)), Known::nothing);
}

TEST(KnownSpace, AFileIsAsSmallAsPossible) {
  KnownSpace space(kCellM, kFreeCellM);
  EXPECT_EQ(read_back(space.octomap_file(1))->size(), 0U);
  space.add_rays(space.passed_by_rays({0.5, 0.5, 0.5}, {{3.0, 0.5, 0.5}}));
  EXPECT_EQ(read_back(space.octomap_file(1))->size(), 15U) << "one leaf for the cube of 2 m, and the way to it";
  for (double x = 0.25; x < 1.0; x += 0.5) {
    for (double y = 0.25; y < 1.0; y += 0.5) {
      for (double z = 0.25; z < 1.0; z += 0.5) space.add_hit({x, y, z});
    }
  }
  EXPECT_EQ(read_back(space.octomap_file(1))->size(), 23U) << "eight cubes of 1 m, one of them occupied";
}

TEST(KnownSpace, AHitInFreeSpaceLeavesTheRestOfItFree) {
  KnownSpace space(kCellM, kFreeCellM);
  for (const double y : {1.0, 3.0}) {  // all eight coarse cells of a cube of 4 m
    for (const double z : {1.0, 3.0}) space.add_rays(space.passed_by_rays({0.5, y, z}, {{5.0, y, z}}));
  }
  const std::size_t before = read_back(space.octomap_file(1))->size();
  space.add_hit({2.2, 2.2, 2.2});
  const auto tree = read_back(space.octomap_file(1));
  EXPECT_GT(tree->size(), before);
  for (double x = 0.25; x < 4.0; x += 0.5) {
    for (double y = 0.25; y < 4.0; y += 0.5) {
      for (double z = 0.25; z < 4.0; z += 0.5) {
        const bool hit = x == 2.25 && y == 2.25 && z == 2.25;
        ASSERT_EQ(known_at(*tree, {x, y, z}), hit ? Known::occupied : Known::free) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(KnownSpace, NothingIsKnownBeyondTheTree) {
  KnownSpace space(kCellM, kFreeCellM);
  EXPECT_FALSE(space.add_hit({1e7, 0.0, 0.0}));
  EXPECT_EQ(space.rays_at({1e7, 0.0, 0.0}), 0);
}

}  // namespace
}  // namespace skein::agent
