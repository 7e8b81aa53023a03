// Cached interest points equal those that would be drawn, even if the file is damaged.
#include "scenes/kept_points.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {
namespace {

namespace fs = std::filesystem;

class KeptPoints : public testing::Test {
 protected:
  ~KeptPoints() override { fs::remove_all(cache_); }

  /// A few blocks in one box.
  UnsampledScene draw() {
    MeshBuilder builder;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Translation3d p_WO(8.0 * i, random_.uniform(-5.0, 5.0), 3.0);
      builder.add_box(Isometry3d(p_WO), Vector3d(random_.uniform(2.0, 4.0), 3.0, 4.0));
    }
    UnsampledScene drawn{{}, 40, random_.bits()};
    drawn.scene.mesh = builder.take();
    drawn.scene.boxes.push_back({.name = "all", .center = {8.0, 0.0, 5.0}, .size = {40.0, 40.0, 10.0}});
    return drawn;
  }
  static void expect_same(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      EXPECT_EQ(a.points[i].p_W, b.points[i].p_W);
      EXPECT_EQ(a.points[i].n_W, b.points[i].n_W);
    }
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.boxes.size(), b.boxes.size());
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    if (!fs::exists(cache_)) return all;
    for (const auto& entry : fs::directory_iterator(cache_)) all.push_back(entry.path());
    return all;
  }

  const fs::path cache_ = fs::path(testing::TempDir()) / ("kept_points_test-" + std::to_string(::getpid()));
  RandomStream random_{3, "kept_points_test", 0};
};

TEST_F(KeptPoints, AreThoseThatWouldBeDrawn) {
  for (int i = 0; i < 5; ++i) {
    const UnsampledScene scene = draw();
    const Scene drawn = sampled(scene);
    EXPECT_FALSE(drawn.points.empty());
    expect_same(sampled_or_kept(scene, cache_), drawn);
    EXPECT_EQ(files().size(), static_cast<std::size_t>(i) + 1);
    expect_same(sampled_or_kept(scene, cache_), drawn);
    EXPECT_EQ(files().size(), static_cast<std::size_t>(i) + 1);
  }
}

TEST_F(KeptPoints, HaveAKeyThatCoversAllInputs) {
  const UnsampledScene scene = draw();
  sampled_or_kept(scene, cache_);
  std::vector<UnsampledScene> others(5, scene);
  ++others[0].seed;
  ++others[1].point_count;
  others[2].scene.boxes[0].size.x() += 1.0;
  others[3].scene.mesh.vertices[5].x() += 0.5F;
  std::swap(others[4].scene.mesh.triangles[0], others[4].scene.mesh.triangles[1]);
  for (std::size_t i = 0; i < others.size(); ++i) {
    expect_same(sampled_or_kept(others[i], cache_), sampled(others[i]));
    EXPECT_EQ(files().size(), i + 2) << i;
  }
}

TEST_F(KeptPoints, AreDrawnAnewWhereTheFileIsDamaged) {
  const UnsampledScene scene = draw();
  const Scene drawn = sampled(scene);
  sampled_or_kept(scene, cache_);
  ASSERT_EQ(files().size(), 1U);
  std::ostringstream whole;
  whole << std::ifstream(files()[0]).rdbuf();
  for (int i = 0; i < 60; ++i) {
    std::string text = whole.str();
    const auto at = static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(text.size())));
    if (i % 3 == 0) {
      text.resize(at);
    } else {
      text[at] = static_cast<char>(random_.bits());
    }
    std::ofstream(files()[0]) << text;
    expect_same(sampled_or_kept(scene, cache_), drawn);
  }
}

TEST_F(KeptPoints, AreDrawnIfTheCacheCannotBeWritten) {
  std::ofstream(cache_) << "a file in the folder's place";
  const UnsampledScene scene = draw();
  expect_same(sampled_or_kept(scene, cache_), sampled(scene));
}

}  // namespace
}  // namespace skein::sim
