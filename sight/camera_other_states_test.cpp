// What pictures from other states of the body would have shown, as if the UAV's position were exact or the air still.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random_stream.hpp"
#include "sight/camera.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// A wall at x = 5 with a grid of points.
class OtherStatesOfACamera : public testing::Test {
 protected:
  OtherStatesOfACamera() {
    test::add_box(mesh_, {5.5, 0.0, 10.0}, {1.0, 8.0, 8.0});
    for (int row = -15; row <= 15; ++row) {
      for (int column = -15; column <= 15; ++column) {
        const float y = 0.25F * static_cast<float>(column), z = 10.0F + 0.25F * static_cast<float>(row);
        points_.push_back({{5.0F, y, z}, {-1.0F, 0.0F, 0.0F}});
      }
    }
  }
  /// Before the wall, in motion.
  RigidBodyState drawn_body() {
    RigidBodyState body;
    body.p_WB = test::random_in_box(random_, {-8.0, -4.0, 7.0}, {2.0, 4.0, 13.0});
    body.q_WB = test::rotation(0.0, 0.0, random_.uniform(-0.5, 0.5));
    body.v_WB = test::random_in_box(random_, {-2.0, -2.0, -1.0}, {2.0, 2.0, 1.0});
    return body;
  }
  Camera camera() const {
    return {CameraConfig{}, 2.0, RulesConfig{}, points_, UavIndex{}, {.vibration_deg_s = 20.0}, 7};
  }

  RandomStream random_{5, "camera_other_states_test", 0, 0};
  TriangleMesh mesh_;
  std::vector<InterestPoint> points_;
};

TEST_F(OtherStatesOfACamera, ShowWhatACameraThereShowsAndChangeNothing) {
  const RayScene world(mesh_);
  Camera with_other = camera(), alone = camera();
  std::vector<float> best_if(points_.size(), 0.0F);
  for (int shot = 0; shot < 40; ++shot) {
    const RigidBodyState body = drawn_body();
    RigidBodyState other = body;
    other.p_WB += test::random_in_box(random_, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    other.v_WB *= random_.uniform();
    Camera there = alone;  // it shakes as the camera does at this picture
    const Capture expected = alone.capture(shot, body, {}, world);
    const Capture capture = with_other.capture(shot, body, {}, world, {.exact = {}, .calm = other});
    ASSERT_EQ(capture.detections.size(), expected.detections.size());
    for (std::size_t i = 0; i < capture.detections.size(); ++i) {
      EXPECT_EQ(capture.detections[i].point, expected.detections[i].point);
      EXPECT_EQ(capture.detections[i].q, expected.detections[i].q);
    }
    for (const Detection& detection : there.capture(shot, other, {}, world).detections) {
      const auto q = static_cast<float>(detection.q);
      if (q > alone.best()[detection.point]) best_if[detection.point] = std::max(best_if[detection.point], q);
    }
  }
  EXPECT_EQ(with_other.best(), alone.best());
  EXPECT_EQ(with_other.seen(), alone.seen());
  EXPECT_EQ(with_other.best_if_calm(), best_if);
  EXPECT_TRUE(with_other.best_if_exact().empty());
  EXPECT_GT(std::ranges::count_if(best_if, [](float q) { return q > 0.0F; }), 100);
}

}  // namespace
}  // namespace skein::sim
