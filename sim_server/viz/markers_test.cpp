#include "sim_server/viz/markers.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/math/random_stream.hpp"
#include "core/scoring/camera_quality.hpp"
#include "idl/conversions.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim::viz {
namespace {

constexpr std::size_t kUavs = 4;
constexpr int kRounds = 100;

Vector3d xyz(const msg::Point& p) { return {p.x(), p.y(), p.z()}; }

/// UAVs of both roles, each with an attitude and a gimbal of its own; the first is out.
class Markers : public testing::Test {
 protected:
  Markers() {
    for (std::size_t i = 0; i < kUavs; ++i) {
      UavConfig uav;
      uav.name = "uav" + std::to_string(i);
      uav.vehicle.role = i % 2 == 0 ? Role::explorer : Role::photographer;
      uav.vehicle.camera.hfov_deg = 40.0 + 20.0 * static_cast<double>(i);
      scenario_.fleet.push_back(uav);
    }
    views_.resize(kUavs);
    views_[0].alive = false;
  }

  void move() {
    for (UavView& view : views_) {
      view.state.p_WB = test::random_in_box(random_, {-50, -50, 0}, {50, 50, 60});
      view.state.q_WB =
          Quaterniond(test::rotation(random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5), random_.uniform(-3, 3)));
      view.gimbal = {random_.uniform(-1.4, 1.4), random_.uniform(-1.5, 1.5), 0.0, 0.0};
    }
  }

  /// Points, colours and an orientation that RViz takes, in the frame "world".
  static void expect_sound(const msg::Marker& marker) {
    EXPECT_EQ(marker.header().frame_id(), "world");
    EXPECT_NEAR(from_message(marker.pose().orientation()).norm(), 1.0, 1e-9);
    const bool listed =
        marker.type() >= static_cast<int>(Shape::line_strip) && marker.type() != static_cast<int>(Shape::text);
    const bool removed = marker.action() == static_cast<int>(Action::remove);
    EXPECT_EQ(removed, listed && marker.points().empty());
    EXPECT_TRUE(marker.colors().empty() || marker.colors().size() == marker.points().size());
    std::vector<msg::ColorRGBA> colours = marker.colors();
    colours.push_back(marker.color());
    for (const msg::ColorRGBA& colour : colours) {
      for (const float part : {colour.r(), colour.g(), colour.b(), colour.a()}) {
        EXPECT_GE(part, 0.0F);
        EXPECT_LE(part, 1.0F);
      }
      EXPECT_GT(colour.a(), 0.0F) << "a transparent marker is invisible";
    }
  }
  static Quaterniond from_message(const msg::Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
  static std::vector<float> rgb(const msg::ColorRGBA& c) { return {c.r(), c.g(), c.b()}; }

  Scenario scenario_;
  std::vector<UavView> views_;
  RandomStream random_{1, "markers", 0};
};

// The camera's own test must accept points just inside the corners, and reject points just outside any border.
TEST_F(Markers, FrustaEndWhereTheCameraStopsSeeing) {
  RulesConfig rules;
  for (int round = 0; round < kRounds; ++round) {
    move();
    const msg::MarkerArray array = frustum_markers(7, scenario_, views_);
    ASSERT_EQ(array.markers().size(), kUavs);
    for (std::size_t i = 0; i < kUavs; ++i) {
      const msg::Marker& marker = array.markers()[i];
      expect_sound(marker);
      ASSERT_EQ(marker.points().empty(), !views_[i].alive);
      if (!views_[i].alive) continue;
      const CameraConfig& camera = scenario_.fleet[i].vehicle.camera;
      const CameraState state = camera_state(views_[i].state, views_[i].gimbal, camera);
      const Exposure exposure(state, camera, scenario_.desired_mm_per_pixel, rules);
      ASSERT_EQ(marker.points().size(), 16U);
      std::vector<Vector3d> corners;
      for (std::size_t line = 0; line < 8; line += 2) {
        EXPECT_LT((xyz(marker.points()[2 * line]) - state.X_WC.translation()).norm(), 1e-9) << "begins at the camera";
        corners.push_back(xyz(marker.points()[2 * line + 1]));
        EXPECT_EQ(xyz(marker.points()[2 * line + 2]), corners.back()) << "goes on around the picture";
      }
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const Vector3d p_C = state.X_WC.inverse() * corners[c], next_C = state.X_WC.inverse() * corners[(c + 1) % 4];
        EXPECT_NEAR(p_C.norm(), exposure.radius(), 1e-9);
        EXPECT_NE(p_C.y() * next_C.y() < 0.0, p_C.z() * next_C.z() < 0.0) << "around the picture, not across it";
        const auto seen = [&](double depth, double y, double z) {
          return exposure.view(state.X_WC * (depth * p_C.cwiseProduct(Vector3d(1.0, y, z)))).has_value();
        };
        EXPECT_TRUE(seen(0.999, 0.999, 0.999));
        EXPECT_FALSE(seen(1.001, 0.999, 0.999)) << "too far";
        EXPECT_FALSE(seen(0.9, 1.001, 0.999)) << "beside the picture";
        EXPECT_FALSE(seen(0.9, 0.999, 1.001)) << "above or below it";
      }
    }
  }
}

