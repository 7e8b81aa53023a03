#include "uav_agent/maps/world_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

Vector3d drawn_unit(RandomStream& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// The map as its header says it is, cube by cube and without a thought of speed.
class SlowMap {
 public:
  using Cube = std::tuple<int, int, int>;

  explicit SlowMap(const WorldMap::Config& config) : config_(config) {}

  /// nullopt: it passes so near to an edge that rounding decides; the maps need not agree.
  std::optional<std::vector<Cube>> windows(const Beam& beam) const {
    int axis = 0;
    beam.direction_W.cwiseAbs().maxCoeff(&axis);
    const Vector3d direction = beam.direction_W.cast<double>();
    const double end_m = std::min<double>(beam.free_m, config_.evidence_range_m);
    const double first = beam.from_W[axis], last = first + end_m * direction[axis];
    std::vector<Cube> cubes;
    for (double layer = std::floor(std::min(first, last) / config_.cell_m) - 1;
         layer * config_.cell_m < std::max(first, last); ++layer) {
      const double middle = (layer + 0.5) * config_.cell_m;
      const double way = (middle - first) / direction[axis];
      if (std::abs(way) < 1e-3 || std::abs(way - end_m) < 1e-3) return std::nullopt;
      if (way < 0.0 || way > end_m) continue;
      Vector3d at = (beam.from_W + way * direction) / config_.cell_m;
      for (int side = 1; side < 3; ++side) {
        const double place = at[(axis + side) % 3];
        if (std::abs(place - std::round(place)) < 1e-3) return std::nullopt;
      }
      cubes.emplace_back(std::floor(at.x()), std::floor(at.y()), std::floor(at.z()));
    }
    return cubes;
  }

  void insert(const std::vector<Beam>& beams) {
    for (const Beam& beam : beams) {
      if (!beam.returned) continue;
      const Vector3d hit =
          (beam.from_W + static_cast<double>(beam.free_m) * beam.direction_W.cast<double>()) / config_.cell_m;
      spaces_[{std::floor(hit.x()), std::floor(hit.y()), std::floor(hit.z())}] = Space::occupied;
    }
    for (const Beam& beam : beams) {
      int axis = 0;
      beam.direction_W.cwiseAbs().maxCoeff(&axis);
      const std::optional<std::vector<Cube>> passed = windows(beam);
      for (const Cube& cube : passed.value_or(std::vector<Cube>())) {
        if (spaces_.contains(cube)) continue;
        evidence_[cube].add(BeamEvidence(beam.direction_W, axis));
        const double window_m2 = config_.cell_m * config_.cell_m;
        if (evidence_[cube].unseen_probability(window_m2, config_.criterion) <= config_.criterion.unseen_p)
          enough_.insert({cube, evidence_[cube].beams()});
      }
    }
  }

  bool occupied(const Cube& cube) const { return spaces_.contains(cube); }
  /// With how many beams it was proved first, if it was.
  std::optional<int> proved_with(const Cube& cube) const {
    const auto found = enough_.find(cube);
    return found == enough_.end() ? std::nullopt : std::optional<int>(found->second);
  }
  int beams(const Cube& cube) const {
    const auto found = evidence_.find(cube);
    return found == evidence_.end() ? 0 : found->second.beams();
  }

 private:
  WorldMap::Config config_;
  std::map<Cube, Space> spaces_;
  std::map<Cube, BeamEvidence> evidence_;
  std::map<Cube, int> enough_;
};

/// Beams from some places about the origin, into all directions; some end in a wall, or anywhere.
std::vector<std::vector<Beam>> drawn_scans(std::uint64_t world, const SlowMap& slow) {
  RandomStream random(world, "world_map", 0);
  std::vector<std::vector<Beam>> scans(12);
  for (std::vector<Beam>& scan : scans) {
    const Vector3d from_W = random.uniform(0.0, 4.0) * drawn_unit(random);
    while (scan.size() < 4000) {
      Beam beam{from_W, drawn_unit(random).cast<float>(), static_cast<float>(random.uniform(4.0, 12.0)), false};
      if (beam.direction_W.x() > 0.2F) {
        beam.free_m = static_cast<float>((7.3 - from_W.x()) / beam.direction_W.x());
        beam.returned = true;
      }
      if (beam.free_m > 0.0F && slow.windows(beam)) scan.push_back(beam);
    }
  }
  return scans;
}

TEST(WorldMap, SaysWhatTheCriterionSaysOfEachCube) {
  std::size_t free = 0;
  for (std::uint64_t world = 1; world <= 2; ++world) {
    WorldMap::Config config;
    config.evidence_range_m = 9.0;
    WorldMap map(config);
    SlowMap slow(config);
    for (const std::vector<Beam>& scan : drawn_scans(world, slow)) {
      map.insert(scan);
      slow.insert(scan);
    }
    for (int x = -30; x < 30; ++x) {
      for (int y = -30; y < 30; ++y) {
        for (int z = -30; z < 30; ++z) {
          const SlowMap::Cube cube{x, y, z};
          const Space space = map.at((Vector3d(x, y, z) + Vector3d::Constant(0.5)) * config.cell_m);
          ASSERT_EQ(space == Space::occupied, slow.occupied(cube)) << world << ": " << x << " " << y << " " << z;
          if (space == Space::occupied) continue;
          const std::optional<int> proved = slow.proved_with(cube);
          // The map does not ask after each beam, but soon enough.
          if (space == Space::free) {
            ++free;
            ASSERT_TRUE(proved) << world << ": " << x << " " << y << " " << z;
          } else if (proved) {
            ASSERT_LT(slow.beams(cube), *proved + *proved / 4 + 14) << world << ": " << x << " " << y << " " << z;
          }
        }
      }
    }
  }
  EXPECT_GT(free, 2000u);
}

/// A cube of beams about the origin, dense enough to prove all of it.
std::vector<Beam> flood(double half_m) {
  std::vector<Beam> beams;
  for (double u = -half_m + 0.02; u < half_m; u += 0.04) {
    for (double v = -half_m + 0.02; v < half_m; v += 0.04) {
      const auto length = static_cast<float>(2.0 * half_m);
      beams.push_back({{u, v, -half_m}, Eigen::Vector3f::UnitZ(), length, false});
      beams.push_back({{-half_m, u, v}, Eigen::Vector3f::UnitX(), length, false});
    }
  }
  return beams;
}

TEST(WorldMap, AHitIsKeptWhateverPassesAndOpensWhatWasFree) {
  WorldMap map({});
  const std::vector<Beam> all = flood(4.0);
  for (int i = 0; i < 60; ++i) map.insert(all);  // long enough for blocks that are free all over to be taken back
  const std::size_t free = map.counts().free, bytes = map.counts().bytes;
  EXPECT_EQ(free, 16u * 16u * 16u);
  const Vector3d thing_W(1.1, 1.1, 1.1);
  const Beam hit{{1.1, 1.1, 5.0}, -Eigen::Vector3f::UnitZ(), 3.9F, true};
  map.insert(std::vector<Beam>{hit});
  EXPECT_EQ(map.at(thing_W), Space::occupied);
  EXPECT_EQ(map.counts().free, free - 1);
  EXPECT_EQ(map.at(thing_W + Vector3d(0.5, 0.0, 0.0)), Space::free) << "its neighbour in the same block";
  EXPECT_FALSE(map.tube_free({1.1, 1.1, -3.0}, {1.1, 1.1, 3.0}, 0.6));
  EXPECT_TRUE(map.tube_free({-2.1, 1.1, -3.0}, {-2.1, 1.1, 3.0}, 0.6));
  for (int i = 0; i < 60; ++i) map.insert(all);
  EXPECT_EQ(map.at(thing_W), Space::occupied);
  EXPECT_EQ(map.counts().free, free - 1);
  EXPECT_LE(map.counts().bytes, bytes) << "what is free all over costs nothing";
}

TEST(WorldMap, AUavMakesItsOwnPlaceFreeButNothingThatWasHit) {
  WorldMap map({});
  map.insert(std::vector<Beam>{{{0.0, 0.0, 3.0}, -Eigen::Vector3f::UnitZ(), 2.9F, true}});
  map.set_free({0.2, 0.2, 0.6}, 0.8);
  EXPECT_EQ(map.at({0.1, 0.1, 0.6}), Space::free);
  EXPECT_EQ(map.at({0.1, 0.1, 0.1}), Space::occupied);
  EXPECT_EQ(map.at({0.2, 0.2, 1.9}), Space::unknown);
}

/// Whoever flies on keeps what it knows, but no evidence of all that it ever passed.
TEST(WorldMap, WhatIsFarAndUnknownIsForgotten) {
  WorldMap::Config near, far;
  near.forget_m = 20.0;
  far.forget_m = 1e6;
  WorldMap forgets(near), remembers(far);
  const std::vector<Beam> here = flood(1.0);
  RandomStream random(1, "forget", 0);
  for (double x = 0.0; x < 240.0; x += 30.0) {
    std::vector<Beam> beams = here;
    for (Beam& beam : beams) beam.from_W.x() += x;
    for (int i = 0; i < 300; ++i) beams.push_back({{x, 0.0, 0.0}, drawn_unit(random).cast<float>(), 15.0F, false});
    for (int i = 0; i < 50; ++i) {
      forgets.insert(beams);
      remembers.insert(beams);
    }
  }
  for (double x = 0.0; x < 240.0; x += 30.0) EXPECT_EQ(forgets.at({x, 0.1, 0.1}), Space::free) << x;
  EXPECT_EQ(forgets.counts().free, remembers.counts().free);
  EXPECT_LT(3 * forgets.counts().blocks, 2 * remembers.counts().blocks);
}

}  // namespace
}  // namespace skein::agent
