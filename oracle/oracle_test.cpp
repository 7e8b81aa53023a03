// The oracle on scenes whose answers are known, against brute force, and on the official data.
#include "oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/euler.hpp"
#include "core/scoring/camera_quality.hpp"
#include "oracle/best_aim.hpp"
#include "sight/camera.hpp"
#include "sight/ray_shapes.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

Scenario photographer(double desired_mm_per_pixel) {
  Scenario scenario;
  scenario.desired_mm_per_pixel = desired_mm_per_pixel;
  scenario.fleet.resize(1);
  scenario.fleet[0].start = {-40.0, -40.0};
  return scenario;
}

InterestPoint point_at(const Vector3d& p_W, const Vector3d& n_W) { return {p_W.cast<float>(), n_W.cast<float>()}; }

OracleReport consult(const Scene& scene, double clearance, double desired = 2.0, std::size_t directions = 64) {
  return consult_oracle(photographer(desired), scene, {clearance, 2.5, directions, 1});
}

/// The level body whose gimbal turns the camera the rest of its heading.
Isometry3d body_pose(const VehicleConfig& vehicle, const PointView& view) {
  Isometry3d X_WB = Isometry3d::Identity();
  X_WB.linear() = rotation_z(view.yaw - view.gimbal_yaw);
  X_WB.translation() = view.p_WC - X_WB.linear() * vehicle.camera.p_BC;
  return X_WB;
}

/// Whether that body is in the way of a ray from its camera.
bool own_body_hides(const VehicleConfig& vehicle, const Isometry3d& X_WB, const Vector3d& p_WC, const Vector3d& p_W) {
  Body body(body_shape(vehicle));
  body.X_BW = X_WB.inverse();
  return body.distance({p_WC, (p_W - p_WC).normalized()}) < kInfinity;
}

bool arm_is_free(const VehicleConfig& vehicle, const PointView& view, const RayScene& world) {
  return !world.first_hit_distance(body_pose(vehicle, view).translation(), view.p_WC, {.ground = false});
}

/// A capture by the production camera from where the oracle says: the same point, the same quality.
double captured(const Scenario& scenario, const Scene& scene, const RayScene& world, std::size_t point,
                const PointView& view) {
  const VehicleConfig& vehicle = scenario.fleet[0].vehicle;
  RigidBodyState body;
  const Isometry3d X_WB = body_pose(vehicle, view);
  body.q_WB = Quaterniond(X_WB.linear());
  body.p_WB = X_WB.translation();
  Camera camera(vehicle.camera, scenario.desired_mm_per_pixel, scenario.rules, scene.points, UavIndex{});
  for (const Detection& seen : camera.capture(0, body, {view.pitch, view.gimbal_yaw, 0.0, 0.0}, world).detections) {
    if (seen.point == point) return seen.q;
  }
  return 0.0;
}

void expect_true(const Scenario& scenario, const Scene& scene, const OracleReport& report, double clearance,
                 Berth berth = Berth::camera) {
  const RayScene world(scene.mesh);
  for (const OracleAnswer* answer : {&report.reachable, &report.outside}) {
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const PointView& view = answer->best[i];
      if (view.q < scenario.rules.min_point_score) continue;
      EXPECT_NEAR(captured(scenario, scene, world, i, view), view.q, 1e-6) << i;
      const VehicleConfig& vehicle = scenario.fleet[0].vehicle;
      const Isometry3d X_WB = body_pose(vehicle, view);
      EXPECT_LE(std::abs(view.gimbal_yaw), vehicle.gimbal.yaw_limit_deg * kRadPerDeg) << i;
      EXPECT_FALSE(own_body_hides(vehicle, X_WB, view.p_WC, scene.points[i].p_W.cast<double>())) << i;
      EXPECT_TRUE(arm_is_free(vehicle, view, world)) << i;
      const Vector3d keeps_clear = berth == Berth::camera ? view.p_WC : X_WB.translation();
      EXPECT_GE(world.clearance(keeps_clear), clearance - 1e-9) << i;
      EXPECT_GE(view.p_WC.z(), 0.0) << i;
    }
  }
}

/// A thin wall, x from 5 to 5.1.
Scene wall(const Vector3d& normal) {
  Scene scene;
  test::add_box(scene.mesh, {5.05, 0.0, 10.0}, {0.1, 20.0, 18.0});
  for (const double y : {-3.0, 0.0, 4.0}) scene.points.push_back(point_at({5.0, y, 9.0 + y}, normal));
  return scene;
}