TEST_F(Markers, TheLinkMarkerShowsTheOpenLinks) {
  for (int round = 0; round < kRounds; ++round) {
    move();
    Links links(kUavs + 1);
    std::size_t pairs = 0;
    for (const Node a : scenario_.nodes()) {
      for (const Node b : scenario_.nodes()) links.at(a, b) = a != b && random_.bits() % 3 == 0;
    }
    const msg::Marker marker = link_marker(7, scenario_, views_, links);
    expect_sound(marker);
    const auto place = [&](Node node) {
      return node == kStationNode ? scenario_.station_position : views_[*uav_of_node(node)].state.p_WB;
    };
    std::set<std::vector<float>> one_way, both_ways;
    for (const Node a : scenario_.nodes()) {
      for (const Node b : scenario_.nodes()) {
        if (b <= a) continue;
        const bool there = links.at(a, b) != 0, back = links.at(b, a) != 0;
        pairs += there || back;
        std::size_t drawn = 0;
        for (std::size_t i = 0; i < marker.points().size(); i += 2) {
          if (xyz(marker.points()[i]) != place(a) || xyz(marker.points()[i + 1]) != place(b)) continue;
          ++drawn;
          (there && back ? both_ways : one_way).insert(rgb(marker.colors()[i]));
          EXPECT_EQ(rgb(marker.colors()[i]), rgb(marker.colors()[i + 1]));
        }
        EXPECT_EQ(drawn, there || back ? 1U : 0U) << a << ' ' << b;
      }
    }
    EXPECT_EQ(marker.points().size(), 2 * pairs);
    for (const auto& colour : one_way) EXPECT_FALSE(both_ways.contains(colour));
  }
  expect_sound(link_marker(7, scenario_, views_, Links(kUavs + 1)));
}

TEST_F(Markers, EachUavIsDrawnAtItsPose) {
  move();
  const msg::MarkerArray array = fleet_markers(7, scenario_, views_);
  std::set<std::pair<std::string, int>> ids;
  for (const msg::Marker& marker : array.markers()) {
    expect_sound(marker);
    EXPECT_TRUE(ids.emplace(marker.ns(), marker.id()).second)
        << "RViz replaces a marker by another one with the same name and number";
    EXPECT_EQ(marker.header().stamp(), to_time(7));
  }
  ASSERT_EQ(array.markers().size(), 2 * (kUavs + 1));
  EXPECT_EQ(array.markers()[1].text(), "gcs");
  for (std::size_t i = 0; i < kUavs; ++i) {
    const msg::Marker &body = array.markers()[2 * i + 2], &name = array.markers()[2 * i + 3];
    EXPECT_EQ(xyz(body.pose().position()), views_[i].state.p_WB);
    EXPECT_LT(from_message(body.pose().orientation()).angularDistance(views_[i].state.q_WB), 1e-9);
    EXPECT_EQ(name.text(), scenario_.fleet[i].name);
    EXPECT_GT(name.pose().position().z(), body.pose().position().z());
  }
  EXPECT_NE(rgb(array.markers()[4].color()), rgb(array.markers()[6].color())) << "the two roles differ in colour";
  EXPECT_NE(rgb(array.markers()[2].color()), rgb(array.markers()[6].color())) << "a UAV that is out has another colour";
}

TEST_F(Markers, BoxesHaveTheirEdgesAndTheStructureItsTriangles) {
  std::vector<OrientedBox> boxes;
  for (int i = 0; i < 5; ++i) {
    boxes.push_back({"box", test::random_in_box(random_, {-50, -50, 0}, {50, 50, 60}),
                     test::random_in_box(random_, {1, 1, 1}, {9, 9, 9}), test::rotation(0.1 * i, 0.2 * i, 0.3 * i)});
  }
  const msg::Marker edges = box_marker(boxes);
  expect_sound(edges);
  ASSERT_EQ(edges.points().size(), boxes.size() * 24);
  for (std::size_t i = 0; i < edges.points().size(); i += 2) {
    const OrientedBox& box = boxes[i / 24];
    const Vector3d a = xyz(edges.points()[i]), b = xyz(edges.points()[i + 1]);
    EXPECT_TRUE(box.contains(a, 1e-9) && box.contains(b, 1e-9));
    EXPECT_FALSE(box.contains(a, -1e-9) || box.contains(b, -1e-9));
    const Vector3d along = (box.R_WO.transpose() * (b - a)).cwiseAbs();
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) axes += std::abs(along[axis] - box.size[axis]) < 1e-9;
    EXPECT_EQ(axes, 1);
    EXPECT_NEAR(along.sum(), along.maxCoeff(), 1e-9) << "along one axis";
  }
  const TriangleMesh mesh = test::random_triangles(50, 3);
  const msg::Marker structure = structure_marker(mesh);
  expect_sound(structure);
  ASSERT_EQ(structure.points().size(), 3 * mesh.triangles.size());
  for (std::size_t i = 0; i < structure.points().size(); ++i) {
    EXPECT_EQ(xyz(structure.points()[i]), mesh.vertices[mesh.triangles[i / 3][i % 3]].cast<double>());
  }
  expect_sound(structure_marker({}));
  expect_sound(box_marker({}));
}

TEST_F(Markers, ThePathMarkersFollowTheTrails) {
  Trails trails(kUavs);
  for (Tick tick = 0; tick < 10 * Trails::kPeriod; tick += Trails::kPeriod) {
    move();
    trails.add(tick, views_);
  }
  const msg::MarkerArray array = path_markers(7, scenario_, trails);
  ASSERT_EQ(array.markers().size(), kUavs);
  for (std::size_t i = 0; i < kUavs; ++i) {
    expect_sound(array.markers()[i]);
    ASSERT_EQ(array.markers()[i].points().size(), trails.of(UavIndex(i)).size());
    EXPECT_EQ(xyz(array.markers()[i].points().back()), views_[i].state.p_WB);
  }
  const msg::MarkerArray none = path_markers(7, scenario_, Trails(kUavs));
  for (const msg::Marker& marker : none.markers()) expect_sound(marker);
}

}  // namespace
}  // namespace skein::sim::viz
