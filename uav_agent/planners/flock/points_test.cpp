// The points of the planner flock, and their exchange by radio.
#include "uav_agent/planners/flock/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/three_uavs.hpp"

namespace skein::agent {
namespace {

std::vector<DetectedPoint> drawn_points(RandomStream& random, int count, double reach_m = 60.0) {
  std::vector<DetectedPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto along = [&] { return static_cast<float>(random.uniform(-reach_m, reach_m)); };
    Eigen::Vector3f normal(along(), along(), along());
    points.push_back(
        {{along(), along(), along()}, random.uniform(0.2, 1.0), static_cast<std::uint32_t>(i), normal.normalized()});
  }
  return points;
}

/// Best quality by place, rounded to the step in which messages state it.
std::map<std::array<long, 3>, long> qualities(const FlockPoints& points) {
  std::map<std::array<long, 3>, long> all;
  for (const FlockPoint& point : points.all()) {
    const Eigen::Vector3d cm = (100.0 * point.p_W).array().floor();
    all[{std::lround(cm.x()), std::lround(cm.y()), std::lround(cm.z())}] = std::lround(50.0 * point.q);
  }
  return all;
}

/// All UAVs of a fleet of three send their points, again and again, and lose half of all messages.
void talk(std::vector<FlockPoints>& uavs, RandomStream& random, int rounds, Tick& now) {
  for (int round = 0; round < rounds; ++round, now += 200) {
    for (std::size_t from = 0; from < uavs.size(); ++from) {
      PayloadWriter writer;
      uavs[from].write(all_in_sight(three_uavs(from)), now, 1500, writer);
      ASSERT_LE(writer.size(), kMaxPayloadBytes);
      for (std::size_t to = 0; to < uavs.size(); ++to) {
        PayloadReader reader(writer.data());
        if (to == from || random.bits() % 2 == 0) continue;
        EXPECT_TRUE(uavs[to].read(from, now, reader));
      }
    }
  }
}

/// Each of three UAVs found points, some of them the same. In the end, all UAVs know the best quality of each point.
/// Then one of them is restarted, and gets everything back.
TEST(FlockPoints, AllUavsEndUpWithTheBestQualitiesWhateverMessagesAreLost) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "points", 0);
    std::vector<FlockPoints> uavs(3);
    std::map<std::array<long, 3>, long> best;
    const std::vector<DetectedPoint> scene = drawn_points(random, 200);
    for (FlockPoints& points : uavs) {
      std::vector<DetectedPoint> own;
      for (DetectedPoint point : scene) {
        point.score = random.uniform(0.2, 1.0);
        if (random.bits() % 2 == 0) own.push_back(point);
      }
      points.detect(own, Vector3d::Zero());
      for (const auto& [place, q] : qualities(points)) best[place] = std::max(best[place], q);
    }
    Tick now = 0;
    talk(uavs, random, 80, now);
    for (const FlockPoints& points : uavs) EXPECT_EQ(qualities(points), best) << "seed " << seed;
    uavs[1] = FlockPoints();
    talk(uavs, random, 80, now);
    EXPECT_EQ(qualities(uavs[1]), best) << "seed " << seed;
  }
}

