#include "sim_server/viz/frames.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/math/random_stream.hpp"
#include "core/scoring/camera_quality.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "idl/conversions.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim::viz {
namespace {

/// The frames by child, as in tf2: each frame has one parent.
class Tree {
 public:
  void add(const msg::TFMessage& frames) {
    for (const msg::TransformStamped& frame : frames.transforms()) {
      const auto& p = frame.transform().translation();
      const auto& q = frame.transform().rotation();
      const Quaterniond R(q.w(), q.x(), q.y(), q.z());
      EXPECT_NEAR(R.norm(), 1.0, 1e-9);
      const bool fresh = edges_
                             .emplace(frame.child_frame_id(), std::pair(frame.header().frame_id(),
                                                                        Eigen::Translation3d(p.x(), p.y(), p.z()) * R))
                             .second;
      EXPECT_TRUE(fresh) << frame.child_frame_id() << " has two parents";
    }
  }
  Isometry3d in_world(const std::string& frame) const {
    if (frame == "world") return Isometry3d::Identity();
    const auto& [parent, X_PF] = edges_.at(frame);
    return in_world(parent) * X_PF;
  }
  std::size_t size() const { return edges_.size(); }

 private:
  std::map<std::string, std::pair<std::string, Isometry3d>> edges_;
};

TEST(Frames, TheFramesComposeToThePoseOfTheCamera) {
  Scenario scenario;
  scenario.fleet.resize(3);
  RandomStream random(1, "frames", 0);
  std::vector<UavView> views(scenario.fleet.size());
  for (int round = 0; round < 100; ++round) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      scenario.fleet[i].name = "uav" + std::to_string(i);
      scenario.fleet[i].vehicle.camera.p_BC = test::random_in_box(random, {-1, -1, -1}, {1, 1, 1});
      views[i].state.p_WB = test::random_in_box(random, {-50, -50, 0}, {50, 50, 60});
      views[i].state.q_WB =
          Quaterniond(test::rotation(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)));
      views[i].gimbal = {random.uniform(-1.4, 1.4), random.uniform(-1.5, 1.5), 0.0, 0.0};
    }
    const msg::TFMessage moving = moving_frames(7, scenario, views);
    for (const msg::TransformStamped& frame : moving.transforms()) EXPECT_EQ(frame.header().stamp(), to_time(7));
    Tree tree;
    tree.add(moving);
    tree.add(fixed_frames(scenario));
    ASSERT_EQ(tree.size(), 1 + 3 * views.size());
    EXPECT_TRUE(tree.in_world("gcs").translation().isApprox(scenario.station_position));
    for (std::size_t i = 0; i < views.size(); ++i) {
      const UavConfig& uav = scenario.fleet[i];
      const Isometry3d X_WC = camera_state(views[i].state, views[i].gimbal, uav.vehicle.camera).X_WC;
      EXPECT_TRUE(tree.in_world(uav.name + "/base_link").isApprox(views[i].state.X_WB(), 1e-9));
      EXPECT_TRUE(tree.in_world(uav.name + "/gimbal").isApprox(X_WC, 1e-9));
      EXPECT_TRUE(tree.in_world(uav.name + "/camera").isApprox(X_WC, 1e-9));
    }
  }
}

// A UAV's own tree contains the pose that the UAV receives, not the true one, and no other UAV.
TEST(OwnFrames, AUavsOwnFramesHaveThePosesThatItIsTold) {
  RandomStream random(2, "frames", 0);
  UavConfig uav;
  uav.name = "jurong";
  for (int round = 0; round < 100; ++round) {
    uav.vehicle.camera.p_BC = test::random_in_box(random, {-1, -1, -1}, {1, 1, 1});
    UavView view;
    view.state.p_WB = test::random_in_box(random, {-50, -50, 0}, {50, 50, 60});
    view.told.p_WB = view.state.p_WB + test::random_in_box(random, {1, 1, 1}, {2, 2, 2});
    view.told.q_WB = Quaterniond(test::rotation(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)));
    view.told_tick = random.uniform(0.0, 1.0) < 0.5 ? 5 : 7;
    view.gimbal = {random.uniform(-1.4, 1.4), random.uniform(-1.5, 1.5), 0.0, 0.0};
    const LidarServo servo{.tick = 6, .angle = random.uniform(-1.5, 1.5)};
    const msg::TFMessage moving = own_moving_frames(7, uav, view), lidar = own_lidar_frame(uav, servo);
    EXPECT_EQ(moving.transforms()[0].header().stamp(), to_time(view.told_tick));
    EXPECT_EQ(lidar.transforms()[0].header().stamp(), to_time(6));
    Tree tree;
    tree.add(moving);
    tree.add(lidar);
    tree.add(own_fixed_frames(uav));
    ASSERT_EQ(tree.size(), 5U);
    EXPECT_TRUE(tree.in_world("jurong/odom").isApprox(Isometry3d::Identity()));
    EXPECT_TRUE(tree.in_world("jurong/base_link").isApprox(view.told.X_WB(), 1e-9));
    EXPECT_TRUE(
        tree.in_world("jurong/camera").isApprox(camera_state(view.told, view.gimbal, uav.vehicle.camera).X_WC, 1e-9));
    EXPECT_TRUE(tree.in_world("jurong/lidar").isApprox(lidar_pose(view.told.X_WB(), servo.angle), 1e-9));
  }
}

}  // namespace
}  // namespace skein::sim::viz
