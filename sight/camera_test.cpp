// Compares what a capture sees with a brute-force computation, and checks what the camera remembers.
#include "sight/camera.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/scoring/camera_quality.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kDesired = 2.0;

/// Interest points spread over the triangles of a mesh, on their surface to single precision.
std::vector<InterestPoint> points_on(const TriangleMesh& mesh, std::size_t count, RandomStream& random) {
  std::vector<InterestPoint> points;
  while (points.size() < count) {
    const auto& t =
        mesh.triangles[static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.triangles.size()))];
    const Vector3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                   c = mesh.vertices[t[2]].cast<double>();
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    points.push_back({(a + u * (b - a) + v * (c - a)).cast<float>(), (b - a).cross(c - a).normalized().cast<float>()});
  }
  return points;
}

RigidBodyState random_state(RandomStream& random, const Vector3d& low, const Vector3d& high) {
  RigidBodyState body;
  body.p_WB = test::random_in_box(random, low, high);
  body.q_WB = test::rotation(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-3.1, 3.1));
  body.v_WB = test::random_in_box(random, {-2.0, -2.0, -1.0}, {2.0, 2.0, 1.0});
  return body;
}

/// Whether a capture must show a point, by the formulas and by a test of every triangle; `open`: undecided, because
/// rounding decides near an edge and at the tolerance.
enum class Verdict { hidden, seen, open };

Verdict judge(const InterestPoint& point, const CameraState& state, const TriangleMesh& mesh) {
  const Vector3d p_W = point.p_W.cast<double>();
  const Exposure exposure(state, CameraConfig{}, kDesired, ResolutionRule::contest);
  const PointQuality quality = exposure.evaluate(p_W, point.n_W.cast<double>());
  if (!quality.in_search_radius || !quality.in_fov || !quality.score || *quality.score < 0.2) {
    return Verdict::hidden;
  }
  const Vector3d ray = p_W - state.X_WC.translation();
  const double distance = ray.norm();
  const auto hit = test::brute_force_distance(mesh, {state.X_WC.translation(), ray / distance}, distance + 1.0, 1e-5);
  const double miss = std::abs(hit.distance - distance);
  if (hit.near_edge || std::abs(miss - Camera::kSurfaceTolerance) < 2.0 * hit.tolerance) {
    return Verdict::open;
  }
  return miss <= Camera::kSurfaceTolerance ? Verdict::seen : Verdict::hidden;
}

/// The brute-force computation has no ground. The generated meshes reach below z = 0, so the test lifts them.
TEST(Camera, DetectsThePointsThatBruteForceFinds) {
  RandomStream random(1, "camera_test", 0, 0);
  TriangleMesh mesh = test::random_triangles(150, 11);
  for (auto& vertex : mesh.vertices) {
    vertex.z() += 40.0F;
  }
  const std::vector<InterestPoint> points = points_on(mesh, 1500, random);
  const RayScene world(mesh);
  int seen = 0, hidden = 0, open = 0;
  for (int shot = 0; shot < 60; ++shot) {
    Camera camera(CameraConfig{}, kDesired, RulesConfig{}, points, UavIndex{});
    const RigidBodyState body = random_state(random, {-18.0, -18.0, 25.0}, {18.0, 18.0, 55.0});
    const GimbalState gimbal{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0, 0.0};
    const CameraState state = camera_state(body, gimbal, CameraConfig{});
    const Exposure exposure(state, CameraConfig{}, kDesired, ResolutionRule::contest);
    const Capture capture = camera.capture(0, body, gimbal, world);
    std::vector<bool> found(points.size(), false);
    for (const Detection& detection : capture.detections) {
      found[detection.point] = true;
      const auto& point = points[detection.point];
      const PointQuality quality = exposure.evaluate(point.p_W.cast<double>(), point.n_W.cast<double>());
      EXPECT_NEAR(detection.q, *quality.score, 1e-12);
      EXPECT_NEAR(detection.q, detection.q_blur * detection.q_res, 1e-12);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Verdict verdict = judge(points[i], state, mesh);
      if (verdict == Verdict::open) {
        ++open;
        continue;
      }
      EXPECT_EQ(found[i], verdict == Verdict::seen) << "shot " << shot << " point " << i;
      ++(verdict == Verdict::seen ? seen : hidden);
    }
  }
  EXPECT_GT(seen, 200);
  EXPECT_LT(open, seen / 10);
}

