// Cameras that fail, and the planner flock: what a UAV finds out about its camera, and that it announces views only
// while the camera works.
#include "uav_agent/planners/flock/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "core/math/random_stream.hpp"
#include "uav_agent/planners/flock/talk.hpp"
#include "uav_agent/planners/flock/views.hpp"
#include "uav_agent/planning/aiming.hpp"
#include "uav_agent/planning/strips.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"
#include "uav_agent/testing/three_uavs.hpp"

namespace skein::agent {
namespace {

constexpr Tick kCameraLook = kTicksPerSecond * 3 / 20;  ///< time between two looks

Vector3d camera_place(RandomStream& random) {
  return {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(2.0, 50.0)};
}

/// Tells a camera that it should show `count` new points from `at_W` for some looks.
void show_new_points(FlockCamera& camera, std::size_t count, int looks, const Vector3d& at_W, Tick& now,
                     std::size_t& next) {
  std::vector<std::size_t> points(count);
  std::iota(points.begin(), points.end(), next);
  next += count;
  for (int i = 0; i < looks; ++i) camera.expect(points, at_W, now += kCameraLook);
}

/// Points that stay hidden, moments in which nothing is in view, or one place that shows nothing: a camera that works
/// may have all of these.
TEST(FlockCamera, LittleEvidenceDoesNotProveAFailure) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "little_evidence", 0);
    FlockCamera camera;
    Tick now = 0;
    std::size_t next = 0;
    show_new_points(camera, 100, 400, camera_place(random), now, next);
    EXPECT_FALSE(camera.failed()) << "one place proves nothing";
    camera.hear(true, now);
    const std::vector<std::size_t> few = {1, 2, 3, 4, 5};
    for (int i = 0; i < 400; ++i) camera.expect(few, camera_place(random), now += kCameraLook);
    EXPECT_FALSE(camera.failed()) << "few points prove nothing";
    camera.hear(true, now);
    for (int i = 0; i < 200; ++i) show_new_points(camera, 10, 2, camera_place(random), now, next);
    EXPECT_FALSE(camera.failed()) << "points in view for a moment prove nothing";
    camera.hear(true, now);
    for (int i = 0; i < 100; ++i) {
      show_new_points(camera, 3, 10, camera_place(random), now, next);
      camera.hear(i % 2 == 0, now);
      EXPECT_FALSE(camera.failed()) << "it detects something now and then";
    }
  }
}

/// The planner notices a failed camera after a few places. The first detection proves that the camera works again.
TEST(FlockCamera, AFailureIsNoticedAndOneDetectionProvesThatItIsOver) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "found_out", 0);
    FlockCamera camera;
    Tick now = 0;
    std::size_t next = 0;
    for (int round = 0; round < 3; ++round) {
      for (std::uint64_t i = random.bits() % 20 + 1; i > 0; --i) {
        show_new_points(camera, 5, 4, camera_place(random), now, next);
        camera.hear(true, now);
        EXPECT_FALSE(camera.failed() || camera.in_doubt(now));
      }
      std::size_t places = 0;
      for (; !camera.failed() && places < 100; ++places) {
        show_new_points(camera, 1 + random.bits() % 5, 4, camera_place(random), now, next);
        camera.hear(false, now);
      }
      EXPECT_TRUE(camera.failed()) << "seed " << seed;
      EXPECT_TRUE(camera.in_doubt(now));
      EXPECT_GE(places, FlockCamera::kPlaces);
      EXPECT_LE(places, 40U);
      camera.hear(true, now);
      EXPECT_FALSE(camera.failed());
    }
  }
}

