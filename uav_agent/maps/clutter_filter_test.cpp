#include "uav_agent/maps/clutter_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kScanS = 0.1;

struct Filtered {
  void scan(std::vector<Eigen::Vector3f> hits_W) {
    filter.keep_confirmed(time_s, p_WL, map, hits_W);
    map.insert({}, hits_W);
    filter.doubt_new(map);
    time_s += kScanS;
  }
  Space at(const Eigen::Vector3f& p_W) const { return map.at(p_W.cast<double>()); }
  bool doubted(const Eigen::Vector3f& p_W) const { return map.doubted(map.cube_of(p_W.cast<double>())); }

  Vector3d p_WL = Vector3d::Zero();
  WorldMap map{WorldMap::Config{}};
  ClutterFilter filter;
  double time_s = 0.0;
};

Eigen::Vector3f drawn_W(RandomStream& random, double reach_m) {
  const auto along = [&] { return static_cast<float>(random.uniform(-reach_m, reach_m)); };
  return {along(), along(), along()};
}

TEST(ClutterFilter, LoneReturnsRarelyMakeACubeOccupied) {
  RandomStream random(1, "clutter", 0);
  Filtered rain;
  std::size_t drops = 0;
  for (int scan = 0; scan < 600; ++scan) {
    std::vector<Eigen::Vector3f> hits_W;
    while (random.uniform() < 0.6) hits_W.push_back(drawn_W(random, 20.0));
    drops += hits_W.size();
    rain.scan(hits_W);
  }
  ASSERT_GT(drops, 500U);
  EXPECT_LE(rain.map.counts().occupied, 2U) << "of " << drops << " drops, hardly two fall into one cube within 2 s";
}

TEST(ClutterFilter, StructureIsCertainWithItsThirdReturnAndStays) {
  RandomStream random(2, "clutter", 0);
  Filtered wall;
  std::vector<Eigen::Vector3f> hits_W;
  for (int i = 0; i < 40; ++i) hits_W.emplace_back(7.25F, -10.0F + 0.5F * static_cast<float>(i), 3.25F);
  wall.scan(hits_W);
  for (const Eigen::Vector3f& hit_W : hits_W) EXPECT_EQ(wall.at(hit_W), Space::unknown) << "one return may be a drop";
  wall.scan(hits_W);
  for (const Eigen::Vector3f& hit_W : hits_W) {
    EXPECT_EQ(wall.at(hit_W), Space::occupied);
    EXPECT_TRUE(wall.doubted(hit_W));
  }
  wall.scan(hits_W);
  for (int scan = 0; scan < 100; ++scan) wall.scan({drawn_W(random, 20.0)});
  for (const Eigen::Vector3f& hit_W : hits_W) {
    EXPECT_EQ(wall.at(hit_W), Space::occupied);
    EXPECT_FALSE(wall.doubted(hit_W));
  }
}

TEST(ClutterFilter, ReturnsThatAreTooFarApartInTimeDoNotConfirmEachOther) {
  const Eigen::Vector3f p_W(9.0F, 2.0F, 1.0F);
  for (const double wait_s : {1.0, 1.9, 2.2, 60.0}) {
    Filtered drops;
    drops.scan({p_W});
    drops.time_s = wait_s;
    drops.scan({p_W});
    EXPECT_EQ(drops.at(p_W), wait_s < 2.0 ? Space::occupied : Space::unknown) << wait_s;
  }
}

/// The rule of the filter with a plain map of the returns, for a LiDAR at 0 and a map without structure.
struct PlainCount {
  bool keeps(double scan_s, const Eigen::Vector3f& hit_W, const WorldMap& map) {
    auto& [since_s, count] = returns.try_emplace(grid_key(map.cube_of(hit_W.cast<double>())), -1e9, 0).first->second;
    if (scan_s - since_s > 2.0) {
      since_s = scan_s;
      count = 0;
    }
    const double range_m = hit_W.cast<double>().norm();
    if (++count < (range_m >= 6.0 ? 2 : range_m >= 3.0 ? 3 : range_m >= 1.5 ? 5 : 8)) return false;
    since_s = scan_s;
    count = 0;
    return true;
  }

  std::map<std::uint64_t, std::pair<double, int>> returns;
};

TEST(ClutterFilter, CountsTheReturnsInEachCube) {
  constexpr double kGroundM = 0.3;
  RandomStream random(4, "clutter", 0);
  const WorldMap map(WorldMap::Config{.ground_m = kGroundM});
  ClutterFilter filter;
  PlainCount plain;
  std::size_t kept = 0;
  for (int scan = 0; scan < 400; ++scan) {
    const double scan_s = kScanS * scan + (scan > 200 ? 1.75 : 0.0);
    std::vector<Eigen::Vector3f> hits_W, expected_W;
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3f hit_W = drawn_W(random, 8.0);
      const bool keeps = hit_W.z() >= 0.0F && plain.keeps(scan_s, hit_W, map);
      hits_W.push_back(hit_W);
      if (keeps) expected_W.push_back(hit_W);
    }
    filter.keep_confirmed(scan_s, Vector3d::Zero(), map, hits_W);
    ASSERT_EQ(hits_W, expected_W) << scan;
    kept += hits_W.size();
  }
  EXPECT_GT(kept, 1000U);
}

// As many drops as with the preset `harsh`, most of them close to a LiDAR that stands still. No beam passes the cubes.
TEST(ClutterFilter, ALidarThatStandsInRainIsNotClosedIn) {
  constexpr double kMeanM = 4.0, kLeastM = 0.5, kNearM = 3.0;
  constexpr int kDropsPerScan = 6;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    RandomStream random(seed, "clutter_stands", 0);
    Filtered rain;
    rain.p_WL = Vector3d(0.1, 0.2, 0.3);
    std::vector<Eigen::Vector3f> near_W;
    for (int scan = 0; scan < 3000; ++scan) {
      std::vector<Eigen::Vector3f> hits_W;
      for (int i = 0; i < kDropsPerScan; ++i) {
        const Vector3d direction = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        const double range_m = kLeastM - kMeanM * std::log(1.0 - random.uniform());
        hits_W.push_back((rain.p_WL + direction * range_m).cast<float>());
        if (range_m < kNearM) near_W.push_back(hits_W.back());
      }
      rain.scan(hits_W);
    }
    EXPECT_LE(rain.map.counts().occupied, 10U) << "of 18,000 drops, seed " << seed;
    std::set<std::uint64_t> near_cubes;
    for (const Eigen::Vector3f& p_W : near_W) {
      if (rain.at(p_W) == Space::occupied) near_cubes.insert(grid_key(rain.map.cube_of(p_W.cast<double>())));
    }
    EXPECT_LE(near_cubes.size(), 2U) << "seed " << seed;
  }
}

// Structure returns more beams the nearer it is: 2 cm of a pole, with 0.2 degrees between two beams of a ring.
TEST(ClutterFilter, APoleIsOnTheMapAfterFourScansAtAnyDistance) {
  for (const double range_m : {1.0, 1.6, 2.0, 4.0, 5.9, 6.1}) {
    Filtered pole;
    const auto beams = static_cast<int>(std::max(1.0, 0.02 / (range_m * 0.0035) + 1.0));
    const Eigen::Vector3f hit_W(static_cast<float>(range_m), 0.25F, 0.25F);
    const std::vector<Eigen::Vector3f> hits_W(static_cast<std::size_t>(beams), hit_W);
    for (int scan = 0; scan < 4; ++scan) pole.scan(hits_W);
    EXPECT_EQ(pole.at(hit_W), Space::occupied) << range_m;
  }
}

}  // namespace
}  // namespace skein::agent