/// A wall at x = 5 with one point in the middle of the picture.
class CameraAtWall : public ::testing::Test {
 protected:
  CameraAtWall() {
    test::add_box(mesh_, {5.5, 0.0, 10.0}, {1.0, 8.0, 8.0});
    body_.p_WB = {0.0, 0.0, 10.0};
  }
  RayScene world() const { return RayScene(mesh_, std::vector<BodyShape>(2, body_shape(VehicleConfig{}))); }
  Camera camera() const { return Camera(CameraConfig{}, kDesired, rules_, points_, UavIndex{}); }

  TriangleMesh mesh_;
  std::vector<InterestPoint> points_ = {{{5.0F, 0.1F, 9.8F}, {-1.0F, 0.0F, 0.0F}}};
  RigidBodyState body_;
  RulesConfig rules_;
};

TEST_F(CameraAtWall, IsReadyOnlyAfterMoreThanTheInterval) {
  Camera c = camera();
  const RayScene w = world();
  EXPECT_TRUE(c.ready(0));
  c.capture(0, body_, {}, w);
  EXPECT_FALSE(c.ready(40)) << "exactly 0.1 s is not more than the interval";
  EXPECT_TRUE(c.ready(41));
  EXPECT_EQ(c.captures(), 1U);
  c.capture(41, body_, {}, w);
  EXPECT_EQ(c.captures(), 2U);
  EXPECT_FALSE(c.ready(81));
}

TEST_F(CameraAtWall, KeepsTheBestQualityOfAPoint) {
  Camera c = camera();
  const RayScene w = world();
  EXPECT_EQ(c.best(), std::vector<float>{0.0F});
  body_.v_WB = {0.0, 4.0, 0.0};
  const Capture blurred = c.capture(0, body_, {}, w);
  ASSERT_EQ(blurred.detections.size(), 1U);
  EXPECT_TRUE(blurred.improved());
  EXPECT_TRUE(blurred.detections[0].improved);
  EXPECT_LT(blurred.detections[0].q, 0.9);
  EXPECT_EQ(c.best()[0], static_cast<float>(blurred.detections[0].q));

  body_.v_WB = Vector3d::Zero();
  const Capture sharp = c.capture(41, body_, {}, w);
  EXPECT_EQ(sharp.detections[0].q, 1.0);
  EXPECT_TRUE(sharp.improved());

  body_.v_WB = {0.0, 4.0, 0.0};
  const Capture again = c.capture(82, body_, {}, w);
  ASSERT_EQ(again.detections.size(), 1U) << "the point is seen again, in no better quality";
  EXPECT_FALSE(again.improved());
  EXPECT_EQ(again.detections[0].best, 1.0F);
  EXPECT_EQ(again.detections[0].q, blurred.detections[0].q);
  EXPECT_EQ(c.best(), std::vector<float>{1.0F});
  body_.v_WB = Vector3d::Zero();
  EXPECT_FALSE(c.capture(123, body_, {}, w).improved()) << "equally good is not an improvement";
}

TEST_F(CameraAtWall, BlurredAndDistantPointsDoNotCount) {
  Camera c = camera();
  const RayScene w = world();
  body_.v_WB = {0.0, 40.0, 0.0};
  EXPECT_TRUE(c.capture(0, body_, {}, w).detections.empty());
  body_.v_WB = Vector3d::Zero();
  body_.p_WB.x() = -12.0;
  EXPECT_TRUE(c.capture(41, body_, {}, w).detections.empty()) << "beyond the search radius";
  body_.p_WB.x() = 0.0;
  EXPECT_TRUE(c.capture(82, body_, {0.0, 1.5, 0.0, 0.0}, w).detections.empty()) << "looks aside";
  EXPECT_EQ(c.best()[0], 0.0F);
}

