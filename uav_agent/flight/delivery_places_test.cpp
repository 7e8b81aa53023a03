#include "uav_agent/flight/delivery_places.hpp"

#include <gtest/gtest.h>

#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

OrientedBox tower() { return make_box({10.0, 0.0, 20.0}, {16.0, 30.0, 40.0}); }

AgentConfig fleet_beside_station(std::size_t count, std::size_t self) {
  AgentConfig config;
  config.self = UavIndex(self);
  config.fleet.resize(count);
  config.station_position = {-1.0, 0.0, 0.3};
  return config;
}

TEST(DeliveryPlaces, SeeTheStationAndAreApart) {
  const std::vector<OrientedBox> boxes = {tower()};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  std::vector<Vector3d> best;
  for (std::size_t self = 0; self < 5; ++self) {
    const auto places = delivery_places(fleet_beside_station(5, self), space, 12.0);
    ASSERT_FALSE(places.empty());
    for (const Vector3d& place : places) {
      EXPECT_TRUE(space.free(place));
      EXPECT_TRUE(space.sees(place, {-1.0, 0.0, 0.3}, 0.5));
      EXPECT_GE(place.z(), 12.0);
    }
    for (const Vector3d& other : best) EXPECT_GT((places.front() - other).norm(), 2.9);
    best.push_back(places.front());
  }
}

TEST(DeliveryPlaces, StayLowInLargeFleets) {
  const std::vector<OrientedBox> boxes = {tower()};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  for (const std::size_t self : {8U, 60U, 127U}) {
    const auto places = delivery_places(fleet_beside_station(128, self), space, 12.0);
    ASSERT_FALSE(places.empty()) << self;
    for (const Vector3d& place : places) EXPECT_LT(place.z(), 40.0) << self;
  }
}

TEST(DeliveryPlaces, LieAboveAStationOnARoof) {
  const std::vector<OrientedBox> boxes = {tower()};
  const OccupancyMap map;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  AgentConfig agent = fleet_beside_station(3, 1);
  for (const double station_m : {0.3, 8.0, 41.0, 60.0}) {
    agent.station_position = {10.0, 0.0, station_m};
    if (station_m < 40.0) agent.station_position = {-4.0, 0.0, station_m};  // beside the tower, not in it
    const auto places = delivery_places(agent, space, 12.0);
    ASSERT_FALSE(places.empty()) << station_m;
    for (const Vector3d& place : places) EXPECT_GT(place.z(), station_m + 1.0);
  }
}

TEST(DeliveryPlaces, AvoidWhatTheMapShows) {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> roof;  // over the station
  for (float x = -9.0F; x <= 7.0F; x += 0.4F) {
    for (float y = -8.0F; y <= 8.0F; y += 0.4F) roof.emplace_back(x, y, 6.0F);
  }
  map.insert(roof, std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  const auto places = delivery_places(fleet_beside_station(1, 0), space, 12.0);
  ASSERT_FALSE(places.empty());
  for (const Vector3d& place : places) EXPECT_GT((place - Vector3d(-1.0, 0.0, 0.3)).head<2>().norm(), 8.0);
}

TEST(TimeHome, GrowsWithDistanceAndLeavesTimeToSpare) {
  EXPECT_GT(time_home_s({0, 0, 0}, {45, 0, 0}, 4.5), 10.0);
  EXPECT_GT(time_home_s({0, 0, 0}, {90, 0, 0}, 4.5), time_home_s({0, 0, 0}, {45, 0, 0}, 4.5));
}

}  // namespace
}  // namespace skein::agent
