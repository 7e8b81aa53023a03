// Pictures from other states of the body: what they would have shown if the UAV had been where it believed to be, or
// without wind.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/math/random_stream.hpp"
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

TEST_F(OtherStatesOfACamera, ShowThePicturesOfACameraInThatStateAndChangeNothing) {
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

/// A camera remembers which points are near and what blocked each of them. Cameras that remember nothing see the same.
TEST(CameraMemory, ChangesNothingThatTheCameraSees) {
  RandomStream random(6, "camera_other_states_test", 0, 0);
  TriangleMesh mesh = test::random_triangles(150, 11);
  for (auto& vertex : mesh.vertices) vertex.z() += 25.0F;
  std::vector<InterestPoint> points;
  for (int i = 0; i < 2000; ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(i) % mesh.triangles.size()];
    const double u = random.uniform(), v = random.uniform() * (1.0 - u);
    const Vector3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                   c = mesh.vertices[t[2]].cast<double>();
    points.push_back({(a + u * (b - a) + v * (c - a)).cast<float>(), (b - a).cross(c - a).normalized().cast<float>()});
  }
  RayScene world(mesh, {body_shape(VehicleConfig{})});
  Camera camera(CameraConfig{}, 2.0, RulesConfig{}, points, UavIndex{1});
  const auto shown = [&](int shot, const RigidBodyState& body) {
    return Camera(CameraConfig{}, 2.0, RulesConfig{}, points, UavIndex{1}).capture(shot, body, {}, world).detections;
  };
  std::vector<float> best(points.size(), 0.0F), if_exact = best, if_calm = best;
  RigidBodyState body;
  body.p_WB = {-20.0, -20.0, 20.0};
  std::size_t detections = 0, hidden = 0;
  for (int shot = 0; shot < 300; ++shot) {
    body.p_WB += Vector3d(0.13, 0.13, 0.03) + test::random_in_box(random, {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    body.q_WB = test::rotation(0.0, 0.0, 0.02 * shot);
    world.set_pose(UavIndex{0}, Isometry3d(Eigen::Translation3d(body.p_WB + 4.0 * test::random_unit(random))));
    RigidBodyState exact = body, calm = body;
    exact.p_WB += test::random_in_box(random, {-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5});
    calm.p_WB += test::random_in_box(random, {-3.0, -3.0, -1.0}, {3.0, 3.0, 1.0});
    const std::vector<Detection> seen = camera.capture(shot, body, {}, world, {exact, calm}).detections;
    const std::vector<Detection> expected = shown(shot, body);
    ASSERT_EQ(seen.size(), expected.size()) << shot;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      ASSERT_EQ(seen[i].point, expected[i].point) << shot;
      ASSERT_EQ(seen[i].q, expected[i].q) << shot;
      best[seen[i].point] = std::max(best[seen[i].point], static_cast<float>(seen[i].q));
    }
    for (const auto& [other, best_if] : {std::pair(&exact, &if_exact), {&calm, &if_calm}}) {
      for (const Detection& detection : shown(shot, *other)) {
        const auto q = static_cast<float>(detection.q);
        if (q > best[detection.point]) (*best_if)[detection.point] = std::max((*best_if)[detection.point], q);
      }
    }
    detections += seen.size();
    for (const InterestPoint& point : points) {
      const Vector3d ray = point.p_W.cast<double>() - body.p_WB;
      hidden += ray.norm() < 15.0 && !in_sight(body.p_WB, point.p_W.cast<double>(), kNoUav, world);
    }
  }
  EXPECT_EQ(camera.best(), best);
  EXPECT_EQ(camera.best_if_exact(), if_exact);
  EXPECT_EQ(camera.best_if_calm(), if_calm);
  EXPECT_GT(detections, 1000U);
  EXPECT_GT(hidden, 1000U) << "there is something to remember";
}

}  // namespace
}  // namespace skein::sim
