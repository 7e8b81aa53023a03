// The size of the messages of the planner flock. flock_test.cpp tests their content.
#include "uav_agent/planners/flock/talk.hpp"

#include <gtest/gtest.h>

#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/testing/three_uavs.hpp"

namespace skein::agent {
namespace {

/// A point for each of the most regions that a message may list.
std::vector<DetectedPoint> points_in_all_regions() {
  std::vector<DetectedPoint> points;
  for (std::uint32_t i = 0; i < FlockPoints::kMostRegions; ++i) {
    const Eigen::Vector3f region(static_cast<float>(i % 10), static_cast<float>(i / 10 % 10),
                                 static_cast<float>(i / 100));
    points.push_back({16.0F * region + Eigen::Vector3f::Constant(3.0F), 0.5, i, Eigen::Vector3f::UnitX()});
  }
  return points;
}

/// All regions of points, and a map with as many cubes as the configuration permits, for a UAV that knows none of it.
TEST(FlockTalk, TheLongestMessageFitsIntoAPayload) {
  const AgentConfig speaker = three_uavs(0), listener = three_uavs(1);
  const Peers of_speaker = all_in_sight(speaker), of_listener = all_in_sight(listener);
  VoxelGrid theirs(Isometry3d::Identity(), {200.0, 200.0, 50.0}, 1.0), ours = theirs;
  for (VoxelGrid::Id id = 0; id < 20'000; ++id) {
    theirs.raise(id, id % 2 == 0 ? VoxelState::free : VoxelState::occupied);
  }
  FlockPoints known, none;
  known.detect(points_in_all_regions(), Vector3d(100.0, 0.0, 0.0));
  ASSERT_EQ(known.all().size(), FlockPoints::kMostRegions);
  const OccupancyMap map;
  const std::vector<OrientedBox> boxes;
  const auto input = [&](std::uint64_t k, const Peers& seen, std::span<const RadioMessage> radio) {
    return PlannerInput{k, static_cast<Tick>(20 * k), {}, {}, {}, map, boxes, seen, {}, false, 0, {}, radio};
  };
  FlockTalk says({}, speaker), hears({}, listener);
  PlannerOutput request, reply;
  std::uint64_t k = 0;
  for (; k < 100 && request.radio.empty(); ++k) hears.speak(input(k, of_listener, {}), ours, none, {}, request);
  says.listen(input(k, of_speaker, request.radio), theirs, known);
  const FlockWord word{.claims = std::vector<FlockClaim>(FlockTalk::kMostClaims), .rate = 1.0};
  for (; k < 200 && reply.radio.empty(); ++k) says.speak(input(k, of_speaker, {}), theirs, known, word, reply);
  ASSERT_EQ(reply.radio.size(), 1U);
  hears.listen(input(k, of_listener, reply.radio), ours, none);
  EXPECT_EQ(ours.state(1), VoxelState::occupied);
  EXPECT_GT(none.all().size(), 100U);
}

}  // namespace
}  // namespace skein::agent