TEST_F(CameraAtWall, RemembersPointsThatItSawTooPoorly) {
  points_.push_back({{5.0F, 0.5F, 9.8F}, {0.0F, 0.0F, 1.0F}});   // edge-on, or nearly
  points_.push_back({{5.3F, 0.3F, 9.8F}, {-1.0F, 0.0F, 0.0F}});  // behind the wall's surface
  Camera c = camera();
  const RayScene w = world();
  EXPECT_EQ(c.seen(), std::vector<bool>(3, false));
  EXPECT_TRUE(c.capture(0, body_, {0.0, 1.5, 0.0, 0.0}, w).detections.empty()) << "looks aside";
  EXPECT_EQ(c.seen(), std::vector<bool>(3, false));
  body_.v_WB = {0.0, 40.0, 0.0};
  EXPECT_TRUE(c.capture(41, body_, {}, w).detections.empty()) << "too blurred";
  EXPECT_EQ(c.seen(), (std::vector<bool>{true, true, false}));
  body_.v_WB = Vector3d::Zero();
  EXPECT_EQ(c.capture(82, body_, {}, w).detections.size(), 1U) << "a point that was seen too poorly is judged again";
  EXPECT_EQ(c.seen(), (std::vector<bool>{true, true, false}));
}

TEST_F(CameraAtWall, OtherUavsHideAPoint) {
  Camera c = camera();
  RayScene w = world();
  w.set_pose(UavIndex{0}, body_.X_WB());
  EXPECT_EQ(c.capture(0, body_, {}, w).detections.size(), 1U);
  w.set_pose(UavIndex{1}, Isometry3d(Eigen::Translation3d(2.5, 0.05, 9.75)));
  EXPECT_TRUE(c.capture(41, body_, {}, w).detections.empty());
}

TEST_F(CameraAtWall, ItsOwnRotorsHideWhatIsAbove) {
  mesh_ = {};
  test::add_box(mesh_, {0.0, 0.0, 15.5}, {30.0, 30.0, 1.0});  // a ceiling
  points_ = {{{2.5F, 1.5F, 15.0F}, {0.0F, 0.0F, -1.0F}}};
  RayScene w = world();
  w.set_pose(UavIndex{0}, body_.X_WB());
  const GimbalState up{-1.2, 0.0, 0.0, 0.0};
  rules_.own_body_hides = false;
  EXPECT_EQ(camera().capture(0, body_, up, w).detections.size(), 1U);
  rules_.own_body_hides = true;
  EXPECT_TRUE(camera().capture(0, body_, up, w).detections.empty());
  points_[0].p_W.x() = 6.0F;  // past the rotors
  EXPECT_EQ(camera().capture(0, body_, {-0.9, 0.0, 0.0, 0.0}, w).detections.size(), 1U);
}

TEST_F(CameraAtWall, IsBlindWhereStructureStandsBetweenItAndTheBody) {
  for (const double roof : {9.5, 9.71, 9.85, 9.99, 10.01, 10.2}) {  // the camera is at 9.7, the body's origin at 10
    TriangleMesh mesh = mesh_;
    test::add_box(mesh, {0.0, 0.0, roof}, {0.44, 0.44, 0.002});
    const RayScene w(mesh);
    const bool between = roof > 9.7 && roof < 10.0;
    rules_.camera_blind_in_structure = true;
    EXPECT_EQ(camera().capture(0, body_, {}, w).detections.empty(), between) << roof;
    rules_.camera_blind_in_structure = false;
    EXPECT_FALSE(camera().capture(0, body_, {}, w).detections.empty()) << roof;
  }
}

TEST_F(CameraAtWall, WithoutALeastScoreEachPointWithAnyQualityCounts) {
  body_.v_WB = {0.0, 40.0, 0.0};
  rules_.min_point_score = 0.0;
  const Capture capture = camera().capture(0, body_, {}, world());
  ASSERT_EQ(capture.detections.size(), 1U);
  EXPECT_GT(capture.detections[0].q, 0.0);
  EXPECT_LT(capture.detections[0].q, 0.2);
  points_[0].n_W = {0.0F, 0.0F, 1.0F};  // the wall seen edge-on: no quality at all
  points_[0].p_W.z() = 9.7F;
  EXPECT_TRUE(camera().capture(0, body_, {}, world()).detections.empty()) << "a point with a score of 0";
}

