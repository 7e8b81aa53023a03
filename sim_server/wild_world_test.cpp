// Properties of every wild world: sound meshes, the same bytes from the same number, points in boxes, a fleet that can
// start, and ways from there to views of points and home again. Other tests check that worlds differ as they should.
#include "scenes/wild/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <set>

#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/scene_export.hpp"
#include "scenes/wild/flyable.hpp"
#include "scenes/wild/site.hpp"
#include "sim_server/flight/fleet_start.hpp"
#include "sim_server/simulation.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

const std::filesystem::path kConfig = source_path("config");
constexpr std::uint64_t kFirstSeed = 100, kSeeds = 6;

const World& drawn(const std::string& family, std::uint64_t seed) {
  static std::map<std::pair<std::string, std::uint64_t>, std::unique_ptr<World>> worlds;
  auto& place = worlds[{family, seed}];
  if (!place) place = std::make_unique<World>(draw_world(family, seed, kConfig));
  return *place;
}

class EveryWorld : public testing::TestWithParam<std::tuple<std::string, std::uint64_t>> {
 protected:
  const bool blind_ = std::get<0>(GetParam()) == kBlindWorld;
  const World& world_ = drawn(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Scenario& scenario_ = world_.scenario;
  const Scene& scene_ = world_.scene;
};

TEST_P(EveryWorld, MeshIsClosedSoundAndWoundOutwards) {
  const TriangleMesh& mesh = scene_.mesh;
  for (const auto& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
  EXPECT_EQ(test::open_edges(mesh), "");
  EXPECT_EQ(test::inward_parts(mesh), "");
}

TEST_P(EveryWorld, TaskIsWithinItsBounds) {
  EXPECT_GE(scenario_.duration_s, 120.0);
  EXPECT_LE(scenario_.duration_s, 600.0);
  EXPECT_GE(scenario_.desired_mm_per_pixel, 0.8);
  EXPECT_LE(scenario_.desired_mm_per_pixel, 3.0);
  EXPECT_GE(scenario_.fleet.size(), 1u);
  EXPECT_LE(scenario_.fleet.size(), 8u);
  const auto explorers =
      std::ranges::count_if(scenario_.fleet, [](const UavConfig& uav) { return uav.vehicle.role == Role::explorer; });
  if (blind_) {
    EXPECT_EQ(explorers, 0);
  } else {
    EXPECT_GE(explorers, 1);
  }
  EXPECT_GE(scene_.points.size(), 50u);
}

TEST_P(EveryWorld, BoxesHoldAllPoints) {
  EXPECT_GE(scene_.boxes.size(), 1u);
  EXPECT_LE(scene_.boxes.size(), 15u);
  std::set<std::string> names;
  for (const OrientedBox& box : scene_.boxes) {
    EXPECT_TRUE(names.insert(box.name).second) << box.name;
    EXPECT_TRUE((box.R_WO.transpose() * box.R_WO).isIdentity(1e-12)) << box.name;
    EXPECT_GT(box.size.minCoeff(), 0.05) << box.name;
  }
  for (const InterestPoint& point : scene_.points) {
    const auto holds = [&](const OrientedBox& box) { return box.contains(point.p_W.cast<double>(), 1e-4); };
    EXPECT_TRUE(std::ranges::any_of(scene_.boxes, holds)) << point.p_W.transpose();
  }
}

TEST_P(EveryWorld, InABlindWorldNothingStandsButItsStructures) {
  const wild::Dice dice{std::get<1>(GetParam()), static_cast<std::uint64_t>(world_.attempt)};
  TriangleMesh structures;
  for (const wild::Standing& structure : wild::draw_structures(dice, wild::draw_task(dice, blind_).area_m2)) {
    append(structures, structure.mesh);
  }
  const TriangleMesh& all = scene_.mesh;
  ASSERT_GE(all.triangles.size(), structures.triangles.size());
  EXPECT_TRUE(std::equal(structures.vertices.begin(), structures.vertices.end(), all.vertices.begin()));
  if (blind_) {
    EXPECT_EQ(all.triangles, structures.triangles);
    EXPECT_EQ(all.vertices, structures.vertices);
  }
}

TEST_P(EveryWorld, TheFleetCanStartInTheWorldAndInItsExport) {
  EXPECT_TRUE(wild::is_flyable(scenario_, scene_));
  const auto folder = std::filesystem::path(testing::TempDir()) / ("world_" + scenario_.name);
  write_export(scene_export(scenario_, scene_), folder, true);
  const Scenario read = load_scenario(folder / (scenario_.name + ".yaml"), {.config_dir = kConfig});
  EXPECT_EQ(read.scene.scene_seed, std::get<1>(GetParam()));
  EXPECT_EQ(read.scene.family, std::get<0>(GetParam()));
  EXPECT_EQ(read.duration_s, scenario_.duration_s);
  EXPECT_EQ(read.station_position, scenario_.station_position);
  ASSERT_EQ(read.fleet.size(), scenario_.fleet.size());
  for (std::size_t i = 0; i < read.fleet.size(); ++i) EXPECT_EQ(read.fleet[i].start, scenario_.fleet[i].start);
  EXPECT_NO_THROW(Simulation(read, Scene(scene_), 0));  // refuses starts that are not clear or have no way out
  std::filesystem::remove_all(folder);
}

TEST_P(EveryWorld, AWalledInStartCannotBeFlown) {
  MeshBuilder walls;
  const Vector2d start = scenario_.fleet.front().start;
  for (int i = 0; i < 4; ++i) {
    const Isometry3d X_WS = standing_at(start, 1.5707963267948966 * i);
    walls.add_box(X_WS * Eigen::Translation3d(1.6, 0, 3.0), {0.4, 4.0, 7.0});
  }
  walls.add_box(standing_at(start, 0.0) * Eigen::Translation3d(0, 0, 6.0), {4.0, 4.0, 0.4});
  Scene scene = scene_;
  append(scene.mesh, walls.mesh());
  EXPECT_FALSE(wild::is_flyable(scenario_, scene));
}

INSTANTIATE_TEST_SUITE_P(Wild, EveryWorld,
                         testing::Combine(testing::ValuesIn(std::vector<std::string>(kWildWorlds.begin(),
                                                                                     kWildWorlds.end())),
                                          testing::Range<std::uint64_t>(kFirstSeed, kFirstSeed + kSeeds)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + "_" + std::to_string(std::get<1>(test.param));
                         });

TEST(World, SameSeedGivesTheSameBytes) {
  const World again = draw_world("wild", kFirstSeed, kConfig);
  const auto once = scene_export(drawn("wild", kFirstSeed).scenario, drawn("wild", kFirstSeed).scene);
  const auto twice = scene_export(again.scenario, again.scene);
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].content, twice[i].content) << once[i].path;
}

