#include "uav_agent/planning/own_strips.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace skein::agent {
namespace {

WorkShare drawn_share(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> metres(-40.0, 40.0);
  WorkShare share;
  for (std::size_t i = 0; i < count; ++i) {
    Strip strip;
    strip.begin_W = {metres(random), metres(random), 20.0};
    strip.end_W = strip.begin_W + Vector3d(0.0, 0.0, 10.0);
    share.strips.push_back(strip);
    share.tour.push_back({i, false});
  }
  return share;
}

TEST(OwnStrips, EachStripComesOnceBeforeAnyComesAgain) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    OwnStrips strips(drawn_share(seed, 12));
    Vector3d at_W = Vector3d::Zero();
    for (int look = 0; look < 3; ++look) {
      std::set<std::size_t> flown;
      for (int i = 0; i < 12; ++i) {
        const auto next = strips.next(0, at_W);
        ASSERT_TRUE(next);
        EXPECT_EQ(strips.times_flown(*next), look);
        flown.insert(*next);
        strips.flown(*next);
        at_W = strips.begins_at_end(*next, at_W) ? strips.strip(*next).begin_W : strips.strip(*next).end_W;
      }
      EXPECT_EQ(flown.size(), 12U);
    }
  }
}

TEST(OwnStrips, TheNearestEndComesFirst) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    OwnStrips strips(drawn_share(seed, 12));
    const Vector3d at_W(1.0, 2.0, 25.0);
    const std::size_t next = *strips.next(0, at_W);
    const auto off_m = [&](std::size_t i) {
      return std::min((strips.strip(i).begin_W - at_W).norm(), (strips.strip(i).end_W - at_W).norm());
    };
    for (std::size_t i = 0; i < 12; ++i) EXPECT_LE(off_m(next), off_m(i));
    EXPECT_EQ(strips.begins_at_end(next, at_W), off_m(next) < (strips.strip(next).begin_W - at_W).norm());
  }
}

TEST(OwnStrips, AFailedStripComesAgainLater) {
  OwnStrips strips(drawn_share(3, 2));
  const std::size_t first = *strips.next(0, Vector3d::Zero());
  strips.failed(first, 0);
  const std::size_t second = *strips.next(0, Vector3d::Zero());
  EXPECT_NE(second, first);
  strips.failed(second, 0);
  EXPECT_FALSE(strips.next(0, Vector3d::Zero()));
  EXPECT_EQ(strips.next(ticks(60.0), Vector3d::Zero()), first);
}

}  // namespace
}  // namespace skein::agent