TEST(Oracle, AWallIsSeenFromItsOwnSideForBothSignsOfTheNormal) {
  for (const double sign : {-1.0, 1.0}) {
    const Scene scene = wall({sign, 0.0, 0.0});
    const OracleReport report = consult(scene, 0.5);
    EXPECT_EQ(report.reachable.attainable.points, 3u);
    EXPECT_DOUBLE_EQ(report.reachable.attainable.score, 3.0);
    EXPECT_DOUBLE_EQ(report.outside.attainable.score, 3.0);
    for (const PointView& view : report.reachable.best) EXPECT_LE(view.p_WC.x(), 4.5);
    expect_true(photographer(2.0), scene, report, 0.5);
  }
}

TEST(Oracle, AClearanceBeyondTheBestDistanceCostsQuality) {
  const Scene scene = wall({-1.0, 0.0, 0.0});
  const double distance = resolution_distance(CameraConfig{}, 1.0);
  const BestAim camera(CameraKind{}, 1.0, RulesConfig{});
  for (const double clearance : {1.6 * distance, 2.0 * distance}) {
    const OracleReport report = consult(scene, clearance, 1.0);
    // The best way to see a wall from a plane beside it: every direction tried.
    double best = 0.0;
    for (double y = -1.5; y <= 1.5; y += 0.02) {
      for (double z = -1.5; z <= 1.5; z += 0.02) {
        best = std::max(best, camera.find(clearance * Vector3d(1.0, y, z), -Vector3d::UnitX()).q);
      }
    }
    ASSERT_LT(best, 1.0);
    EXPECT_NEAR(report.reachable.best[1].q, best, 0.02 * best);
    expect_true(photographer(1.0), scene, report, clearance);
  }
}

/// A shaft of square section, 6 m deep, with points on its floor at z = 4.
Scene shaft(double width) {
  Scene scene;
  test::add_box(scene.mesh, {0.0, 0.0, 2.0}, {20.0, 20.0, 4.0});
  const double side = 0.5 * (20.0 - width);
  for (const double sign : {-1.0, 1.0}) {
    test::add_box(scene.mesh, {sign * 0.5 * (width + side), 0.0, 7.0}, {side, 20.0, 6.0});
    test::add_box(scene.mesh, {0.0, sign * 0.5 * (width + side), 7.0}, {width, side, 6.0});
  }
  for (const double x : {0.0, 0.1}) scene.points.push_back(point_at({x, 0.05, 4.0}, Vector3d::UnitZ()));
  return scene;
}

TEST(Oracle, APitIsSeenFromAboveWhereNothingFitsIn) {
  const Scene narrow = shaft(0.8), wide = shaft(3.0);
  const OracleReport from_above = consult(narrow, 0.5, 1.0), from_within = consult(wide, 0.5, 1.0);
  ASSERT_EQ(from_above.reachable.attainable.points, 2u);
  for (const PointView& view : from_above.reachable.best) {
    EXPECT_GE(view.p_WC.z(), 10.0);
    EXPECT_LT(view.q, 1.0);
    EXPECT_NEAR(view.q, resolution_distance(CameraConfig{}, 1.0) / (view.p_WC.z() - 4.0), 0.2);
  }
  EXPECT_DOUBLE_EQ(from_within.reachable.attainable.score, 2.0);
  // An opening of 3 m is a window: from outside the floor is seen from above only.
  for (const PointView& view : from_within.outside.best) EXPECT_GE(view.p_WC.z(), 8.5);
  EXPECT_LT(from_within.outside.attainable.score, 2.0);
  expect_true(photographer(1.0), narrow, from_above, 0.5);
  expect_true(photographer(1.0), wide, from_within, 0.5);
}

TEST(Oracle, APointInAClosedRoomCannotBeReached) {
  Scene scene;
  test::add_box(scene.mesh, {0.0, 0.0, 4.0}, {8.0, 8.0, 6.0});
  scene.points = {point_at({-4.0, 0.0, 4.0}, Vector3d::UnitX()), point_at({1.0, 2.0, 7.0}, Vector3d::UnitZ())};
  test::add_box(scene.mesh, {0.0, 0.0, 4.0}, {7.8, 7.8, 5.8});  // the walls' inner sides
  for (const double side : {-3.9, 3.9}) scene.points.push_back(point_at({side, 0.5, 4.0}, Vector3d::UnitX()));
  const OracleReport report = consult(scene, 0.5);
  EXPECT_DOUBLE_EQ(report.reachable.attainable.score, 2.0);
  EXPECT_EQ(report.reachable.best[2].q, 0.0);
  EXPECT_EQ(report.reachable.best[3].q, 0.0);
  // A fleet that starts on the ground below the room does not get in, either.
  Scenario inside = photographer(2.0);
  inside.fleet[0].start = {0.0, 0.0};
  test::add_box(scene.mesh, {0.0, 0.0, 4.0}, {7.8, 7.8, 5.8});
  EXPECT_EQ(consult_oracle(inside, scene, {0.5, 2.5, 32, 1}).reachable.best[2].q, 0.0) << "there is a floor";
}