TEST(World, UnknownNamesAreRefused) { EXPECT_THROW(draw_world("wilt", 1, kConfig), InputError); }

/// Looks only at the drawn tasks, without the check that the world can be flown, which is too slow for many seeds.
TEST(Tasks, DrawnTasksAreOfAllKinds) {
  std::set<std::size_t> sizes;
  std::size_t explorers_alone = 0, photographer_first = 0;
  constexpr std::uint64_t kMany = 300;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kMany; ++seed) {
    const wild::Task task = wild::draw_task({seed, 0}, false);
    sizes.insert(task.fleet.size());
    const auto explorers = static_cast<std::size_t>(std::ranges::count(task.fleet, Role::explorer));
    ASSERT_GE(explorers, 1u) << seed;
    explorers_alone += explorers == task.fleet.size();
    photographer_first += task.fleet.front() == Role::photographer;
  }
  EXPECT_EQ(sizes.size(), 8u);
  EXPECT_GT(explorers_alone, 0u);
  EXPECT_GT(photographer_first, 0u);
}

/// Also in blind worlds, as docs/wild.md says: boxes contain all points, but structure may stand outside of them.
TEST(Boxes, BoxesMayLeavePartsOfAStructureOut) {
  std::size_t worlds_with_parts_outside = 0;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 50; ++seed) {
    const wild::Dice dice{seed, 0};
    const auto structures = wild::draw_structures(dice, wild::draw_task(dice, true).area_m2);
    const std::vector<Vector2d> starts = {structures.front().p_W + Vector2d(structures.front().radius + 5.0, 0.0)};
    const auto boxes = wild::draw_boxes(dice, structures, starts);
    const auto is_outside = [&](const Eigen::Vector3f& vertex) {
      return std::ranges::none_of(boxes,
                                  [&](const OrientedBox& box) { return box.contains(vertex.cast<double>(), 0.1); });
    };
    worlds_with_parts_outside += std::ranges::any_of(
        structures, [&](const wild::Standing& one) { return std::ranges::any_of(one.mesh.vertices, is_outside); });
  }
  EXPECT_GT(worlds_with_parts_outside, 3u);
}

TEST(Boxes, DrawnBoxesAreOfAllKinds) {
  std::size_t single = 0, hanging = 0, many = 0;
  constexpr std::uint64_t kMany = 100;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kMany; ++seed) {
    const wild::Dice dice{seed, 0};
    const auto structures = wild::draw_structures(dice, wild::draw_task(dice, false).area_m2);
    const std::vector<Vector2d> starts = {structures.front().p_W + Vector2d(structures.front().radius + 5.0, 0.0)};
    const auto boxes = wild::draw_boxes(dice, structures, starts);
    single += boxes.size() == 1 && structures.size() > 1;
    many += boxes.size() > structures.size();
    hanging += std::ranges::any_of(boxes, [&](const OrientedBox& box) {
      return box.contains({starts[0].x(), starts[0].y(), box.center.z()}) &&
             !box.contains({starts[0].x(), starts[0].y(), 3.0});
    });
  }
  EXPECT_GT(single, 3u);
  EXPECT_GT(hanging, 10u);
  EXPECT_GT(many, 20u);
}

}  // namespace
}  // namespace skein::sim