/// Share of the picture that the own body hides if it is level. The figures are the reference's, for its own shapes.
TEST(Camera, HidesAsMuchOfThePictureAsTheBodyOfTheReference) {
  struct Row {
    const char* vehicle;
    double yaw_deg;
    std::array<double, 4> percent;  ///< at pitches of -30, -45, -60 and -80 degrees (up)
  };
  constexpr std::array<double, 4> kPitchDeg = {-30.0, -45.0, -60.0, -80.0};
  const Row rows[] = {{"explorer", 0.0, {21, 42, 58, 69}},
                      {"explorer", 90.0, {30, 48, 64, 75}},
                      {"photographer", 0.0, {0, 0, 16, 32}},
                      {"photographer", 90.0, {7, 18, 26, 42}}};
  // The test draws rays within the picture, and counts those that hit the body.
  RandomStream random(5, "camera_test", 1);
  for (const Row& row : rows) {
    const VehicleConfig vehicle = load_vehicle(row.vehicle, source_path("config"));
    const CameraConfig& camera = vehicle.camera;
    RigidBodyState body;
    body.p_WB = {0.0, 0.0, 50.0};
    RayScene world(TriangleMesh{}, {body_shape(vehicle)});
    world.set_pose(UavIndex{0}, body.X_WB());
    for (std::size_t i = 0; i < kPitchDeg.size(); ++i) {
      const GimbalState gimbal{kPitchDeg[i] * kRadPerDeg, row.yaw_deg * kRadPerDeg, 0.0, 0.0};
      const Isometry3d X_WC = camera_state(body, gimbal, camera).X_WC;
      int hidden = 0;
      constexpr int kRays = 20'000;
      for (int n = 0; n < kRays; ++n) {
        const Vector3d in_picture(1.0, random.uniform(-1.0, 1.0) * std::tan(0.5 * camera.hfov_deg * kRadPerDeg),
                                  random.uniform(-1.0, 1.0) * std::tan(0.5 * camera.vfov_deg * kRadPerDeg));
        hidden += world.first_hit(X_WC.translation(), X_WC.linear() * in_picture, 3.0) ? 1 : 0;
      }
      EXPECT_NEAR(100.0 * hidden / kRays, row.percent[i], 5.0)
          << row.vehicle << " yaw " << row.yaw_deg << " pitch " << kPitchDeg[i];
    }
  }
}

/// Views of points of the public scene MBS, within 60 degrees of their normal and with nothing in between. Each point
/// is on its triangle to single precision. The reference's ray ends at the point, so it hits only 45 % of the points;
/// Skein's own test sees all.
TEST(Camera, RaysThatEndAtTheirPointMissMoreThanHalfOfThePoints) {
  const auto mesh = test::official_mesh("mbs/mbs.stl");
  const auto points = test::official_points("mbs/mbs_interest_points.pcd");
  if (!mesh || !points) {
    GTEST_SKIP() << "SKEIN_ASSETS is not set";
  }
  const RayScene world(*mesh);
  RandomStream random(7, "camera_test", 2);
  int free_views = 0, seen = 0;
  while (free_views < 20'000) {
    const auto& point = (*points)[static_cast<std::size_t>(random.uniform() * static_cast<double>(points->size()))];
    const Vector3d p_W = point.p_W.cast<double>(), direction = test::random_unit(random);
    const Vector3d p_WC = p_W + random.uniform(3.0, 7.0) * direction;
    const double clear_until = (p_W - p_WC).norm() - 2.0 * Camera::kSurfaceTolerance;
    if (std::abs(direction.dot(point.n_W.cast<double>())) < 0.5 || p_WC.z() < 0.0) continue;
    if (world.first_hit(p_WC, p_W - p_WC, clear_until) || !in_sight(p_WC, p_W, kNoUav, world)) continue;
    ++free_views;
    seen += in_sight_of_reference(p_WC, p_W, kNoUav, world);
  }
  EXPECT_NEAR(100.0 * seen / free_views, 45.0, 3.0);
}

