// Tests the best picture of each point for which no picture counts: compares it with all pictures of random flights,
// which the test judges by the formulas and with a ray for each point.
#include "sight/poor_pictures.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/scoring/camera_quality.hpp"
#include "sim_server/referee.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kFineResolution = 2.0;  ///< mm per pixel
constexpr UavIndex kPhotographer{1};     ///< no body of the scene belongs to it

/// A cloud of triangles with points on them, and cameras that tumble through it fast enough to blur most pictures.
class DrawnExposures {
 public:
  explicit DrawnExposures(std::uint64_t key) : random_(key, "poor_pictures_test", 0, 0), mesh_(cloud(key)) {
    for (std::size_t i = 0; i < 600; ++i) {
      const auto& t = mesh_.triangles[i % mesh_.triangles.size()];
      const double u = random_.uniform(), v = random_.uniform() * (1.0 - u);
      const Vector3d a = mesh_.vertices[t[0]].cast<double>(), b = mesh_.vertices[t[1]].cast<double>(),
                     c = mesh_.vertices[t[2]].cast<double>();
      points_.push_back(
          {(a + u * (b - a) + v * (c - a)).cast<float>(), (b - a).cross(c - a).normalized().cast<float>()});
    }
    rules_.camera_blind_in_structure = false;  // the reference below does not know this rule
  }
  const std::vector<InterestPoint>& points() const { return points_; }
  const RulesConfig& rules() const { return rules_; }
  const RayScene& world() const { return world_; }
  Camera camera() const { return {CameraConfig{}, kFineResolution, rules_, points_, kPhotographer}; }

  RigidBodyState body() {
    RigidBodyState body;
    body.p_WB = test::random_in_box(random_, {-15.0, -15.0, 25.0}, {15.0, 15.0, 55.0});
    body.q_WB = test::rotation(0.0, 0.0, random_.uniform(-3.1, 3.1));
    body.v_WB = test::random_in_box(random_, {-40.0, -40.0, -40.0}, {40.0, 40.0, 40.0});
    return body;
  }
  GimbalState gimbal() { return {random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), 0.0, 0.0}; }

  /// All points that a picture shows, with their qualities, as numbers in single precision.
  std::vector<PoorSight> shown(const RigidBodyState& body, const GimbalState& gimbal) const {
    const CameraState state = camera_state(body, gimbal, CameraConfig{});
    const Exposure exposure(state, CameraConfig{}, kFineResolution, rules_);
    std::vector<PoorSight> all;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const Vector3d p_W = points_[i].p_W.cast<double>();
      const auto p_C = exposure.view(p_W);
      const auto quality = p_C ? exposure.score(*p_C, points_[i].n_W.cast<double>()) : std::nullopt;
      if (!quality || !in_sight(exposure.position(), p_W, kPhotographer, world_)) continue;
      all.push_back({i, static_cast<float>(quality->score()), static_cast<float>(quality->q_blur),
                     static_cast<float>(quality->q_res), static_cast<float>(quality->q_distance)});
    }
    return all;
  }

 private:
  static TriangleMesh cloud(std::uint64_t key) {
    TriangleMesh mesh = test::random_triangles(60, key);
    for (auto& vertex : mesh.vertices) vertex.z() += 40.0F;
    return mesh;
  }

  RandomStream random_;
  TriangleMesh mesh_;
  RayScene world_{mesh_};
  std::vector<InterestPoint> points_;
  RulesConfig rules_;
};

TEST(PoorPictures, TheKeptPictureIsTheBestOfAllThatDoNotCount) {
  std::size_t known = 0, closed = 0;
  for (std::uint64_t key = 1; key <= 4; ++key) {
    DrawnExposures drawn(key);
    Referee referee(key, 2, drawn.points().size(), drawn.rules());
    std::vector<Camera> cameras(2, drawn.camera());
    std::map<std::uint32_t, PoorSight> best;  // of all pictures so far
    std::vector<bool> counted(drawn.points().size(), false);
    for (Tick tick = 0; tick < 60; ++tick) {
      const RigidBodyState body = drawn.body();
      const GimbalState gimbal = drawn.gimbal();
      const Capture capture = cameras[static_cast<std::size_t>(tick) % 2].capture(tick, body, gimbal, drawn.world(), {},
                                                                                  &referee.poor_pictures());
      referee.note_poor(capture);
      for (const PoorSight& sight : drawn.shown(body, gimbal)) {
        if (sight.q >= drawn.rules().min_point_score) counted[sight.point] = true;
        const auto [entry, first] = best.try_emplace(sight.point, sight);
        if (!first && sight.q > entry->second.q) entry->second = sight;
      }
      for (std::uint32_t i = 0; i < counted.size(); ++i) {
        const auto expected = counted[i] || !best.contains(i) ? std::nullopt : std::optional<PoorSight>(best.at(i));
        ASSERT_EQ(referee.poor_pictures().best(i), expected) << "tick " << tick << " point " << i;
        known += expected.has_value();
        closed += counted[i];
      }
    }
  }
  EXPECT_GT(known, 300U);
  EXPECT_GT(closed, 300U);
}

TEST(PoorPictures, KeepingPoorPicturesDoesNotChangeTheDetectionsOfACamera) {
  DrawnExposures drawn(9);
  Referee referee(9, 1, drawn.points().size(), drawn.rules());
  Camera alone = drawn.camera(), noting = drawn.camera();
  std::size_t poor = 0;
  for (Tick tick = 0; tick < 80; ++tick) {
    const RigidBodyState body = drawn.body();
    const GimbalState gimbal = drawn.gimbal();
    const Capture expected = alone.capture(tick, body, gimbal, drawn.world());
    const Capture capture = noting.capture(tick, body, gimbal, drawn.world(), {}, &referee.poor_pictures());
    referee.note_poor(capture);
    poor += capture.poor.size();
    EXPECT_TRUE(expected.poor.empty());
    ASSERT_EQ(capture.detections.size(), expected.detections.size()) << tick;
    for (std::size_t i = 0; i < expected.detections.size(); ++i) {
      EXPECT_EQ(capture.detections[i].point, expected.detections[i].point);
      EXPECT_EQ(capture.detections[i].q, expected.detections[i].q);
      EXPECT_EQ(capture.detections[i].improved, expected.detections[i].improved);
    }
    ASSERT_EQ(noting.seen(), alone.seen()) << tick;
    ASSERT_EQ(noting.best(), alone.best()) << tick;
  }
  EXPECT_GT(poor, 50U);
}

TEST(PoorPictures, OfEqualPicturesTheFirstStays) {
  PoorPictures pictures(3);
  EXPECT_EQ(pictures.best(1), std::nullopt);
  pictures.add({1, 0.0F, 0.0F, 0.5F, 0.75F});
  EXPECT_EQ(pictures.best(1), (PoorSight{1, 0.0F, 0.0F, 0.5F, 0.75F})) << "a quality of 0 is a picture, too";
  pictures.add({1, 0.125F, 0.25F, 0.5F, 0.75F});
  pictures.add({1, 0.125F, 0.5F, 0.25F, 0.75F});
  EXPECT_EQ(pictures.best(1), (PoorSight{1, 0.125F, 0.25F, 0.5F, 0.75F}));
  pictures.close(1);
  pictures.add({1, 0.1875F, 0.5F, 0.375F, 0.75F});
  EXPECT_EQ(pictures.best(1), std::nullopt) << "a picture of this point counted";
  EXPECT_EQ(pictures.best(0), std::nullopt);
}

}  // namespace
}  // namespace skein::sim
