// The directions in which a body hides the view of its own camera, compared with rays traced against the body as a part
// of the world.
#include "sight/camera_mount.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/euler.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

CameraKind large() { return {CameraConfig{}, GimbalConfig{}, body_shape(VehicleConfig{})}; }

TEST(CameraMount, HidesTheSameRaysAsABodyInTheWorld) {
  RandomStream random(1, "camera_mount_test", 0);
  const CameraKind kind = large();
  const CameraMount mount(kind, true), glass(kind, false);
  RayScene world(TriangleMesh{}, {kind.body});
  int hidden = 0, split = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d ray = test::random_unit(random), p_WC = test::random_in_box(random, {-9, -9, 5}, {9, 9, 20});
    const BodyHeadings headings = mount.clear_headings(ray);
    const std::size_t k = random.bits() % BodyHeadings::kCount;
    const double yaw = headings.yaw(k);
    Isometry3d X_WB = Isometry3d::Identity();
    X_WB.linear() = rotation_z(yaw);
    X_WB.translation() = mount.body_centre(p_WC, yaw);
    EXPECT_TRUE((X_WB * kind.camera.p_BC).isApprox(p_WC, 1e-12));
    world.set_pose(UavIndex{0}, X_WB);
    const bool met = world.first_hit(p_WC, ray, 5.0, {.ground = false}).has_value();
    EXPECT_EQ(headings.allowed[k], !met) << ray.transpose() << ", " << yaw;
    EXPECT_TRUE(glass.clear_headings(ray).allowed.all());
    hidden += met ? 1 : 0;
    EXPECT_TRUE(ray.z() > 0.0 || headings.allowed.all());
    split += headings.allowed.any() && !headings.allowed.all() ? 1 : 0;
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(split, 100) << "rays for which the body can be turned out of the way";
}

TEST(CameraMount, TurnsTheGimbalNoMoreThanNecessary) {
  RandomStream random(2, "camera_mount_test", 0);
  CameraKind kind = large();
  kind.gimbal.yaw_limit_deg = 50.0;
  const CameraMount mount(kind, true);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    BodyHeadings headings{random.uniform(-3.1, 3.1), {}};
    for (std::size_t k = 0; k < BodyHeadings::kCount; ++k) headings.allowed[k] = random.uniform() < 0.06;
    const double camera_yaw = random.uniform(-3.1, 3.1);
    double least = 50.0 * kRadPerDeg;
    bool any = false;
    for (std::size_t k = 0; k < BodyHeadings::kCount; ++k) {
      const double turn = std::abs(wrap_angle(camera_yaw - headings.yaw(k)));
      if (!headings.allowed[k] || turn > least) continue;
      any = true;
      least = turn;
    }
    const auto nearest = mount.nearest_heading(headings, camera_yaw);
    ASSERT_EQ(nearest.has_value(), any);
    if (nearest) {
      EXPECT_NEAR(std::abs(wrap_angle(camera_yaw - headings.yaw(*nearest))), least, 1e-12);
    }
    refused += any ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

TEST(CameraMount, EveryPartFixedToTheBodyHides) {
  VehicleConfig vehicle;
  vehicle.links.push_back(
      {.name = "tank", .p_BL = {0.5, 0.0, -0.5}, .box_m = Vector3d(0.1, 0.1, 0.1)});  // before the camera
  const CameraMount mount({vehicle.camera, vehicle.gimbal, body_shape(vehicle)}, true);
  const Vector3d ray = Vector3d(0.3, 0.0, -0.2).normalized();  // down, from the camera to it
  EXPECT_FALSE(mount.clear_headings(ray).allowed[0]) << "the ray's own azimuth";
  EXPECT_TRUE(mount.clear_headings(ray).allowed.any());
}

TEST(CameraKind, EqualCamerasOfAFleetAreListedOnce) {
  Scenario scenario;
  scenario.fleet.resize(6);
  scenario.fleet[1].vehicle.camera.exposure_s = 0.5;  // has no influence on a camera that stands still
  scenario.fleet[2].vehicle.camera.focal_length_m = 0.03;
  scenario.fleet[3].vehicle.gimbal.pitch_limit_deg = 20.0;
  scenario.fleet[4].vehicle.rotor_radius_m = 0.1;
  scenario.fleet[5].vehicle.links.push_back(
      {.name = "tank", .p_BL = {0.3, 0.0, -0.5}, .box_m = Vector3d(0.1, 0.1, 0.1)});
  const std::vector<CameraKind> kinds = camera_kinds(scenario);
  ASSERT_EQ(kinds.size(), 5u);
  EXPECT_EQ(kinds[1].camera.focal_length_m, 0.03);
  EXPECT_EQ(kinds[2].gimbal.pitch_limit_deg, 20.0);
}

}  // namespace
}  // namespace skein::sim
