#include "uav_agent/flight_core/landing_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

AgentConfig fleet_at(const std::vector<Vector3d>& starts_W) {
  AgentConfig agent;
  for (const Vector3d& start_W : starts_W) agent.fleet.push_back({.name = "uav", .p_WB_start = start_W});
  return agent;
}

std::vector<Vector3d> places_W(AgentConfig agent, double apart_m) {
  std::vector<Vector3d> places;
  for (const UavIndex uav : FirstUavs(agent.fleet.size())) {
    agent.self = uav;
    places.push_back(landing_place_W(agent, apart_m));
  }
  return places;
}

TEST(LandingPlace, IsTheStartOfAUavThatStartsAlone) {
  const std::vector<Vector3d> starts_W = {{3, 4, 0}, {9, 4, 0}, {3, 20, 0}};
  EXPECT_EQ(places_W(fleet_at(starts_W), 2.5), starts_W);
}

/// Draws grids of up to 12 starts with offsets, as scenarios have them. All landing places are apart, and none is
/// farther from its start than necessary.
TEST(LandingPlace, IsApartFromThoseOfUavsThatStartNearby) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed, "landing_place", 0);
    const double apart_m = random.uniform(1.5, 4.0), spacing_m = random.uniform(1.0, 2.0);
    const int uavs = 2 + static_cast<int>(11.0 * random.uniform());
    std::vector<Vector3d> starts_W;
    for (int i = 0; i < uavs; ++i) {
      const Vector3d offset(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0);
      starts_W.push_back(Vector3d(-20.0 + spacing_m * (i % 4), 5.0 + spacing_m * (i / 4), 0.0) + offset);
    }
    starts_W.emplace_back(60.0, 5.0, 0.0);
    const std::vector<Vector3d> places = places_W(fleet_at(starts_W), apart_m);
    double closest_m = 100.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) closest_m = std::min(closest_m, (places[i] - places[j]).norm());
      EXPECT_LT((places[i] - starts_W[i]).norm(), apart_m / 0.8 * std::hypot(2.0, 2.0)) << seed;
      EXPECT_EQ(places[i].z(), 0.0);
    }
    EXPECT_GT(closest_m, std::min(apart_m, spacing_m) - 1e-9) << seed;
    EXPECT_GT(closest_m, apart_m - 1e-9) << seed;
    EXPECT_EQ(places.back(), starts_W.back()) << "no other UAV starts near it";
  }
}

TEST(LandingPlace, StaysFiniteWhereTwoUavsHaveTheSameStart) {
  for (const Vector3d& place_W : places_W(fleet_at({{1, 1, 0}, {1, 1, 0}, {2, 1, 0}}), 2.0)) {
    EXPECT_LT(place_W.norm(), 30.0);
  }
}

}  // namespace
}  // namespace skein::agent