/// Each UAV sees the scene displaced by its own error, which drifts. The points are far enough apart to be told apart.
/// All UAVs end up with one entry for nearly every point, with the best quality of all.
TEST(FlockPoints, DriftMakesNoNewPoints) {
  constexpr double kSigmaM = 0.2, kSpacingM = 3.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "drift", 0);
    std::vector<DetectedPoint> scene;
    for (int i = 0; i < 200; ++i) {  // a wall
      const double y = kSpacingM * (i % 20) + random.uniform(-0.7, 0.7), z = kSpacingM * (i / 20.0) + 2.0;
      scene.push_back({Vector3d(20.0, y, z).cast<float>(), 0.0, 0, {-1.0F, 0.0F, 0.0F}});
    }
    const double merge_m = 2.0 * std::sqrt(2.0) * kSigmaM;
    std::vector<FlockPoints> uavs(3, FlockPoints(merge_m)), exact(3);
    std::vector<Vector3d> errors(3, Vector3d::Zero());
    std::vector<std::map<std::size_t, std::uint32_t>> orders(3);
    std::vector<double> best(scene.size(), 0.0);
    std::vector<std::vector<double>> own(3, best);
    Tick now = 0;
    for (int round = 0; round < 40; ++round) {
      for (std::size_t uav = 0; uav < 3; ++uav) {
        for (double& along : errors[uav])
          along = 0.95 * along + std::sqrt(1.0 - 0.95 * 0.95) * kSigmaM * random.normal();
        std::vector<DetectedPoint> seen;
        for (std::size_t i = 0; i < scene.size(); ++i) {
          if (random.bits() % 8 != 0 || (i + uav) % 3 == 0) continue;  // no UAV sees all
          DetectedPoint point = scene[i];
          point.p_W += errors[uav].cast<float>();
          point.order = orders[uav].emplace(i, orders[uav].size()).first->second;
          point.score = own[uav][i] = std::max(own[uav][i], random.uniform(0.2, 1.0));
          best[i] = std::max(best[i], point.score);
          seen.push_back(point);
        }
        uavs[uav].detect(seen, Vector3d::Zero());
        exact[uav].detect(seen, Vector3d::Zero());
      }
      talk(uavs, random, 1, now);
    }
    talk(uavs, random, 80, now);
    EXPECT_GT(exact[0].all().size(), 2 * scene.size()) << "each detection is a point of its own";
    for (const FlockPoints& points : uavs) {
      EXPECT_NEAR(static_cast<double>(points.all().size()), static_cast<double>(scene.size()), 0.2 * scene.size());
      std::size_t found = 0;
      for (std::size_t i = 0; i < scene.size(); ++i) {
        found += std::ranges::any_of(points.all(), [&](const FlockPoint& point) {
          return (point.p_W - scene[i].p_W.cast<double>()).norm() < 1.0 && std::abs(point.q - best[i]) < 0.03;
        });
      }
      EXPECT_GT(found, 0.9 * scene.size()) << "seed " << seed;
    }
  }
}

/// A dense region has more points than a message has room for.
TEST(FlockPoints, DenseRegionsAreSentInSlices) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "points", 1);
    std::vector<FlockPoints> uavs(3);
    uavs[0].detect(drawn_points(random, 1500, 8.0), Vector3d::Zero());
    uavs[1].detect(drawn_points(random, 60), Vector3d::Zero());
    Tick now = 0;
    talk(uavs, random, 160, now);
    EXPECT_GT(uavs[2].all().size(), 1000U) << "seed " << seed;
    for (const FlockPoints& points : uavs) EXPECT_EQ(qualities(points), qualities(uavs[2])) << "seed " << seed;
  }
}

