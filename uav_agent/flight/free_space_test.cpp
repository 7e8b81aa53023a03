#include "uav_agent/flight/free_space.hpp"

#include <gtest/gtest.h>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

OrientedBox unit_box() {
  OrientedBox box;
  box.center = {0.0, 0.0, 20.0};
  box.size = {10.0, 10.0, 10.0};
  return box;
}

/// A scan from 20 m above the box: it hits what `height` tells of each place, and its rays pass what is above.
OccupancyMap seen_from_above(double height) {
  OccupancyMap::Config config;
  config.max_free_rays = 100'000;
  OccupancyMap map(config);
  std::vector<Eigen::Vector3f> hits;
  for (double x = -12.0; x <= 12.0; x += 0.25) {
    for (double y = -12.0; y <= 12.0; y += 0.25) {
      hits.emplace_back(Eigen::Vector3d(x, y, height).cast<float>());
    }
  }
  map.insert(hits, Vector3d(0.0, 0.0, 45.0));
  return map;
}

TEST(FreeSpace, BesideABoxOnlyWhatWasSeenIsFree) {
  const std::vector<OrientedBox> boxes = {unit_box()};
  const OccupancyMap nothing;
  const FreeSpace space({.clearance_m = 1.8, .jut_m = 3.0}, boxes, nothing);
  const FreeSpace to_clearance({.clearance_m = 1.8, .jut_m = 0.0}, boxes, nothing);
  for (const double beyond : {0.5, 1.7, 1.9, 2.9, 3.1, 8.0}) {
    for (const Vector3d& out : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitZ())}) {
      const Vector3d p = boxes[0].center + (5.0 + beyond) * out;
      EXPECT_EQ(space.free(p), beyond > 3.0) << beyond;
      EXPECT_EQ(to_clearance.free(p), beyond > 1.8) << beyond;
    }
  }
}

TEST(FreeSpace, WhatRaysHavePassedMayBeEnteredUpToTheClearance) {
  const std::vector<OrientedBox> boxes = {unit_box()};
  const OccupancyMap map = seen_from_above(18.0);
  const FreeSpace space({.clearance_m = 1.8, .jut_m = 3.0}, boxes, map);
  EXPECT_TRUE(space.free({0.0, 0.0, 27.0})) << "beside the box";
  EXPECT_TRUE(space.free({0.0, 0.0, 24.0})) << "in it";
  EXPECT_FALSE(space.free({0.0, 0.0, 19.5})) << "too near to what was hit";
  EXPECT_FALSE(space.free({0.0, 0.0, 15.5})) << "behind it";
}

TEST(FreeSpace, WhoTriesToGetOutAgainAndAgainComesNoNearer) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream random(i, "way out", 0);
    const double clearance = random.uniform(1.0, 2.5), slack = random.uniform(0.05, 0.4);
    const double begin = random.uniform(0.1, clearance);
    double now = begin;
    for (int attempt = 0; attempt < 50; ++attempt) now = least_on_way_out_m(now, clearance, slack);
    EXPECT_GE(now, std::min(begin, 0.5 * clearance)) << "case " << i;
    EXPECT_LE(now, begin);
  }
}

}  // namespace
}  // namespace skein::agent