/// A photographer before a long wall with drawn interest points. It goes where its planner wants, at 4 m/s, and its
/// gimbal follows at once.
struct FlockAtLongWall : FlownUav {
  explicit FlockAtLongWall(std::uint64_t seed) : FlownUav(three_uavs(1), {-8.0, 0.0, 10.0}) {
    boxes = {make_box({4.0, 0.0, 10.0}, {12.0, 184.0, 20.0})};
    clear({-30.0, -100.0, 0.0}, {2.0, 100.0, 26.0});
    build({2.2, -90.0, 2.0}, {2.4, 90.0, 18.0});
    RandomStream random(seed, "long_wall", 0);
    for (std::uint32_t i = 0; i < 360; ++i) {
      const Vector3d p_W(2.2, random.uniform(-88.0, 88.0), random.uniform(4.0, 16.0));
      points.push_back({p_W.cast<float>(), 0.3, i, -Eigen::Vector3f::UnitX()});
    }
    planner = make_planner("flock", agent);
  }
  double sharp_m() const { return camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel).sharp_distance_m; }
  FlockSurfaces surfaces_of(const AgentConfig& uav) const {
    FlockSurfaces surfaces(flock, uav, boxes, sharp_m());
    for (int i = 0; i < 40; ++i) surfaces.look_at_map(map);
    return surfaces;
  }
  std::vector<DetectedPoint> picture() {
    const CameraState camera = camera_state(state, gimbal, agent.vehicle.camera);
    const Exposure exposure(camera, agent.vehicle.camera, agent.desired_mm_per_pixel, ResolutionRule::contest);
    std::vector<DetectedPoint> shown;
    for (DetectedPoint& point : points) {
      const auto p_C = exposure.view(point.p_W.cast<double>());
      const auto score = p_C ? exposure.score(*p_C, point.n_W.cast<double>()) : std::nullopt;
      if (!score || score->score() < 0.2 || camera.X_WC.translation().x() > 2.0) continue;
      point.score = std::max(point.score, score->score());
      shown.push_back(point);
    }
    return shown;
  }
  /// One exchange. In the first one, the planner gets all points, as after a restart of its program.
  PlannerOutput exchange(bool camera_works) {
    PlannerInput in = input();
    in.tracking.setpoint.p_WB = state.p_WB;
    navigator.update(in);
    const FreeSpace space = navigator.open_space(in);
    std::vector<DetectedPoint> detected;
    if (camera_works && k % 2 == 0) detected = k == 0 ? points : picture();
    in.space = &space;
    in.gimbal = gimbal;
    in.detected = detected;
    in.flight.working = true;
    in.flight.goal = goal;
    in.flight.on_way = on_way;
    PlannerOutput out = planner->plan(in);
    obey(out);
    ++k;
    return out;
  }
  void obey(const PlannerOutput& out) {
    if (out.goals && !out.goals->empty()) {
      const Goal& first = out.goals->front();
      on_way = on_way && goal == first.id;
      goal = first.id;
      way = first.way;
      if (const auto* aim = std::get_if<Vector3d>(&first.gimbal)) aim_W = *aim;
    }
    if (const auto* aim = std::get_if<Vector3d>(&out.gimbal)) aim_W = *aim;
    if (!way.empty()) {
      const Vector3d ahead = way.front().p_WB - state.p_WB;
      state.p_WB += ahead * std::min(1.0, 0.2 / std::max(ahead.norm(), 1e-9));
      if (ahead.norm() <= 0.2) {
        way.erase(way.begin());
        on_way = true;
        if (way.empty()) goal.reset();
      }
    }
    const Vector3d look = aim_W - state.p_WB;
    state.q_WB = Eigen::AngleAxisd(std::atan2(look.y(), look.x()), Vector3d::UnitZ());
    const GimbalCommand turn = aim_at(aim_W, state, agent.vehicle);
    gimbal.pitch = turn.pitch;
    gimbal.yaw = turn.yaw;
  }

  FlockConfig flock;
  std::vector<DetectedPoint> points;
  std::unique_ptr<Planner> planner;
  GimbalState gimbal;
  Vector3d aim_W = {2.2, 0.0, 10.0};
  std::optional<std::int64_t> goal;
  std::vector<Waypoint> way;
  bool on_way = false;
};

/// The points that a picture should show clearly are in the middle of it, and on this side of the wall.
TEST(FlockCamera, ClearPointsAreInTheMiddleOfThePicture) {
  FlockAtLongWall uav(1);
  FlockSurfaces surfaces = uav.surfaces_of(uav.agent);
  surfaces.detect(uav.points, {-4.0, 0.0, 10.0});
  RandomStream random(1, "clear_points", 0);
  std::size_t clear = 0;
  for (int i = 0; i < 30; ++i) {
    const double y = random.uniform(-80.0, 80.0), z = random.uniform(8.0, 14.0), off_m = random.uniform(4.0, 9.0);
    const Vector3d aim_W(2.2, y + random.uniform(-2.0, 2.0), z);
    const Exposure exposure = exposure_of({.p_WB = {2.2 - off_m, y, z}, .aim_W = aim_W}, uav.agent);
    for (const std::size_t point : surfaces.clear_points(exposure, 0)) {
      const FlockPoint& known = surfaces.points().all()[point];
      const PointQuality quality = exposure.evaluate(known.p_W, known.n_W);
      EXPECT_TRUE(quality.in_fov);
      EXPECT_GE(quality.score.value_or(0.0), 0.6);
      EXPECT_LT((known.p_W - aim_W).norm(), 0.8 * off_m + 2.0);
      ++clear;
    }
    const Exposure behind = exposure_of({.p_WB = {2.2 + off_m, y, z}, .aim_W = aim_W}, uav.agent);
    EXPECT_TRUE(surfaces.clear_points(behind, 0).empty());
    const Exposure below = exposure_of({.p_WB = {-1.8, y, 2.0}, .aim_W = {2.2, y, 14.0}}, uav.agent);
    EXPECT_TRUE(surfaces.clear_points(below, 0).empty()) << "the UAV's own body may hide them";
  }
  EXPECT_GT(clear, 30U);
}