/// Boxes of many sizes in each other's way, with points on their sides.
Scene clutter() {
  Scene scene;
  RandomStream random(1, "oracle_test", 0);
  for (int i = 0; i < 14; ++i) {
    const Vector3d centre = test::random_in_box(random, {-5.0, -5.0, 3.0}, {5.0, 5.0, 11.0});
    const Vector3d size = test::random_in_box(random, {0.4, 0.4, 0.4}, {5.0, 5.0, 4.0});
    test::add_box(scene.mesh, centre, size);
    for (int face = 0; face < 6; ++face) {
      Vector3d normal = Vector3d::Zero(), offset = test::random_in_box(random, -0.5 * size, 0.5 * size);
      normal[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
      offset[face / 2] = 0.5 * normal[face / 2] * size[face / 2];
      scene.points.push_back(point_at(centre + offset, normal));
    }
  }
  return scene;
}

TEST(Oracle, BruteForceFindsNothingBetter) {
  const Scene scene = clutter();
  const double clearance = 0.6;
  const Scenario scenario = photographer(1.0);
  const OracleReport report = consult_oracle(scenario, scene, {clearance, 2.5, 128, 2});
  expect_true(scenario, scene, report, clearance);
  const RayScene world(scene.mesh);
  std::vector<double> best(scene.points.size(), 0.0);
  RandomStream random(2, "oracle_test", 0);
  for (int i = 0; i < 4000; ++i) {
    const Vector3d p_WC = test::random_in_box(random, {-12.0, -12.0, 0.1}, {12.0, 12.0, 18.0});
    if (world.clearance(p_WC) < clearance) continue;
    // Inside a box there is no way.
    bool walled_in = true;
    for (const Vector3d& way : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0)}) {
      walled_in = walled_in && world.first_hit(p_WC, way, 50.0).has_value();
    }
    if (walled_in) continue;
    const VehicleConfig& vehicle = scenario.fleet[0].vehicle;
    const PointView view{p_WC, random.uniform(-3.14, 3.14), random.uniform(-1.39, 1.39),
                         0.0,  random.uniform(-1.57, 1.57), 0};
    const Isometry3d X_WB = body_pose(vehicle, view);
    CameraState state;
    state.X_WC.translation() = p_WC;
    state.X_WC.linear() = rotation_z(view.yaw) * rotation_y(view.pitch);
    const Exposure exposure(state, CameraConfig{}, 1.0, scenario.rules);
    for (std::size_t p = 0; p < scene.points.size(); ++p) {
      const Vector3d p_W = scene.points[p].p_W.cast<double>();
      const auto p_C = exposure.view(p_W);
      const auto score = p_C ? exposure.score(*p_C, scene.points[p].n_W.cast<double>()) : std::nullopt;
      if (!score || score->score() <= best[p] || own_body_hides(vehicle, X_WB, p_WC, p_W)) continue;
      if (in_sight(p_WC, p_W, kNoUav, world)) best[p] = score->score();
    }
  }
  int seen = 0;
  for (std::size_t p = 0; p < scene.points.size(); ++p) {
    if (best[p] > 0.0) ++seen;
    EXPECT_GE(report.reachable.best[p].q, best[p] - 0.02) << p;
  }
  EXPECT_GT(seen, 40);
}

TEST(Oracle, MoreClearanceNeverHelpsAndMoreDirectionsNeverHarm) {
  const Scene scene = clutter();
  Attainable before{scene.points.size(), static_cast<double>(scene.points.size())};
  for (const double clearance : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    const OracleReport report = consult(scene, clearance, 1.0);
    for (const OracleAnswer* answer : {&report.reachable, &report.outside}) {
      EXPECT_GE(answer->attainable.score, answer->coarse.score);
      EXPECT_GE(answer->attainable.points, answer->coarse.points);
    }
    EXPECT_GE(report.reachable.attainable.score, report.outside.attainable.score);
    // Refined viewpoints may differ a little, and so may the last half percent of the score.
    EXPECT_LE(report.reachable.attainable.score, 1.005 * before.score + 0.01) << clearance;
    EXPECT_LE(report.reachable.attainable.points, before.points) << clearance;
    before = report.reachable.attainable;
  }
}

