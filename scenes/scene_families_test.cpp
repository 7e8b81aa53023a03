// Tests what every family of procedural scenes must provide, for several scene seeds: sound meshes, repeatable bytes,
// evenly spread and visible interest points, plausible boxes, free space around the starts and the station.
#include "core/scenario/scene_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "core/scenario/scenario_reader.hpp"
#include "scenes/enclosure.hpp"
#include "scenes/scene_source.hpp"
#include "sight/ray_scene.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr std::uint64_t kSeeds = 6;

struct Built {
  Built(const std::string& family, std::uint64_t scene_seed) {
    scenario = load_scenario(family, {.config_dir = source_path("config"), .scene_seed = scene_seed});
    scene = load_scene(scenario);
    world = std::make_unique<RayScene>(scene.mesh);
  }

  Scenario scenario;
  Scene scene;
  std::unique_ptr<RayScene> world;
};

/// A scene; each is built once for all tests.
const Built& built(const std::string& family, std::uint64_t scene_seed) {
  static std::map<std::pair<std::string, std::uint64_t>, std::unique_ptr<Built>> scenes;
  auto& place = scenes[{family, scene_seed}];
  if (!place) place = std::make_unique<Built>(family, scene_seed);
  return *place;
}

template <typename T>
bool equal_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

class EveryScene : public testing::TestWithParam<std::tuple<std::string, std::uint64_t>> {
 protected:
  const Built& built_ = built(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Scene& scene_ = built_.scene;
  const RayScene& world_ = *built_.world;

  Vector3d corner(std::uint32_t vertex) const { return scene_.mesh.vertices[vertex].cast<double>(); }

  /// Least distance between the structure and the vertical line over a place, from the ground up to `height`.
  double clearance_of_column(const Vector2d& p_W, double height) const {
    double least = std::numeric_limits<double>::infinity();
    for (double z = 0.25; z <= height; z += 0.5) least = std::min(least, world_.clearance({p_W.x(), p_W.y(), z}));
    return least;
  }

  /// Whether a camera 2 m or 4 m in front of the point can see it, from a place that is not enclosed and at least 0.5 m
  /// from the structure and above the ground.
  bool is_visible(const InterestPoint& point) const {
    const Vector3d n = point.n_W.cast<double>(), p = point.p_W.cast<double>() + 0.005 * n;
    for (int x = -2; x <= 2; ++x) {
      for (int y = -2; y <= 2; ++y) {
        for (int z = -2; z <= 2; ++z) {
          const Vector3d direction = Vector3d(x, y, z).normalized();
          if (direction.dot(n) < 0.5) continue;
          for (const double distance : {2.0, 4.0}) {
            const Vector3d camera = p + distance * direction;
            if (camera.z() < 0.5 || world_.clearance(camera, 0.5) < 0.5) continue;
            if (!world_.first_hit_distance(p, camera) && !is_enclosed(world_, camera)) return true;
          }
        }
      }
    }
    return false;
  }
};

TEST_P(EveryScene, MeshIsClosedAndSound) {
  const TriangleMesh& mesh = scene_.mesh;
  for (const auto& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
  for (const auto& t : mesh.triangles) {
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, (corner(t[i]) - corner(t[(i + 1) % 3])).norm());
    }
    const double height = (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0])).norm() / longest;
    ASSERT_GT(height, 1e-4) << "a sliver at " << corner(t[0]).transpose();
  }
  EXPECT_EQ(test::open_edges(mesh), "");
}

TEST_P(EveryScene, EachPartIsWoundOutwards) { EXPECT_EQ(test::inward_parts(scene_.mesh), ""); }

TEST_P(EveryScene, BoxesAreProperAndHoldAllPoints) {
  std::set<std::string> names;
  std::vector<std::size_t> count(scene_.boxes.size());
  for (const OrientedBox& box : scene_.boxes) {
    EXPECT_TRUE(names.insert(box.name).second) << box.name;
    EXPECT_GT(box.size.minCoeff(), 0.5) << box.name;
    EXPECT_TRUE((box.R_WO.transpose() * box.R_WO).isIdentity(1e-12)) << box.name;
    EXPECT_NEAR(box.R_WO.determinant(), 1.0, 1e-12) << box.name;
  }
  for (const InterestPoint& point : scene_.points) {
    std::size_t holders = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
      const bool holds = scene_.boxes[i].contains(point.p_W.cast<double>(), 1e-4);
      count[i] += holds;
      holders += holds;
    }
    EXPECT_GT(holders, 0u);
  }
  for (std::size_t i = 0; i < count.size(); ++i) EXPECT_GE(count[i], 20u) << scene_.boxes[i].name;
}

TEST_P(EveryScene, PointsLieOnTheSurfaceAndFaceOutwards) {
  EXPECT_EQ(scene_.points.size(), built(std::get<0>(GetParam()), 0).scene.points.size());
  EXPECT_GE(scene_.points.size(), 2000u);
  for (const InterestPoint& point : scene_.points) {
    const Vector3d p = point.p_W.cast<double>(), n = point.n_W.cast<double>();
    ASSERT_NEAR(n.norm(), 1.0, 1e-5);
    ASSERT_GE(p.z(), 0.3);
    ASSERT_LT(world_.clearance(p, 1.0), 1e-3) << p.transpose();
    // A ray from 2 mm above the point back to the surface hits the surface there, and nothing nearer.
    const auto hit = world_.first_hit(p + 0.002 * n, -n, 0.004);
    ASSERT_TRUE(hit) << p.transpose();
    ASSERT_NEAR(hit->distance, 0.002, 1.1e-3) << p.transpose();
  }
}

