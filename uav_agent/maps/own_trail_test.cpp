#include "uav_agent/maps/own_trail.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/random_stream.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

constexpr double kTrailCellM = 0.5;
constexpr Tick kTrailExchange = 20;

/// UAV 1 is the one with the trail; UAVs 0 and 2 have a LiDAR, UAV 3 has none.
AgentConfig trail_fleet() {
  AgentConfig config;
  config.self = UavIndex(1);
  config.fleet.resize(4);
  config.fleet[3].role = Role::photographer;
  return config;
}

Vector3d middle_of(const Eigen::Vector3i& cube) {
  return (cube.cast<double>() + Vector3d::Constant(0.5)) * kTrailCellM;
}
Eigen::Vector3i cube_at(const Vector3d& p_W) { return (p_W / kTrailCellM).array().floor().cast<int>(); }

class OwnTrailTest : public testing::Test {
 protected:
  void exchange(const Vector3d& p_W, const std::vector<unsigned>& heard) {
    now_ += kTrailExchange;
    std::vector<Neighbour> neighbours;
    for (const unsigned uav : heard) neighbours.push_back({node_of_uav(UavIndex(uav)), {50.0, 0.0, 10.0}});
    peers_.update(now_, neighbours);
    trail_.update(now_, peers_, p_W);
    places_W_.push_back(p_W);
  }
  /// Flies between drawn places.
  void fly(int exchanges, const std::vector<unsigned>& heard) {
    for (int i = 0; i < exchanges; ++i) {
      if (i % 40 == 0)
        v_W_ = random_.uniform(0.0, 5.0) * Vector3d(random_.normal(), random_.normal(), 0.3).normalized();
      exchange(p_W_ += v_W_ * 0.05, heard);
    }
  }
  double distance_m(const Vector3d& p_W) const {
    const auto off_m = [&](const Vector3d& place_W) { return (p_W - place_W).norm(); };
    return off_m(*std::ranges::min_element(places_W_, {}, off_m));
  }
  /// Cubes about drawn places of the flight.
  std::vector<Eigen::Vector3i> cubes_about_flight(double radius_m) {
    std::vector<Eigen::Vector3i> cubes;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d place_W = places_W_[static_cast<std::size_t>(random_.uniform() * 0.999 * places_W_.size())];
      const Vector3d off_W(random_.normal(), random_.normal(), random_.normal());
      cubes.push_back(cube_at(place_W + radius_m * random_.uniform() * off_W.normalized()));
    }
    return cubes;
  }

  RandomStream random_{3, "own_trail", 0};
  OwnTrail trail_{trail_fleet(), kTrailCellM};
  Peers peers_{trail_fleet()};
  std::vector<Vector3d> places_W_;
  Vector3d p_W_ = {3.0, -7.0, 12.0}, v_W_ = Vector3d::Zero();
  Tick now_ = 0;
};

TEST_F(OwnTrailTest, ContainsWhatALidarMayHaveSeenOfTheBodyAndNothingFarther) {
  const double body_m = trail_fleet().me().body_radius_m;
  fly(600, {0, 3});  // UAV 2 is not heard
  int within = 0, beyond = 0;
  for (const Eigen::Vector3i& cube : cubes_about_flight(3.0)) {
    const double off_m = distance_m(middle_of(cube));
    if (off_m < body_m + 0.5) {
      EXPECT_TRUE(trail_.contains(cube)) << off_m;
    } else if (off_m > body_m + 0.8) {
      EXPECT_FALSE(trail_.contains(cube)) << off_m;
    }
    ++(off_m < body_m + 0.5 ? within : beyond);
  }
  EXPECT_GT(within, 200);
  EXPECT_GT(beyond, 200);
}

TEST_F(OwnTrailTest, ContainsOnlyTheCurrentPlaceWhileAllUavsWithALidarAreHeard) {
  fly(600, {0, 2});  // UAV 3, which is not heard, has no LiDAR
  for (const Eigen::Vector3i& cube : cubes_about_flight(1.0)) {
    const double off_m = (middle_of(cube) - p_W_).norm();
    if (off_m > 1.5) {
      EXPECT_FALSE(trail_.contains(cube)) << off_m;
    }
  }
  EXPECT_TRUE(trail_.contains(cube_at(p_W_)));
}

TEST_F(OwnTrailTest, ForgetsPlacesOlderThanTwoParts) {
  fly(200, {});
  const Eigen::Vector3i there = cube_at(p_W_);
  const Tick left = now_;
  while (seconds(now_ - left) < OwnTrail::kPartS) exchange({500.0, 0.0, 10.0}, {0, 2});
  EXPECT_TRUE(trail_.contains(there));
  while (seconds(now_ - left) < 2.0 * OwnTrail::kPartS + 0.1) exchange({500.0, 0.0, 10.0}, {0, 2});
  EXPECT_FALSE(trail_.contains(there));
}

TEST_F(OwnTrailTest, AnImpossiblePositionIsLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double wrong : {1.01e5, -1.01e5, 1e300, kNan}) {
      Vector3d p_W(0.25, 0.25, 5.25);
      p_W[axis] = wrong;
      exchange(p_W, {});
      exchange({50.0, 50.0, 5.0}, {0, 2});              // all are heard: only what is marked stays in the trail
      p_W[axis] = std::abs(wrong) < 1e6 ? wrong : 0.0;  // a number of a cube, for each of them
      EXPECT_FALSE(trail_.contains(cube_at(p_W))) << axis << ": " << wrong;
    }
  }
}

/// Reports of another UAV change the map, except occupied cells in proved free space that are this UAV itself.
TEST_F(OwnTrailTest, TheMapIgnoresReportsOfThisUavOnly) {
  fly(100, {});
  for (int drawn = 0; drawn < 100; ++drawn) {
    WorldMap map{WorldMap::Config()};
    map.ignore_reports([&](const Eigen::Vector3i& cube) { return trail_.contains(cube); });
    const Eigen::Vector3i cube = cubes_about_flight(3.0).front();
    const bool free = random_.uniform() < 0.5, own_beam = random_.uniform() < 0.3;
    if (free) map.hear(shifted(cube, 1), 1, Space::free, 1);
    if (own_beam) {
      map.insert({}, std::vector<Eigen::Vector3f>{middle_of(cube).cast<float>()});
    } else {
      map.hear(cube, 0, Space::occupied, 2);
    }
    const bool ignored = free && !own_beam && trail_.contains(cube);
    EXPECT_EQ(map.known(cube).space == Space::occupied, !ignored);
    EXPECT_EQ(map.known(cube).space == Space::free, ignored);
  }
}

}  // namespace
}  // namespace skein::agent
