#include "uav_agent/planning/block_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

OrientedBox site(double yaw = 0.4) {
  OrientedBox box;
  box.center = {40.0, 30.0, 30.0};
  box.size = {120.0, 90.0, 60.0};
  box.R_WO = rotation_z(yaw);
  return box;
}

AgentConfig named_fleet(std::size_t count, std::size_t self) {
  AgentConfig agent;
  agent.self = UavIndex(self);
  for (std::size_t i = 0; i < count; ++i) agent.fleet.push_back({.name = "uav" + std::to_string(i)});
  return agent;
}

/// The walls of a tower, as a LiDAR would have seen them.
OccupancyMap map_of_tower(const Vector3d& centre, const Vector3d& size) {
  std::vector<Eigen::Vector3f> hits;
  for (double z = 0.6; z < size.z(); z += 0.4) {
    for (double u = -0.5; u <= 0.5; u += 0.02) {
      for (const double side : {-0.5, 0.5}) {
        hits.push_back(Vector3d(centre.x() + u * size.x(), centre.y() + side * size.y(), z).cast<float>());
        hits.push_back(Vector3d(centre.x() + side * size.x(), centre.y() + u * size.y(), z).cast<float>());
      }
    }
  }
  OccupancyMap map;
  map.insert(hits, std::nullopt);
  return map;
}

/// All tasks, in the order in which they come.
std::vector<BlockWork::Task> all_tasks(BlockWork& work, const OccupancyMap& map) {
  std::vector<BlockWork::Task> tasks;
  while (tasks.size() < 1000) {
    const auto task = work.next(0, {0.0, 0.0, 30.0}, map);
    if (!task || task->flown > 0) break;
    tasks.push_back(*task);
    work.flown(*task);
  }
  return tasks;
}

TEST(BlockWork, TakesOnlySiteBoxes) {
  OrientedBox tower = site();
  tower.size = {30.0, 28.0, 120.0};
  OrientedBox podium = site();
  podium.size = {64.0, 52.0, 17.0};
  const AgentConfig agent = named_fleet(1, 0);
  const CameraReach reach;
  EXPECT_FALSE(is_site_box(tower) || is_site_box(podium));
  EXPECT_TRUE(is_site_box(site()));
  EXPECT_FALSE(BlockWork({}, agent, reach, {tower, podium}).any());
  EXPECT_TRUE(BlockWork({}, agent, reach, {tower, site()}).any());
}

TEST(BlockWork, ThereIsNothingToDoWhereTheMapShowsNothing) {
  const AgentConfig agent = named_fleet(1, 0);
  const CameraReach reach;
  BlockWork work({}, agent, reach, {site()});
  EXPECT_FALSE(work.next(0, Vector3d::Zero(), OccupancyMap()));
}

TEST(BlockWork, StripsRunAlongTheStructure) {
  const AgentConfig agent = named_fleet(1, 0);
  const CameraReach reach;
  BlockWork work({}, agent, reach, {site()});
  const Vector3d centre(45.0, 35.0, 0.0), size(20.0, 16.0, 40.0);
  const auto tasks = all_tasks(work, map_of_tower(centre, size));
  ASSERT_GT(tasks.size(), 20U);
  for (const auto& task : tasks) {
    // A block is turned against the tower: its corner is at most this far off.
    const Vector3d middle = 0.5 * (task.strip.begin_W + task.strip.end_W) - centre;
    EXPECT_LT(std::abs(middle.x()), 0.5 * size.x() + 6.0);
    EXPECT_LT(std::abs(middle.y()), 0.5 * size.y() + 6.0);
    EXPECT_LE(task.strip.length(), 16.0);
  }
  // Every side is looked at.
  for (const Vector3d& side : {Vector3d::UnitX().eval(), Vector3d::UnitY().eval()}) {
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(std::any_of(tasks.begin(), tasks.end(),
                              [&](const auto& task) { return sign * task.strip.out_W.dot(side) > 0.85; }));
    }
  }
}

TEST(BlockWork, BlocksAreDealtOutEvenly) {
  for (const std::size_t uavs : {1U, 2U, 3U, 5U, 8U}) {
    std::vector<int> shares(uavs);
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 9; ++y) {
        for (int z = 0; z < 5; ++z) ++shares.at(block_owner({x, y, z}, uavs));
      }
    }
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    EXPECT_LT(*most - *least, 20) << uavs;
  }
}

TEST(BlockWork, AFailedTaskIsTriedAgainLater) {
  const AgentConfig agent = named_fleet(1, 0);
  const CameraReach reach;
  BlockWork work({}, agent, reach, {site()});
  const OccupancyMap map = map_of_tower({45.0, 35.0, 0.0}, {20.0, 16.0, 40.0});
  std::set<BlockWork::Key> failed;
  for (auto task = work.next(0, Vector3d::Zero(), map); task; task = work.next(0, Vector3d::Zero(), map)) {
    EXPECT_TRUE(failed.insert(task->key).second) << "a failed task does not come again at once";
    work.failed(*task, 0);
  }
  EXPECT_GT(failed.size(), 20U);
  EXPECT_TRUE(work.next(ticks(60.0), Vector3d::Zero(), map)) << "but after a while";
}

}  // namespace
}  // namespace skein::agent