TEST_P(EveryScene, PointsAreEvenlySpread) {
  // The distance of a point to its nearest neighbour. Neighbours that face the other way, for example on the other side
  // of a thin plate, do not count. For random places, the standard deviation of this distance is about half its mean.
  constexpr std::size_t kEvery = 8;
  std::vector<double> nearest;
  for (std::size_t i = 0; i < scene_.points.size(); i += kEvery) {
    float least_sq = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < scene_.points.size(); ++j) {
      if (j == i || scene_.points[i].n_W.dot(scene_.points[j].n_W) < -0.5f) continue;
      least_sq = std::min(least_sq, (scene_.points[i].p_W - scene_.points[j].p_W).squaredNorm());
    }
    nearest.push_back(std::sqrt(static_cast<double>(least_sq)));
  }
  const auto n = static_cast<double>(nearest.size());
  const double mean = std::accumulate(nearest.begin(), nearest.end(), 0.0) / n;
  double squares = 0.0;
  for (const double d : nearest) squares += (d - mean) * (d - mean);
  EXPECT_LT(std::sqrt(squares / n), 0.35 * mean);
  EXPECT_LT(static_cast<double>(std::ranges::count_if(nearest, [&](double d) { return d < 0.4 * mean; })), 0.02 * n);
}

TEST_P(EveryScene, PointsCanBeSeenFromFreeSpace) {
  constexpr std::size_t kEvery = 10;
  std::size_t looked_at = 0, visible = 0;
  for (std::size_t i = 0; i < scene_.points.size(); i += kEvery, ++looked_at) visible += is_visible(scene_.points[i]);
  EXPECT_GE(static_cast<double>(visible), 0.95 * static_cast<double>(looked_at));
  RecordProperty("looked_at", static_cast<int>(looked_at));
  RecordProperty("visible", static_cast<int>(visible));
}

TEST_P(EveryScene, StartsAndStationHaveRoom) {
  constexpr double kHeight = 10.0;
  const SceneFamily& family = *find_scene_family(std::get<0>(GetParam()));
  for (const Vector2d& nominal : family.starts) {
    EXPECT_GE(clearance_of_column(nominal, kHeight), 4.0) << nominal.transpose();
  }
  for (const StartPlace& start : scene_starts(family, std::get<1>(GetParam()))) {
    EXPECT_GE(clearance_of_column(start.p_W, kHeight), 2.0) << start.p_W.transpose();
    EXPECT_FALSE(is_enclosed(world_, {start.p_W.x(), start.p_W.y(), 0.5})) << start.p_W.transpose();
  }
  const Vector3d& station = built_.scenario.station_position;
  EXPECT_GE(clearance_of_column(station.head<2>(), 3.0), 4.0);
  EXPECT_FALSE(is_enclosed(world_, station));
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const SceneFamily& family : scene_families()) names.emplace_back(family.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Families, EveryScene,
                         testing::Combine(testing::ValuesIn(family_names()), testing::Range<std::uint64_t>(0, kSeeds)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::to_string(std::get<1>(test.param));
                         });

class EveryFamily : public testing::TestWithParam<std::string> {};

TEST_P(EveryFamily, SameSeedGivesTheSameBytes) {
  const Scene& once = built(GetParam(), 2).scene;
  const Scene again = load_scene(built(GetParam(), 2).scenario);
  EXPECT_TRUE(equal_bytes(once.mesh.vertices, again.mesh.vertices));
  EXPECT_TRUE(equal_bytes(once.mesh.triangles, again.mesh.triangles));
  EXPECT_TRUE(equal_bytes(once.points, again.points));
  ASSERT_EQ(once.boxes.size(), again.boxes.size());
  for (std::size_t i = 0; i < once.boxes.size(); ++i) {
    EXPECT_EQ(once.boxes[i].center, again.boxes[i].center);
    EXPECT_EQ(once.boxes[i].size, again.boxes[i].size);
    EXPECT_EQ(once.boxes[i].R_WO, again.boxes[i].R_WO);
  }
}

TEST_P(EveryFamily, SeedsDifferInShapePointsAndBoxes) {
  for (std::uint64_t seed = 1; seed < kSeeds; ++seed) {
    const Scene &a = built(GetParam(), seed - 1).scene, &b = built(GetParam(), seed).scene;
    EXPECT_FALSE(equal_bytes(a.mesh.vertices, b.mesh.vertices)) << seed;
    EXPECT_FALSE(equal_bytes(a.points, b.points)) << seed;
    EXPECT_NE(a.boxes[0].center, b.boxes[0].center) << seed;
  }
}

TEST_P(EveryFamily, SomeSeedsHaveOneBoxAroundEverything) {
  EXPECT_GE(built(GetParam(), 0).scene.boxes.size(), 4u) << "the nominal scene has several boxes";
  std::size_t single = 0;
  for (std::uint64_t seed = 1; seed < kSeeds; ++seed) single += built(GetParam(), seed).scene.boxes.size() == 1;
  EXPECT_GE(single, 1u);
  EXPECT_LE(single, kSeeds / 2);
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::ValuesIn(family_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace skein::sim
