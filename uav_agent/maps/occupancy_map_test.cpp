#include "uav_agent/maps/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

Vector3d random_point(RandomStream& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

/// Centres of the 0.5 m cells of the hits, without repetitions: what the map must know.
std::vector<Vector3d> cells_of(const std::vector<Eigen::Vector3f>& hits) {
  std::vector<Vector3d> cells;
  for (const Eigen::Vector3f& hit : hits) {
    const Vector3d cell = ((hit.cast<double>() / 0.5).array().floor() + 0.5).matrix() * 0.5;
    if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }
  return cells;
}

class OccupancyMapTest : public testing::Test {
 protected:
  OccupancyMapTest() {
    RandomStream random(7, "map", 0);
    for (int i = 0; i < 150; ++i) {
      const Vector3d p = random_point(random, 12.0) + Vector3d(0.0, 0.0, 20.0);
      hits_.push_back(p.cast<float>());
    }
    cells_ = cells_of(hits_);
    map_.insert(hits_, std::nullopt);
  }

  double brute_force_distance(const Vector3d& p) const {
    double best = 1e9;
    for (const Vector3d& cell : cells_) best = std::min(best, (cell - p).norm());
    return best;
  }
  double brute_force_distance(const Vector3d& a, const Vector3d& b) const {
    double best = 1e9;
    for (const Vector3d& cell : cells_) {
      const double t = std::clamp((cell - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      best = std::min(best, (cell - a - t * (b - a)).norm());
    }
    return best;
  }

  OccupancyMap map_;
  std::vector<Eigen::Vector3f> hits_;
  std::vector<Vector3d> cells_;
};

TEST_F(OccupancyMapTest, HoldsEveryHitOnce) {
  EXPECT_EQ(map_.occupied_cells(), cells_.size());
  for (const Eigen::Vector3f& hit : hits_) EXPECT_TRUE(map_.occupied(hit.cast<double>()));
  const auto revision = map_.revision();
  map_.insert(hits_, std::nullopt);
  EXPECT_EQ(map_.occupied_cells(), cells_.size());
  EXPECT_EQ(map_.revision(), revision) << "nothing changed";
}

TEST_F(OccupancyMapTest, DistancesAgreeWithBruteForce) {
  RandomStream random(7, "probe", 0);
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = random_point(random, 16.0) + Vector3d(0.0, 0.0, 20.0);
    const double radius = random.uniform(0.1, 5.0);
    const double truth = brute_force_distance(p);
    if (std::abs(truth - radius) < 1e-6) continue;
    EXPECT_EQ(map_.any_occupied_within(p, radius), truth < radius);
    const auto distance = map_.distance_to_occupied(p, radius);
    ASSERT_EQ(distance.has_value(), truth < radius);
    EXPECT_NEAR(distance.value_or(truth), truth, 1e-6);
  }
}

TEST_F(OccupancyMapTest, SegmentsAreNeverCalledClearWhenTheyAreNot) {
  RandomStream random(7, "segment", 0);
  int clear = 0, needlessly_blocked = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d a = random_point(random, 16.0) + Vector3d(0.0, 0.0, 20.0);
    const Vector3d b = a + random_point(random, 10.0);
    const double radius = random.uniform(0.2, 2.5);
    const double truth = brute_force_distance(a, b);
    const bool says_clear = map_.segment_clear(a, b, radius);
    EXPECT_TRUE(!says_clear || truth >= radius - 1e-9);
    clear += says_clear;
    needlessly_blocked += !says_clear && truth > 1.05 * radius;
  }
  EXPECT_GT(clear, 50);
  EXPECT_EQ(needlessly_blocked, 0) << "a few per cent on the safe side, no more";
}

TEST_F(OccupancyMapTest, VisitsTheCellsOfABoxAlwaysInTheSameOrder) {
  OrientedBox box;
  box.center = {2.0, 1.0, 20.0};
  box.size = {10.0, 8.0, 14.0};
  box.R_WO = Eigen::AngleAxisd(0.5, Vector3d::UnitZ()).toRotationMatrix();
  OccupancyMap backwards;
  backwards.insert({hits_.rbegin(), hits_.rend()}, std::nullopt);
  std::vector<Vector3d> first, second;
  map_.visit_occupied(box, [&](const Vector3d& p) { first.push_back(p); });
  backwards.visit_occupied(box, [&](const Vector3d& p) { second.push_back(p); });
  EXPECT_EQ(first, second);
  const auto inside = std::count_if(cells_.begin(), cells_.end(), [&](const Vector3d& c) { return box.contains(c); });
  EXPECT_EQ(first.size(), static_cast<std::size_t>(inside));
}

TEST(OccupancyMap, RaysMarkFreeSpaceUpToWhatTheyHit) {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> wall;  // at x = 12, seen from the origin at height 10
  for (float y = -8.0F; y <= 8.0F; y += 0.4F) {
    for (float z = 2.0F; z <= 18.0F; z += 0.4F) wall.emplace_back(12.0F, y, z);
  }
  map.insert(wall, Vector3d(0.0, 0.0, 10.0));
  EXPECT_TRUE(map.known_free({4.0, 0.0, 10.0}));
  EXPECT_TRUE(map.known_free({8.0, 3.0, 12.0}));
  EXPECT_FALSE(map.known_free({12.0, 0.0, 10.0})) << "there is the wall";
  EXPECT_FALSE(map.known_free({16.0, 0.0, 10.0})) << "behind the wall";
  EXPECT_FALSE(map.known_free({4.0, 15.0, 10.0})) << "no ray passed there";
}

TEST(OccupancyMap, TheGroundEndsRaysButIsNoObstacle) {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> ground;
  for (float x = -4.0F; x <= 4.0F; x += 0.3F) {
    for (float y = -4.0F; y <= 4.0F; y += 0.3F) ground.emplace_back(x, y, 0.0F);
  }
  map.insert(ground, Vector3d(0.0, 0.0, 8.0));
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(map.known_free({0.0, 0.0, 5.0}));
}

/// The map of a UAV that took scans at random places.
OccupancyMap drawn_map(std::uint64_t seed) {
  RandomStream random(seed, "seen", 0);
  OccupancyMap map;
  for (int frame = 0; frame < 8; ++frame) {
    std::vector<Eigen::Vector3f> hits;
    const Vector3d about = random_point(random, 10.0) + Vector3d(0.0, 0.0, 20.0);
    for (int i = 0; i < 80; ++i) hits.push_back((about + random_point(random, 12.0)).cast<float>());
    map.insert(hits, about);
  }
  return map;
}

TEST(OccupancyMap, AHeardMapIsAddedButItsFreeSpaceIsNotProof) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const OccupancyMap own = drawn_map(2 * seed), other = drawn_map(2 * seed + 1);
    OccupancyMap both = drawn_map(2 * seed);
    const std::string told = other.octomap_bytes();
    const auto revision = both.revision();
    ASSERT_TRUE(both.hear(told));
    EXPECT_EQ(both.revision(), revision + 1);
    RandomStream random(seed, "asked", 0);
    int free_by_word = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vector3d p = random_point(random, 22.0) + Vector3d(0.0, 0.0, 20.0);
      const bool occupied = own.occupied(p) || other.occupied(p);
      ASSERT_EQ(both.occupied(p), occupied);
      ASSERT_EQ(both.known_free(p), !occupied && (own.known_free(p) || other.known_free(p)));
      ASSERT_EQ(both.known_free(p, 12), !occupied && own.known_free(p, 12)) << "a report is not proof";
      free_by_word += both.known_free(p) && !own.known_free(p) ? 1 : 0;
    }
    EXPECT_GT(free_by_word, 50);
    const std::string whole = both.octomap_bytes();
    ASSERT_TRUE(both.hear(told));
    EXPECT_EQ(both.octomap_bytes(), whole) << "the same again is not news";
    EXPECT_EQ(both.revision(), revision + 1);
  }
}

TEST(OccupancyMap, DamagedReportsAreRefused) {
  OccupancyMap map = drawn_map(1);
  const std::string told = drawn_map(2).octomap_bytes(), before = map.octomap_bytes(1);
  RandomStream random(1, "cut", 0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(map.hear(told.substr(0, 1 + random.bits() % (told.size() - 1))));
  }
  EXPECT_FALSE(map.hear(told + "x"));
  EXPECT_FALSE(map.hear(std::string("\x01\x00", 2))) << "an eighth of the world";
  EXPECT_EQ(map.octomap_bytes(1), before);
}

TEST(OccupancyMap, AnEmptyMapKnowsNothing) {
  const OccupancyMap map;
  EXPECT_TRUE(map.empty());
  EXPECT_FALSE(map.occupied(Vector3d::Zero()));
  EXPECT_FALSE(map.known_free(Vector3d::Zero()));
  EXPECT_TRUE(map.segment_clear(Vector3d::Zero(), Vector3d(1.0, 2.0, 3.0), 5.0));
}

}  // namespace
}  // namespace skein::agent