TEST(Oracle, TheOwnBodyHidesAndIsTurnedOutOfTheWay) {
  const Scene scene = clutter();
  Scenario with = photographer(1.0), without = with;
  without.rules.own_body_hides = false;
  const OracleConfig config{0.5, 2.5, 64, 2};
  const OracleReport hidden = consult_oracle(with, scene, config), open = consult_oracle(without, scene, config);
  const VehicleConfig& vehicle = with.fleet[0].vehicle;
  int through_body = 0, turned = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const PointView& view = open.reachable.best[i];
    EXPECT_LE(hidden.reachable.best[i].q, view.q + 0.02) << i;
    if (view.q <= 0.0) continue;
    through_body +=
        own_body_hides(vehicle, body_pose(vehicle, view), view.p_WC, scene.points[i].p_W.cast<double>()) ? 1 : 0;
    turned += std::abs(hidden.reachable.best[i].gimbal_yaw) > 0.2 ? 1 : 0;
  }
  EXPECT_GT(through_body, 3) << "else this scene shows nothing";
  EXPECT_GT(turned, 0);
  expect_true(with, scene, hidden, config.clearance_m);
}

TEST(Oracle, NoCameraReachesThroughTheStructure) {
  const Scene scene = clutter();
  Scenario blind = photographer(1.0), sees = blind;
  sees.rules.camera_blind_in_structure = false;
  const OracleConfig config{0.05, 2.5, 64, 2};
  const RayScene world(scene.mesh);
  const OracleReport through = consult_oracle(sees, scene, config);
  int reached_through = 0;
  for (const PointView& view : through.reachable.best) {
    if (view.q > 0.0 && !arm_is_free(sees.fleet[0].vehicle, view, world)) ++reached_through;
  }
  EXPECT_GT(reached_through, 0) << "else this scene shows nothing";
  expect_true(blind, scene, consult_oracle(blind, scene, config), config.clearance_m);
}

/// The small hexarotor's body.
Scenario small_photographer(double desired_mm_per_pixel) {
  Scenario scenario = photographer(desired_mm_per_pixel);
  VehicleConfig& vehicle = scenario.fleet[0].vehicle;
  vehicle.arm_m = 0.2156;
  vehicle.rotor_radius_m = 0.1;
  vehicle.rotor_height_m = 0.037;
  vehicle.collision_box_m = {0.1, 0.1, 0.16};
  return scenario;
}

TEST(Oracle, AVehicleNeedsRoomForItself) {
  const Scene scene = shaft(1.0);
  OracleConfig config{0.0, 2.5, 64, 1};
  config.berth = Berth::body;
  // The large one is 1.27 m across and looks in from above, the small one is 0.64 m across and flies in.
  const Scenario large = photographer(1.0), small = small_photographer(1.0);
  const OracleReport from_above = consult_oracle(large, scene, config),
                     from_within = consult_oracle(small, scene, config);
  const auto radius = [](const Scenario& scenario) { return Body(body_shape(scenario.fleet[0].vehicle)).radius; };
  for (const PointView& view : from_above.reachable.best) {
    EXPECT_GE(body_pose(large.fleet[0].vehicle, view).translation().z(), 10.0);
    EXPECT_LT(view.q, 1.0);
  }
  EXPECT_DOUBLE_EQ(from_within.reachable.attainable.score, 2.0);
  expect_true(large, scene, from_above, radius(large), Berth::body);
  expect_true(small, scene, from_within, radius(small), Berth::body);
  expect_true(photographer(1.0), clutter(), consult_oracle(photographer(1.0), clutter(), config),
              radius(photographer(1.0)), Berth::body);
}

/// A room with a square window, and points on the wall beside it, two of them on its inner side.
Scene room_with_window(double width) {
  Scene scene;
  const double side = 0.5 * (6.0 - width);
  for (const double sign : {-1.0, 1.0}) {
    test::add_box(scene.mesh, {0.0, 0.0, 5.0 + sign * 3.1}, {6.4, 6.4, 0.2});
    test::add_box(scene.mesh, {0.0, sign * 3.1, 5.0}, {6.4, 0.2, 6.0});
    test::add_box(scene.mesh, {3.1, sign * 0.5 * (width + side), 5.0}, {0.2, side, 6.0});
    test::add_box(scene.mesh, {3.1, 0.0, 5.0 + sign * 0.5 * (width + side)}, {0.2, width, side});
  }
  test::add_box(scene.mesh, {-3.1, 0.0, 5.0}, {0.2, 6.4, 6.0});
  for (const double y : {-2.0, 2.0}) scene.points.push_back(point_at({3.0, y, 5.0}, Vector3d::UnitX()));
  scene.points.push_back(point_at({3.2, 2.0, 5.0}, Vector3d::UnitX()));
  return scene;
}

