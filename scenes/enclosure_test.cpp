#include "scenes/enclosure.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/scenario/scenario_reader.hpp"
#include "core/vehicle/airframe.hpp"
#include "scenes/files/box_file.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/scene_source.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

const Vector3d kStart(3.0, -2.0, 0.16);

/// A room about the start; its sheets have no thickness.
TriangleMesh room(double width, double bottom, double top) {
  return box_surface(
      {"room", {kStart.x(), kStart.y(), 0.5 * (bottom + top)}, {width, width, top - bottom}, Matrix3d::Identity()});
}

OrientedBox upright(const Vector3d& center, const Vector3d& size) {
  return {"wall", center, size, Matrix3d::Identity()};
}

TriangleMesh join(std::vector<OrientedBox> boxes) {
  TriangleMesh all;
  for (const OrientedBox& box : boxes) append(all, box_surface(box));
  return all;
}

TEST(Enclosure, OpenGroundIsNotEnclosed) {
  EXPECT_FALSE(is_enclosed(RayScene(TriangleMesh{}), kStart));
  EXPECT_FALSE(is_enclosed(RayScene(join({upright({10, 0, 5}, {4, 4, 10})})), kStart));
}

TEST(Enclosure, ARoomIsClosedWithItsFloorOnOrBelowTheGround) {
  for (const double width : {2.0, 20.0, 300.0}) {
    for (const double bottom : {-5.0, 0.0}) {
      EXPECT_TRUE(is_enclosed(RayScene(room(width, bottom, 0.6 * width)), kStart)) << width << ' ' << bottom;
    }
  }
}

TEST(Enclosure, WindingAndDoubleSheetsDoNotChangeTheAnswer) {
  TriangleMesh mesh = room(10.0, -1.0, 4.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  EXPECT_TRUE(is_enclosed(RayScene(mesh), kStart));
  const auto once = mesh.triangles;
  for (const auto& t : once) mesh.triangles.push_back({t[0], t[2], t[1]});
  EXPECT_TRUE(is_enclosed(RayScene(mesh), kStart));
}

TEST(Enclosure, ADoorIsAWayOut) {
  // Walls and roof about 20 x 20 m, a door of 3 x 3 m in the wall at +x, and a screen before it, so that no line of
  // sight leads out from the start.
  const TriangleMesh hall = join({upright({-10, 0, 5}, {0.5, 20, 10}), upright({0, -10, 5}, {20, 0.5, 10}),
                                  upright({0, 10, 5}, {20, 0.5, 10}), upright({0, 0, 10}, {20.5, 20.5, 0.5}),
                                  upright({10, -1.5, 5}, {0.5, 17, 10}), upright({10, 8.5, 6.5}, {0.5, 3, 7}),
                                  upright({8, 6, 2.5}, {0.5, 8, 5})});  // a screen before the door
  EXPECT_FALSE(is_enclosed(RayScene(hall), {-8, -8, 0.16}));
}

TEST(Enclosure, TheSameHallWithItsDoorShutIsClosed) {
  const TriangleMesh hall = join({upright({-10, 0, 5}, {0.5, 20.5, 10}), upright({0, -10, 5}, {20.5, 0.5, 10}),
                                  upright({0, 10, 5}, {20.5, 0.5, 10}), upright({0, 0, 10}, {20.5, 20.5, 0.5}),
                                  upright({10, 0, 5}, {0.5, 20.5, 10}), upright({8, 6, 2.5}, {0.5, 8, 5})});
  EXPECT_TRUE(is_enclosed(RayScene(hall), {-8, -8, 0.16}));
}

/// Corridors of 2.7 x 3 m side by side along x, under a roof. Each has an opening to the next, at alternate ends.
/// @param open  whether the last one has no wall at its far side.
TriangleMesh maze(int corridors, double length, bool open) {
  constexpr double kPitch = 3.0, kThick = 0.3, kHeight = 3.0;
  const double middle = 0.5 * kPitch * (corridors - 1), depth = kPitch * corridors + kThick;
  std::vector<OrientedBox> boxes = {upright({0, middle, kHeight}, {length + kThick, depth, kThick})};
  for (const double end : {-0.5, 0.5}) {
    boxes.push_back(upright({end * length, middle, 0.5 * kHeight}, {kThick, depth, kHeight}));
  }
  for (int i = 0; i <= corridors; ++i) {
    if (i == corridors && open) continue;
    const bool whole = i == 0 || i == corridors;
    const double gap = whole ? 0.0 : kPitch, aside = i % 2 == 0 ? 0.5 * gap : -0.5 * gap;
    boxes.push_back(upright({aside, kPitch * (i - 0.5), 0.5 * kHeight}, {length + kThick - gap, kThick, kHeight}));
  }
  return join(boxes);
}

TEST(Enclosure, AMazeWithAnOpenEndIsNotEnclosed) {
  for (const int corridors : {1, 2, 4, 8, 70}) {
    EXPECT_FALSE(is_enclosed(RayScene(maze(corridors, 12.0, true)), {0.0, 0.0, 0.16})) << corridors;
  }
  EXPECT_FALSE(is_enclosed(RayScene(maze(8, 40.0, true)), {0.0, 0.0, 0.16}));
}

TEST(Enclosure, AMazeWithoutAnEndIsClosed) {
  for (const int corridors : {1, 2, 4, 8}) {
    EXPECT_TRUE(is_enclosed(RayScene(maze(corridors, 12.0, false)), {0.0, 0.0, 0.16})) << corridors;
  }
}

TEST(Enclosure, NoShippedScenarioHasAnEnclosedStart) {
  const std::filesystem::path config = source_path("config");
  const char* assets = std::getenv("SKEIN_ASSETS");
  for (const std::string& name : config_names(config / "scenarios")) {
    LoadOptions options;
    options.config_dir = config;
    options.needs_scene_files = assets != nullptr;
    const Scenario scenario = load_scenario(name, options);
    if (!assets && scenario.scene.family.empty()) continue;
    const RayScene world(load_scene(scenario).mesh);
    EXPECT_FALSE(is_enclosed(world, scenario.station_position)) << name;
    for (const UavConfig& uav : scenario.fleet) {
      EXPECT_FALSE(is_enclosed(world, {uav.start.x(), uav.start.y(), rest_height(uav.vehicle)})) << name << uav.name;
    }
  }
}

}  // namespace
}  // namespace skein::sim