/// A dense region is sent in slices, while a changing number of other regions have news in each round. The sender still
/// sends every point of the dense region and the news of the others.
TEST(FlockPoints, EverySliceIsSentEvenIfOtherRegionsKeepChanging) {
  constexpr std::size_t kRoom = 1500, kPointsInRoom = kRoom / 10;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomStream random(seed, "slices", 0);
    const int count = 160 + static_cast<int>(random.bits() % 600),
              most_others = 1 + static_cast<int>(random.bits() % 6);
    std::vector<DetectedPoint> dense = drawn_points(random, count, 7.9);
    const bool goes_last = random.bits() % 3 != 0;  // of the regions, in the order of their cells
    const float x = goes_last ? 72.0F : -200.0F;
    for (DetectedPoint& point : dense) point.p_W += Eigen::Vector3f(x, 8.0F, 8.0F);
    FlockPoints sender, receiver;
    sender.detect(dense, Vector3d::Zero());
    const auto told_dense = [&](const FlockPoints& points) {
      return std::ranges::count_if(points.all(),
                                   [&](const FlockPoint& point) { return std::abs(point.p_W.x() - x) < 8.0; });
    };
    const std::size_t slices = static_cast<std::size_t>(count) / kPointsInRoom + 1;
    const std::size_t rounds = 2 * (slices + 2) * static_cast<std::size_t>(most_others + 1);
    int others = 1, next_change = 0;
    Tick now = 0;
    for (std::size_t round = 0; round < rounds; ++round, now += 200) {
      if (next_change-- == 0) {  // changes in how many regions there are news in each round
        others = 1 + static_cast<int>(random.bits() % static_cast<std::uint64_t>(most_others));
        next_change = static_cast<int>(random.bits() % 12);
      }
      std::vector<DetectedPoint> news = drawn_points(random, others, 7.9);
      for (int i = 0; i < others; ++i) {
        news[static_cast<std::size_t>(i)].p_W += Eigen::Vector3f(-104.0F + 16.0F * static_cast<float>(i), 8.0F, 8.0F);
      }
      sender.detect(news, Vector3d::Zero());
      PayloadWriter hashes, told;
      receiver.write(all_in_sight(three_uavs(1)), now, 0, hashes);
      PayloadReader asked(hashes.data());
      ASSERT_TRUE(sender.read(1, now, asked));
      sender.write(all_in_sight(three_uavs(0)), now, kRoom, told);
      PayloadReader heard(told.data());
      ASSERT_TRUE(receiver.read(0, now, heard));
    }
    EXPECT_EQ(told_dense(receiver), told_dense(sender)) << "seed " << seed;
    EXPECT_GT(receiver.all().size() + 60, sender.all().size()) << "seed " << seed;
  }
}

TEST(FlockPoints, DetectionsGainWhatTheyAddToTheKnownQualities) {
  for (const double merge_m : {0.0, 1.0}) {
    RandomStream random(1, "gains", 0);
    FlockPoints points(merge_m);
    const auto sum = [&] {
      double all = 0.0;
      for (const FlockPoint& point : points.all()) all += point.q;
      return all;
    };
    std::vector<DetectedPoint> drawn = drawn_points(random, 60);
    for (int round = 0; round < 20; ++round) {
      const double before = sum();
      for (DetectedPoint& point : drawn) point.score = random.uniform(0.0, 1.0);
      const double gained = points.detect(drawn, Vector3d::Zero());
      EXPECT_NEAR(gained, sum() - before, 1e-9);
      EXPECT_EQ(points.detect(drawn, Vector3d::Zero()), 0.0) << "the same pictures again";
    }
  }
}

TEST(FlockPoints, ADetectionWithoutAPlaceIsLeftOut) {
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e9F}) {
    for (int axis = 0; axis < 3; ++axis) {
      DetectedPoint point{{1, 2, 3}, 0.5, 0, {0, 0, 1}};
      point.p_W[axis] = wrong;
      FlockPoints points;
      points.detect(std::array{point}, Vector3d::Zero());
      EXPECT_TRUE(points.all().empty()) << point.p_W.transpose();
    }
  }
}

/// A damaged message yields valid points or none.
TEST(FlockPoints, DamagedMessagesDoNoHarm) {
  RandomStream random(11, "damage", 0);
  FlockPoints sender;
  sender.detect(drawn_points(random, 60), Vector3d::Zero());
  PayloadWriter writer;
  FlockPoints hungry;
  PayloadWriter request;
  hungry.write(all_in_sight(three_uavs(1)), 0, 1000, request);
  PayloadReader asked(request.data());
  ASSERT_TRUE(sender.read(1, 0, asked));
  sender.write(all_in_sight(three_uavs(0)), 0, 4000, writer);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::uint8_t> bytes = writer.data();
    bytes.resize(1 + random.bits() % bytes.size());
    for (int flips = 0; flips < 4; ++flips) bytes[random.bits() % bytes.size()] ^= 1U << random.bits() % 8;
    FlockPoints points;
    PayloadReader reader(bytes);
    points.read(0, 0, reader);
    for (const FlockPoint& point : points.all()) {
      EXPECT_TRUE(point.p_W.allFinite());
      EXPECT_NEAR(point.n_W.norm(), 1.0, 1e-9);
      EXPECT_GE(point.q, 0.0);
      EXPECT_LE(point.q, 1.0);
    }
  }
}

}  // namespace
}  // namespace skein::agent