TEST(Oracle, APointThatOnlyACameraCanReachIsNotFlyable) {
  const auto flyable = [](const Scenario& scenario, double width) {
    const OracleReport report = consult_oracle(scenario, room_with_window(width), {0.3, 2.5, 64, 1});
    EXPECT_EQ(report.reachable.attainable.points, 3u) << "a camera fits through a window of 1.2 m";
    return report.flyable;
  };
  EXPECT_EQ(flyable(photographer(2.0), 1.2), (std::vector<std::uint8_t>{0, 0, 1}));
  EXPECT_EQ(flyable(photographer(2.0), 3.0), (std::vector<std::uint8_t>{1, 1, 1}));
  EXPECT_EQ(flyable(small_photographer(2.0), 1.2), (std::vector<std::uint8_t>{1, 1, 1}));
}

TEST(Oracle, TheAnswerDependsOnlyOnItsInputs) {
  const Scene scene = clutter();
  const OracleReport one = consult_oracle(photographer(1.0), scene, {0.5, 2.5, 32, 1});
  const OracleReport three = consult_oracle(photographer(1.0), scene, {0.5, 2.5, 32, 3});
  EXPECT_EQ(one.reachable.attainable.score, three.reachable.attainable.score);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    EXPECT_EQ(one.reachable.best[i].p_WC, three.reachable.best[i].p_WC);
    EXPECT_EQ(one.outside.best[i].q, three.outside.best[i].q);
  }
  EXPECT_THROW(consult_oracle(photographer(1.0), scene, {-1.0, 2.5, 32, 1}), std::invalid_argument);
  EXPECT_THROW(consult_oracle(photographer(1.0), scene, {0.5, 2.5, 0, 1}), std::invalid_argument);
}

/// All points; with a sanitizer only a share of them. All points would then take more than ten minutes, and a share
/// reveals the same mistakes in memory.
std::vector<InterestPoint> points_asked(const std::vector<InterestPoint>& points) {
  if (sanitizer().empty()) return points;
  constexpr std::size_t kShare = 20;
  std::vector<InterestPoint> some;
  for (std::size_t i = 0; i < points.size(); i += kShare) some.push_back(points[i]);
  return some;
}

/// @param points, score  found by another method in these scenes, with coarser sets of viewpoints. The oracle should
/// find a little more.
void expect_near(const Attainable& found, double points, double score) {
  if (!sanitizer().empty()) {
    EXPECT_GT(found.points, 0U);
    return;
  }
  EXPECT_GE(static_cast<double>(found.points), points);
  EXPECT_LE(static_cast<double>(found.points), 1.05 * points);
  EXPECT_GE(found.score, score);
  EXPECT_LE(found.score, 1.06 * score);
}

TEST(Oracle, OfficialScenesHaveNearlyTheScoresThatAnotherMethodFound) {
  const auto mbs = test::official_mesh("mbs/mbs.stl");
  if (!mbs) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const auto mbs_points = points_asked(*test::official_points("mbs/mbs_interest_points.pcd"));
  const OracleReport report = consult_oracle(photographer(2.0), {*mbs, mbs_points, {}}, {0.5, 2.5, 64, 2});
  expect_near(report.reachable.attainable, 3325, 3250);
  expect_near(report.outside.attainable, 2103, 1925);

  Scene crane{*test::official_mesh("crane/construction_crane_1.stl"),
              points_asked(*test::official_points("crane/crane_interest_points_on_meshes.pcd")),
              {}};
  const TriangleMesh second = *test::official_mesh("crane/construction_crane_2.stl");
  const auto offset = static_cast<std::uint32_t>(crane.mesh.vertices.size());
  crane.mesh.vertices.insert(crane.mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles) crane.mesh.triangles.push_back({a + offset, b + offset, c + offset});
  const OracleReport cranes = consult_oracle(photographer(1.5), crane, {0.5, 2.5, 64, 2});
  expect_near(cranes.reachable.attainable, 1299, 1273);
}

}  // namespace
}  // namespace skein::sim
