#include "uav_agent/onboard/ready_frames.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

struct Drawn {
  std::vector<Eigen::Vector3f> sound_W;
  std::optional<Vector3d> p_WS;
  bool keep_lone = false;
};

/// Draws the input of this kind. Kinds differ only slightly within groups of four.
Drawn question(int kind) {
  RandomStream random(static_cast<std::uint64_t>(kind / 4), "frame", 0);
  Drawn drawn;
  const int points = 40 + static_cast<int>(random.bits() % 300);
  for (int i = 0; i < points; ++i) {
    const Vector3d p(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), random.uniform(1.0, 15.0));
    drawn.sound_W.push_back(p.cast<float>());
  }
  drawn.p_WS = Vector3d(random.uniform(-5.0, 5.0), 0.0, 8.0);
  if (kind % 4 == 1) drawn.p_WS->y() += 3.0;
  if (kind % 4 == 2) drawn.p_WS.reset();
  if (kind % 4 == 3) drawn.keep_lone = true;
  return drawn;
}

bool same(const FrameCells& a, const FrameCells& b) {
  return a.hits.blocks == b.hits.blocks && a.passed.blocks == b.passed.blocks;
}

TEST(ReadyFrames, AnswerAsIfNothingWereRemembered) {
  constexpr int kKinds = 40;
  for (const std::size_t most : {0, 1, 7, 39, 40, 200}) {
    ReadyFrames frames(most);
    RandomStream random(most, "asked", 0);
    for (int i = 0; i < 400; ++i) {
      const Drawn drawn = question(static_cast<int>(random.bits() % kKinds));
      const auto ready = frames.ready(drawn.sound_W, drawn.p_WS, drawn.keep_lone);
      ReadyFrames forgetful;
      ASSERT_TRUE(same(*ready, *forgetful.ready(drawn.sound_W, drawn.p_WS, drawn.keep_lone))) << most << " " << i;
    }
  }
}

TEST(ReadyFrames, GiveTheSameMapAsFramesThatAreInsertedDirectly) {
  ReadyFrames frames(3);
  OccupancyMap by_parts, at_once;
  RandomStream random(1, "asked", 0);
  for (int i = 0; i < 30; ++i) {
    const Drawn drawn = question(i);
    const auto ready = frames.ready(drawn.sound_W, drawn.p_WS, drawn.keep_lone);
    by_parts.insert(*ready);
    at_once.insert(frames.filter(drawn.keep_lone).thinned(drawn.sound_W), drawn.p_WS);
  }
  EXPECT_EQ(by_parts.occupied_cells(), at_once.occupied_cells());
  EXPECT_EQ(by_parts.revision(), at_once.revision());
  int free = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d p(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), random.uniform(0.0, 15.0));
    for (const int rays : {1, 3, 12, 20}) {
      ASSERT_EQ(by_parts.known_free(p, rays), at_once.known_free(p, rays)) << p.transpose() << ", " << rays;
      free += by_parts.known_free(p, rays) ? 1 : 0;
    }
  }
  EXPECT_GT(free, 1000);
}

}  // namespace
}  // namespace skein::agent
