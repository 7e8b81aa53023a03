#include "uav_agent/delivery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "uav_agent/survey.hpp"

namespace skein::agent {
namespace {

OrientedBox tower(double yaw = 0.0) {
  OrientedBox box;
  box.center = {10.0, 0.0, 20.0};
  box.size = {16.0, 30.0, 40.0};
  box.R_WO = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  return box;
}

AgentConfig fleet_of(std::size_t count, std::size_t self) {
  AgentConfig config;
  config.self = self;
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
    const auto places = delivery_places(fleet_of(5, self), space, 12.0);
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

TEST(DeliveryPlaces, AvoidWhatTheMapShows) {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> roof;  // over the station
  for (float x = -9.0F; x <= 7.0F; x += 0.4F) {
    for (float y = -8.0F; y <= 8.0F; y += 0.4F) roof.emplace_back(x, y, 6.0F);
  }
  map.insert(roof, std::nullopt);
  const std::vector<OrientedBox> boxes;
  const FreeSpace space({.clearance_m = 1.8}, boxes, map);
  for (const Vector3d& place : delivery_places(fleet_of(1, 0), space, 12.0)) {
    EXPECT_GT((place - Vector3d(-1.0, 0.0, 0.3)).head<2>().norm(), 8.0);
  }
}

TEST(TimeHome, GrowsWithDistanceAndLeavesTimeToSpare) {
  EXPECT_GT(time_home_s({0, 0, 0}, {45, 0, 0}, 4.5), 10.0);
  EXPECT_GT(time_home_s({0, 0, 0}, {90, 0, 0}, 4.5), time_home_s({0, 0, 0}, {45, 0, 0}, 4.5));
}

TEST(SurveyRing, ExplorersShareTheWholeRingAtADistance) {
  for (const double yaw : {0.0, 0.4, 1.2}) {
    const std::vector<OrientedBox> boxes = {tower(yaw)};
    double angle = 0.0;
    for (std::size_t self = 0; self < 2; ++self) {
      const auto share = survey_ring(fleet_of(2, self), boxes, 10.0, 25.0);
      ASSERT_GT(share.size(), 4U);
      for (std::size_t i = 0; i < share.size(); ++i) {
        EXPECT_FALSE(boxes[0].contains(share[i], 9.9));
        EXPECT_TRUE(boxes[0].contains(share[i], 10.1));
        if (i == 0) continue;
        const Vector3d a = share[i - 1] - boxes[0].center, b = share[i] - boxes[0].center;
        angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
      }
    }
    EXPECT_NEAR(std::abs(angle), 2.0 * M_PI, 1e-6) << "together once around";
  }
}

TEST(SurveyRing, IsNothingForAPhotographerOrWithoutBoxes) {
  AgentConfig config = fleet_of(1, 0);
  EXPECT_TRUE(survey_ring(config, {}, 10.0, 25.0).empty());
  config.fleet[0].role = Role::photographer;
  EXPECT_TRUE(survey_ring(config, {tower()}, 10.0, 25.0).empty());
}

}  // namespace
}  // namespace skein::agent
