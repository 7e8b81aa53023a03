// The bundled scene and its family: repeatable, clean, visible, and clear of the starts.
#include "sim_server/scenes/towers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace skein::sim {
namespace {

/// A triangle with the box around it, which rules most of them out for a segment.
struct Facet {
  std::array<Vector3d, 3> corners;
  Eigen::AlignedBox3d extent;
};

/// A scene, built once for all tests, with its triangles spelt out.
struct Built {
  explicit Built(std::uint64_t scene_seed) : scene(make_towers(scene_seed)) {
    for (const auto& t : scene.mesh.triangles) {
      Facet facet;
      for (std::size_t i = 0; i < 3; ++i) {
        facet.corners[i] = scene.mesh.vertices[t[i]].cast<double>();
        facet.extent.extend(facet.corners[i]);
      }
      facets.push_back(facet);
    }
  }

  Scene scene;
  std::vector<Facet> facets;
};

const Built& built(std::uint64_t scene_seed) {
  static std::map<std::uint64_t, Built> scenes;
  return scenes.try_emplace(scene_seed, scene_seed).first->second;
}

class Towers : public testing::TestWithParam<std::uint64_t> {
 protected:
  const Scene& scene_ = built(GetParam()).scene;
  const std::vector<Facet>& facets_ = built(GetParam()).facets;

  /// Every triangle against the segment, the plain way.
  bool is_free(const Vector3d& from, const Vector3d& to) const {
    const Vector3d way = to - from;
    Eigen::AlignedBox3d reach(from);
    reach.extend(to);
    for (const Facet& facet : facets_) {
      if (!reach.intersects(facet.extent)) continue;
      const auto& [a, b, c] = facet.corners;
      const Vector3d ab = b - a, ac = c - a, h = way.cross(ac);
      const double determinant = ab.dot(h);
      if (std::abs(determinant) < 1e-12) continue;
      const Vector3d s = (from - a) / determinant, q = s.cross(ab);
      const double u = s.dot(h), v = way.dot(q), share = ac.dot(q);
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && share > 0.0 && share < 1.0) return false;
    }
    return true;
  }

  /// Whether a camera at some metres sees the point from a place that itself has a free way out of the scene.
  bool is_visible(const InterestPoint& point) const {
    const Vector3d n = point.n_W.cast<double>(), p = point.p_W.cast<double>() + 0.01 * n;
    for (const Vector3d& direction : directions()) {
      if (direction.dot(n) < 0.5) continue;
      const Vector3d camera = p + 4.0 * direction;
      if (camera.z() > 0.5 && is_free(p, camera) && can_leave(camera)) return true;
    }
    return false;
  }

 private:
  bool can_leave(const Vector3d& from) const {
    const auto all = directions();
    return std::any_of(all.begin(), all.end(),
                       [&](const Vector3d& way) { return way.z() >= 0.0 && is_free(from, from + 300.0 * way); });
  }

  static std::vector<Vector3d> directions() {
    std::vector<Vector3d> all;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x != 0 || y != 0 || z != 0) all.push_back(Vector3d(x, y, z).normalized());
        }
      }
    }
    return all;
  }
};

TEST_P(Towers, MeshIsSound) {
  for (const auto& v : scene_.mesh.vertices) ASSERT_TRUE(v.allFinite());
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [corners, extent] : facets_) {
    const auto& [a, b, c] = corners;
    EXPECT_GT((b - a).cross(c - a).norm(), 1e-4) << a.transpose();
  }
  for (const auto& t : scene_.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second) << "an edge is used twice in one direction";
    }
  }
  for (const auto& [from, to] : edges) EXPECT_TRUE(edges.count({to, from})) << "an open edge";
}

TEST_P(Towers, SameSeedGivesTheSameBytes) {
  const Scene again = make_towers(GetParam());
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  EXPECT_TRUE(same(scene_.mesh.vertices, again.mesh.vertices));
  EXPECT_TRUE(same(scene_.mesh.triangles, again.mesh.triangles));
  EXPECT_TRUE(same(scene_.points, again.points));
}

TEST_P(Towers, SixBoxesHoldAllPointsAndEachHasSome) {
  ASSERT_EQ(scene_.boxes.size(), 6u);
  EXPECT_EQ(scene_.points.size(), 4000u);
  std::array<int, 6> count{};
  for (const auto& point : scene_.points) {
    bool held = false;
    for (std::size_t i = 0; i < 6; ++i) {
      const bool in = scene_.boxes[i].contains(point.p_W.cast<double>());
      count[i] += in;
      held |= in;
    }
    EXPECT_TRUE(held);
    EXPECT_GE(point.p_W.z(), 0.3f);
    EXPECT_NEAR(point.n_W.norm(), 1.0f, 1e-5f);
  }
  for (std::size_t i = 0; i < 6; ++i) EXPECT_GT(count[i], 30) << scene_.boxes[i].name;
}

TEST_P(Towers, PointsCanBeSeenFromOutside) {
  constexpr std::size_t kEvery = 16;
  std::size_t looked_at = 0, visible = 0;
  for (std::size_t i = 0; i < scene_.points.size(); i += kEvery, ++looked_at) visible += is_visible(scene_.points[i]);
  EXPECT_GE(static_cast<double>(visible), 0.95 * static_cast<double>(looked_at));
  RecordProperty("looked_at", static_cast<int>(looked_at));
  RecordProperty("visible", static_cast<int>(visible));
}

TEST_P(Towers, StartsAndTheColumnsAboveAreFree) {
  // No edge comes near, seen from above, and no triangle stands over the start itself.
  constexpr double kClearance = 3.0;
  for (const Vector2d& start :
       {Vector2d(0, 5), Vector2d(31, 0), Vector2d(58, -13), Vector2d(0, 4), Vector2d(-2, 25), Vector2d(-2, 8)}) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [points, extent] : facets_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector2d a = points[i].head<2>(), way = points[(i + 1) % 3].head<2>() - a;
        const double share = std::clamp((start - a).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
        nearest = std::min(nearest, (a + share * way - start).norm());
      }
    }
    EXPECT_GT(nearest, kClearance) << start.transpose();
    const Vector3d ground(start.x(), start.y(), 0.05);
    EXPECT_TRUE(is_free(ground, ground + Vector3d(0, 0, 200))) << start.transpose();
  }
}

TEST_P(Towers, IsOfTheBenchmarksSize) {
  Eigen::AlignedBox3d extent;
  for (const auto& v : scene_.mesh.vertices) extent.extend(Vector3d(v.cast<double>()));
  EXPECT_GT(extent.max().z(), 55.0);
  EXPECT_LT(extent.max().z(), 66.0);
  EXPECT_LT(extent.sizes().head<2>().maxCoeff(), 150.0);
  EXPECT_LT(scene_.mesh.triangles.size(), 30000u);
}

INSTANTIATE_TEST_SUITE_P(SceneSeeds, Towers, testing::Values(0, 1, std::numeric_limits<std::uint64_t>::max()));

TEST(TowersFamily, SeedsDiffer) {
  const Scene &a = built(0).scene, &b = built(1).scene;
  EXPECT_NE(a.boxes[1].center, b.boxes[1].center);
  EXPECT_NE(a.mesh.vertices.size(), b.mesh.vertices.size());
}

}  // namespace
}  // namespace skein::sim