/// When the planner notices that its camera has failed, it forgets the faces that it assumed to have photographed.
TEST(FlockCamera, PicturesOfAFailedCameraNoLongerCount) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    FlockAtLongWall uav(seed);
    FlockSurfaces surfaces = uav.surfaces_of(uav.agent);
    surfaces.detect(uav.points, {-4.0, 0.0, 10.0});
    const auto work = [&] {
      std::vector<std::tuple<std::uint32_t, double, double>> all;
      for (const FlockTarget& target : surfaces.targets(0)) all.emplace_back(target.id, target.points, target.have);
      return all;
    };
    const auto before = work();
    RandomStream random(seed, "taken_back", 0);
    for (int i = 0; i < 20; ++i) {
      const double y = random.uniform(-80.0, 80.0), off_m = random.uniform(4.0, 14.0);
      const Exposure exposure = exposure_of({.p_WB = {2.2 - off_m, y, 10.0}, .aim_W = {2.2, y, 10.0}}, uav.agent);
      for (std::uint64_t looks = random.bits() % 15; looks > 0; --looks) surfaces.look_at_picture(exposure, 0);
    }
    EXPECT_NE(work(), before);
    surfaces.forget_pictures();
    EXPECT_EQ(work(), before) << "seed " << seed;
    surfaces.detect(std::span(uav.points).first(1), {-4.0, 0.0, 10.0});
    for (VoxelGrid::Id id = 0; id < surfaces.grid().count(); ++id) {
      for (int face = 0; face < VoxelGrid::kFaces; ++face) ASSERT_FALSE(surfaces.grid().marked(id, face));
    }
  }
}

TEST(Flock, AUavStatesWhatItsUndeliveredCapturesHaveAdded) {
  FlockAtLongWall uav(1);
  PlannerOutput out;
  for (uav.undelivered = 1; uav.undelivered < 200; ++uav.undelivered) {
    out = uav.exchange(true);
    double added = 0.0;
    for (const DetectedPoint& point : uav.points) added += point.score;
    ASSERT_TRUE(out.stake);
    EXPECT_NEAR(out.stake->value, added, 1e-6);
  }
  EXPECT_GT(out.stake->value, 0.3 * 360.0 + 1.0) << "pictures have improved points";
  EXPECT_GT(out.stake->gain_per_s, 0.1);
  uav.undelivered = 0;
  EXPECT_EQ(uav.exchange(false).stake->value, 0.0);
}

/// A camera fails at a drawn time, and works again 30 s later. While the UAV knows of the failure, it leaves all work
/// to other UAVs, and waits away from the wall. Once the camera works again, the UAV claims views at once.
TEST(Flock, AViewIsClaimedOnlyByAUavThatCanTakeIt) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random(seed, "dead_camera", 0);
    const double dies_s = random.uniform(8.0, 14.0), works_s = dies_s + 30.0;
    FlockAtLongWall uav(seed);
    const AgentConfig other = three_uavs(2);
    FlockSurfaces theirs = uav.surfaces_of(other);
    FlockTalk hears({}, other);
    const FlockViews views(uav.flock, other, uav.sharp_m());
    const auto kept_from_others = [&](Tick now) {
      const FlockTargets open(theirs.targets(now), views.range_m());
      FlockTargets left = open;
      for (const auto& [sender, claims] : hears.claims(now)) views.count_claims(theirs, claims, left);
      double kept = 0.0;
      for (std::size_t i = 0; i < open.all().size(); ++i) kept += open.all()[i].open() - left.all()[i].open();
      return kept;
    };
    double before = 0.0, dead = 0.0, after = 0.0, off_m = 0.0;
    for (double t = 0.0; t < works_s + 3.0; t += 0.05) {
      const PlannerOutput out = uav.exchange(t < dies_s || t >= works_s);
      PlannerInput in = uav.input();
      in.radio = out.radio;
      hears.listen(in, theirs.grid(), theirs.points());
      if (out.radio.empty()) continue;
      const double kept = kept_from_others(in.tick);
      if (t < dies_s) before += kept;
      if (t > dies_s + 18.0 && t < works_s) dead += kept;
      if (t > works_s) after += kept;
      if (t < works_s) off_m = 2.2 - uav.state.p_WB.x();
    }
    EXPECT_GT(before, 1.0) << "seed " << seed;
    EXPECT_EQ(dead, 0.0) << "seed " << seed;
    EXPECT_GT(off_m, 1.2 * uav.sharp_m()) << "seed " << seed;
    EXPECT_GT(after, 0.5) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