TEST_F(CameraAtWall, TheReferenceNeedsASurfaceShortlyBeforeThePoint) {
  rules_.ray_ends_at_point = true;
  const auto seen_at = [&](float x) {
    points_ = {{{x, 0.1F, 9.8F}, {-1.0F, 0.0F, 0.0F}}};
    return !camera().capture(0, body_, {}, world()).detections.empty();
  };
  EXPECT_TRUE(seen_at(5.01F)) << "the wall is 1 cm before it";
  EXPECT_TRUE(seen_at(5.024F));
  EXPECT_FALSE(seen_at(5.03F));
  EXPECT_FALSE(seen_at(4.99F)) << "the wall is behind the point, where the ray does not reach";
}

TEST_F(CameraAtWall, PointWithoutSurfaceIsNeverSeen) {
  points_.push_back({{4.9F, 0.3F, 9.8F}, {-1.0F, 0.0F, 0.0F}});   // 10 cm before the wall
  points_.push_back({{5.1F, 0.3F, 9.8F}, {-1.0F, 0.0F, 0.0F}});   // behind its surface
  points_.push_back({{4.98F, 0.3F, 9.8F}, {-1.0F, 0.0F, 0.0F}});  // within the tolerance
  points_.push_back({{5.02F, 0.3F, 9.8F}, {-1.0F, 0.0F, 0.0F}});
  Camera c = camera();
  const Capture capture = c.capture(0, body_, {}, world());
  std::vector<std::uint32_t> seen;
  for (const Detection& detection : capture.detections) {
    seen.push_back(detection.point);
  }
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{0, 3, 4}));
}

TEST_F(CameraAtWall, TheGroundHidesPoints) {
  mesh_ = {};
  test::add_box(mesh_, {5.5, 0.0, 0.0}, {1.0, 8.0, 8.0});
  points_ = {{{5.0F, 0.0F, 0.5F}, {-1.0F, 0.0F, 0.0F}}, {{5.0F, 0.0F, -0.5F}, {-1.0F, 0.0F, 0.0F}}};
  body_.p_WB.z() = 2.0;
  Camera c = camera();
  const Capture capture = c.capture(0, body_, {}, world());
  ASSERT_EQ(capture.detections.size(), 1U);
  EXPECT_EQ(capture.detections[0].point, 0U);
}

/// Prints the CPU time of a capture during a flight that faces the structure, but sets no limit for it.
TEST(Camera, ACaptureOnMbsDetectsPointsAndPrintsItsCpuTime) {
  const auto mesh = test::official_mesh("mbs/mbs.stl");
  const auto points = test::official_points("mbs/mbs_interest_points.pcd");
  if (!mesh || !points) {
    GTEST_SKIP() << "SKEIN_ASSETS is not set";
  }
  const RayScene world(*mesh);
  Camera camera(CameraConfig{}, kDesired, RulesConfig{}, *points, UavIndex{});
  std::vector<RigidBodyState> states;
  for (std::size_t i = 0; i < points->size(); i += 5) {
    // Seven metres off a point, turned towards it.
    const InterestPoint& point = (*points)[i];
    const Vector3d n_W = point.n_W.cast<double>();
    RigidBodyState body;
    body.p_WB = point.p_W.cast<double>() + 7.0 * n_W + Vector3d(0.0, 0.0, 0.3);
    body.q_WB = rotation_z(std::atan2(-n_W.y(), -n_W.x()));
    if (std::abs(n_W.z()) < 0.3 && body.p_WB.z() > 0.5 && world.clearance(body.p_WB) > 3.0) {
      states.push_back(body);
    }
  }
  ASSERT_FALSE(states.empty());
  std::size_t detections = 0;
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i < states.size(); ++i) {
    detections += camera.capture(41 * static_cast<Tick>(i), states[i], {}, world).detections.size();
  }
  const double ms =
      1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(states.size());
  std::cout << "[ measured ] " << ms << " ms of CPU a capture, " << detections / states.size() << " points seen\n";
  RecordProperty("ms_per_capture", std::to_string(ms));
  EXPECT_GT(detections, 0U);
}

}  // namespace
}  // namespace skein::sim
