#include "uav_agent/maps/world_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

Vector3d drawn_unit(RandomStream& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// The map as its header defines it, computed cube by cube without regard to speed.
class SlowMap {
 public:
  using Cube = std::tuple<int, int, int>;

  explicit SlowMap(const WorldMap::Config& config) : config_(config), levels_(config.to_m.size()) {}

  struct Windows {
    bool sure = true;  ///< false: the beam passes so near to an edge that rounding decides
    std::vector<Cube> cubes = {};
  };
  Windows windows(const BeamBundle& bundle, std::size_t level) const {
    const double cell_m = cell(level), from_m = level == 0 ? 0.0 : handed_over_m(bundle, level - 1);
    const double free_m = level == 0 ? bundle.free_m : bundle.around_free_m - cell_m;
    const double end_m = std::min<double>(free_m, handed_over_m(bundle, level));
    int axis = 0;
    bundle.direction_W.cwiseAbs().maxCoeff(&axis);
    const Vector3d direction = bundle.direction_W.cast<double>();
    const double first = bundle.from_W[axis], last = first + (config_.to_m[level] + 4.0 * cell_m) * direction[axis];
    Windows windows;
    for (double layer = std::floor(std::min(first, last) / cell_m) - 1; layer * cell_m < std::max(first, last);
         ++layer) {
      const double way = ((layer + 0.5) * cell_m - first) / direction[axis];
      if (std::abs(way - from_m) < 1e-3 || std::abs(way - end_m) < 1e-3) windows.sure = false;
      if (way < from_m || way > end_m) continue;
      Vector3d at = (bundle.from_W + way * direction) / cell_m;
      for (int side = 1; side < 3; ++side) {
        const double place = at[(axis + side) % 3];
        if (std::abs(place - std::round(place)) < 1e-3) windows.sure = false;
      }
      windows.cubes.emplace_back(std::floor(at.x()), std::floor(at.y()), std::floor(at.z()));
    }
    return windows;
  }

  void insert(const std::vector<BeamBundle>& bundles, const std::vector<Eigen::Vector3f>& hits_W) {
    for (const Eigen::Vector3f& hit_W : hits_W) hits_.insert(cube_of(hit_W.cast<double>(), 0));
    for (const BeamBundle& bundle : bundles) {
      int axis = 0;
      bundle.direction_W.cwiseAbs().maxCoeff(&axis);
      for (std::size_t level = 0; level < levels_.size(); ++level) {
        const auto per_m2 = static_cast<float>(bundle.beams / (cell(level) * cell(level)));
        for (const Cube& cube : windows(bundle, level).cubes) {
          Gathered& gathered = levels_[level][cube];
          gathered.evidence.add(BeamEvidence(bundle.direction_W, axis, per_m2));
          const bool enough = gathered.evidence.unseen_probability(config_.criterion) <= config_.criterion.unseen_p;
          if (enough && !gathered.proved_with) gathered.proved_with = gathered.evidence.per_m2();
        }
      }
    }
  }

  /// Distance at which the beam leaves a layer of the next larger cubes; of all layers, the one nearest to to_m.
  double handed_over_m(const BeamBundle& bundle, std::size_t level) const {
    const double to_m = config_.to_m[level];
    if (level + 1 == config_.to_m.size()) return to_m;
    int axis = 0;
    const double along = bundle.direction_W.cwiseAbs().maxCoeff(&axis);
    double best = 1e9;
    for (int layer = -40; layer <= 40; ++layer) {
      const double way = (layer * cell(level + 1) - bundle.from_W[axis]) / bundle.direction_W[axis];
      if (std::abs(way - to_m) * along < std::abs(best - to_m) * along) best = way;
    }
    return std::max(0.0, best);
  }

  bool occupied(const Vector3d& p_W) const { return hits_.contains(cube_of(p_W, 0)); }
  struct Gathered {
    BeamEvidence evidence = {};
    std::optional<double> proved_with = {};  ///< with how many beams it was proved first
  };
  Gathered gathered(const Vector3d& p_W, std::size_t level) const {
    const auto found = levels_[level].find(cube_of(p_W, level));
    return found == levels_[level].end() ? Gathered() : found->second;
  }

 private:
  double cell(std::size_t level) const { return config_.cell_m * (1 << level); }
  Cube cube_of(const Vector3d& p_W, std::size_t level) const {
    const Vector3d at = p_W / cell(level);
    return {std::floor(at.x()), std::floor(at.y()), std::floor(at.z())};
  }
  WorldMap::Config config_;
  std::set<Cube> hits_;
  std::vector<std::map<Cube, Gathered>> levels_;
};

struct DrawnScan {
  std::vector<BeamBundle> bundles;
  std::vector<Eigen::Vector3f> hits_W;
};

/// Beams from some places about the origin, into all directions; some end in a wall, or anywhere.
std::vector<DrawnScan> drawn_scans(std::uint64_t world, const SlowMap& slow, std::size_t levels) {
  RandomStream random(world, "world_map", 0);
  std::vector<DrawnScan> scans(12);
  for (DrawnScan& scan : scans) {
    const Vector3d from_W = random.uniform(0.0, 4.0) * drawn_unit(random);
    while (scan.bundles.size() < 1000) {
      const auto free_m = static_cast<float>(random.uniform(4.0, 24.0));
      BeamBundle bundle{from_W, drawn_unit(random).cast<float>(), free_m, 0.0F, random.uniform() < 0.5 ? 16 : 3};
      const bool returned = bundle.direction_W.x() > 0.2F;
      if (returned) bundle.free_m = static_cast<float>((7.3 - from_W.x()) / bundle.direction_W.x());
      bundle.around_free_m = static_cast<float>(random.uniform(0.7, 1.0)) * bundle.free_m;
      bool sure = bundle.free_m > 0.0F;
      for (std::size_t level = 0; level < levels; ++level) sure = sure && slow.windows(bundle, level).sure;
      if (!sure) continue;
      scan.bundles.push_back(bundle);
      if (returned) scan.hits_W.push_back(from_W.cast<float>() + bundle.free_m * bundle.direction_W);
    }
  }
  return scans;
}

TEST(WorldMap, JudgesEachCubeByTheCriterion) {
  for (const std::vector<double>& to_m : {std::vector<double>{9.0}, {5.0, 14.0}}) {
    std::vector<std::size_t> free(to_m.size());
    for (std::uint64_t world = 1; world <= 2; ++world) {
      WorldMap::Config config;
      config.to_m = to_m;
      config.criterion.unseen_p = 3e-3;
      WorldMap map(config);
      SlowMap slow(config);
      for (const DrawnScan& scan : drawn_scans(world, slow, to_m.size())) {
        map.insert(scan.bundles, scan.hits_W);
        slow.insert(scan.bundles, scan.hits_W);
      }
      for (int i = 0; i < 60 * 60 * 60; ++i) {
        const Eigen::Vector3i cube = Eigen::Vector3i(i % 60, i / 60 % 60, i / 3600) - Eigen::Vector3i::Constant(30);
        const Vector3d p_W = (cube.cast<double>() + Vector3d::Constant(0.5)) * config.cell_m;
        SCOPED_TRACE(testing::Message() << world << ": " << cube.transpose());
        const Space space = map.at(p_W);
        ASSERT_EQ(space == Space::occupied, slow.occupied(p_W));
        if (space == Space::occupied) continue;
        bool provable = false, proved = false;  // the map judges not after each beam, but soon
        BeamEvidence all;
        for (std::size_t level = 0; level < to_m.size(); ++level) {
          const SlowMap::Gathered gathered = slow.gathered(p_W, level);
          all.join(gathered.evidence);
          if (!gathered.proved_with) continue;
          if (space == Space::free) ++free[level];
          provable = true;
          proved = proved || gathered.evidence.per_m2() > 1.2 * *gathered.proved_with + 40.0;
        }
        provable = provable || all.unseen_probability(config.criterion) <= config.criterion.unseen_p;
        ASSERT_TRUE(provable || space != Space::free);
        ASSERT_TRUE(!proved || space == Space::free);
      }
    }
    for (const std::size_t cubes : free) EXPECT_GT(cubes, 500U);
  }
}

/// A cube of beams about the origin, dense enough to prove all of it.
std::vector<BeamBundle> flood(double half_m) {
  std::vector<BeamBundle> beams;
  for (double u = -half_m + 0.02; u < half_m; u += 0.04) {
    for (double v = -half_m + 0.02; v < half_m; v += 0.04) {
      const auto length = static_cast<float>(2.0 * half_m);
      beams.push_back({{u, v, -half_m}, Eigen::Vector3f::UnitZ(), length});
      beams.push_back({{-half_m, u, v}, Eigen::Vector3f::UnitX(), length});
    }
  }
  return beams;
}

TEST(WorldMap, AHitReplacesOneFreeCubeAndStaysWhenBeamsPassIt) {
  WorldMap map(WorldMap::Config{});
  const std::vector<BeamBundle> all = flood(4.0);
  for (int i = 0; i < 60; ++i) map.insert(all, {});  // long enough for tidy() to free blocks of free cells
  const std::size_t free = map.counts().free[0], blocks = map.counts().blocks;
  EXPECT_EQ(free, 16u * 16u * 16u);
  const Vector3d thing_W(1.1, 1.1, 1.1);
  map.insert({}, std::vector<Eigen::Vector3f>{thing_W.cast<float>()});
  EXPECT_EQ(map.at(thing_W), Space::occupied);
  EXPECT_EQ(map.counts().free[0], free - 1);
  EXPECT_EQ(map.at(thing_W + Vector3d(0.5, 0.0, 0.0)), Space::free) << "its neighbour in the same block";
  EXPECT_FALSE(map.tube_free({1.1, 1.1, -3.0}, {1.1, 1.1, 3.0}, 0.6));
  EXPECT_TRUE(map.tube_free({-2.1, 1.1, -3.0}, {-2.1, 1.1, 3.0}, 0.6));
  for (int i = 0; i < 60; ++i) map.insert(all, {});
  EXPECT_EQ(map.at(thing_W), Space::occupied);
  EXPECT_EQ(map.counts().free[0], free - 1);
  EXPECT_LE(map.counts().blocks, blocks + 1) << "blocks that are free all over take no memory";
}

TEST(WorldMap, AUavMakesItsOwnPlaceFreeButNothingThatWasHit) {
  WorldMap map(WorldMap::Config{});
  map.insert({}, std::vector<Eigen::Vector3f>{{0.0F, 0.0F, 0.1F}});
  map.set_free({0.2, 0.2, 0.6}, 0.8);
  EXPECT_EQ(map.at({0.1, 0.1, 0.6}), Space::free);
  EXPECT_EQ(map.at({0.1, 0.1, 0.1}), Space::occupied);
  EXPECT_EQ(map.at({0.2, 0.2, 1.9}), Space::unknown);
}

TEST(WorldMap, AVacatedPlaceIsUnknownUntilBeamsProveIt) {
  WorldMap map(WorldMap::Config{});
  const std::vector<Eigen::Vector3f> hits_W = {{3.1F, 0.1F, 0.1F}, {3.6F, 0.1F, 0.1F}, {6.1F, 0.1F, 0.1F}};
  map.insert({}, hits_W);
  map.vacate({3.3, 0.1, 0.1}, 0.8);
  EXPECT_EQ(map.at({3.1, 0.1, 0.1}), Space::unknown);
  EXPECT_EQ(map.at({3.6, 0.1, 0.1}), Space::unknown);
  EXPECT_EQ(map.at({6.1, 0.1, 0.1}), Space::occupied);
  EXPECT_EQ(map.counts().occupied, 1U);
  for (int i = 0; i < 20; ++i) map.insert(flood(4.0), {});
  EXPECT_EQ(map.at({3.1, 0.1, 0.1}), Space::free) << "beams may prove it again";
  map.insert({}, hits_W);
  EXPECT_EQ(map.at({3.1, 0.1, 0.1}), Space::occupied);
}

/// A doubt proves nothing at any level. After it, a cube needs as many beams as in a map that has seen none.
TEST(WorldMap, ADoubtedCubeLosesItsEvidenceAndAllOthersKeepTheirs) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "doubt", 0);
    WorldMap::Config config;
    if (seed % 3 != 0) config.to_m = {1.0, seed % 3 == 1 ? 2.0 : 16.0, 16.0};
    WorldMap map(config), fresh(config);
    std::vector<BeamBundle> some;
    for (const BeamBundle& beam : flood(4.0)) {
      if (random.uniform() < 0.15) some.push_back(beam);
    }
    for (BeamBundle& beam : some) beam.around_free_m = beam.free_m;
    const Vector3d thing_W(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    const Eigen::Vector3i cube = map.cube_of(thing_W);
    for (int before = static_cast<int>(random.uniform() * 30.0); before >= 0; --before) map.insert(some, {});
    map.insert({}, std::vector<Eigen::Vector3f>{thing_W.cast<float>()});
    std::vector<Space> known;
    const auto all = [&](const auto& visit) {
      for (int i = 0; i < 20 * 20 * 20; ++i) visit(Eigen::Vector3i(i % 20 - 10, i / 20 % 20 - 10, i / 400 - 10));
    };
    all([&](const Eigen::Vector3i& at) { known.push_back(map.known(at).space); });
    map.doubt(cube);
    std::size_t next = 0;
    all([&](const Eigen::Vector3i& at) { EXPECT_EQ(map.known(at).space, known[next++]) << at.transpose(); });
    int needed = 0;
    while (fresh.known(cube).space != Space::free && ++needed < 200) {
      fresh.insert(some, {});
      EXPECT_EQ(map.known(cube).space, Space::occupied) << seed << " after " << needed;
      map.insert(some, {});
    }
    ASSERT_LT(needed, 200) << seed;
    EXPECT_EQ(map.known(cube).space, Space::free) << seed;
    EXPECT_EQ(map.structure_distance_m(thing_W), 4.0);
    map.insert({}, std::vector<Eigen::Vector3f>{thing_W.cast<float>()});
    map.doubt(cube);
    map.insert({}, std::vector<Eigen::Vector3f>{thing_W.cast<float>()});
    for (int i = 0; i < needed; ++i) map.insert(some, {});
    EXPECT_EQ(map.known(cube).space, Space::occupied) << "beams hit it again";
  }
}

/// A UAV that flies on keeps its known cells, but not the evidence of all cells that it has ever passed.
TEST(WorldMap, TheEvidenceOfFarUnknownSpaceIsForgotten) {
  WorldMap::Config config;
  config.to_m = {10.0};
  WorldMap map(config);
  const std::vector<BeamBundle> here = flood(1.0);
  RandomStream random(1, "forget", 0);
  std::size_t most = 0;
  for (double x = 0.0; x < 240.0; x += 30.0) {
    std::vector<BeamBundle> beams = here;
    for (BeamBundle& beam : beams) beam.from_W.x() += x;
    for (int i = 0; i < 300; ++i) beams.push_back({{x, 0.0, 0.0}, drawn_unit(random).cast<float>(), 10.0F});
    for (int i = 0; i < 50; ++i) map.insert(beams, {});
    if (x < 30.0) most = map.counts().blocks;
  }
  for (double x = 0.0; x < 240.0; x += 30.0) EXPECT_EQ(map.at({x, 0.1, 0.1}), Space::free) << x;
  EXPECT_LT(map.counts().blocks, 5 * most) << "eight times as many blocks were passed";
}

/// When the UAV comes nearer to a cube, the smaller cubes in it inherit its evidence, and free space remains free.
TEST(WorldMap, SmallerCubesInheritTheEvidenceOfLargerOnes) {
  const auto beams_until_free = [](double beams_from_afar) {
    WorldMap map(WorldMap::Config{});
    std::vector<BeamBundle> beams;  // along x and y through the origin, 12 m away, and then 4 m
    const auto all = [&](double distance_m) {
      beams.clear();
      for (double u = -2.9; u < 3.0; u += 0.2) {
        for (double v = -2.9; v < 3.0; v += 0.2) {
          beams.push_back({{-distance_m, u, v}, Eigen::Vector3f::UnitX(), 40.0F, 40.0F, 2});
          beams.push_back({{u, -distance_m, v}, Eigen::Vector3f::UnitY(), 40.0F, 40.0F, 2});
        }
      }
      return beams;
    };
    for (int i = 0; i < beams_from_afar; ++i) map.insert(all(12.0), {});
    int more = 0;
    for (; map.at({0.2, 0.2, 0.2}) != Space::free && more < 100; ++more) map.insert(all(4.0), {});
    return more;
  };
  const int alone = beams_until_free(0);
  EXPECT_GE(alone, 3);
  EXPECT_LT(alone, 20);
  EXPECT_LT(beams_until_free(alone / 2), alone);
  EXPECT_EQ(beams_until_free(2 * alone), 0);
}

/// Received information counts only where it is new, and the map remembers its sender.
TEST(WorldMap, RemembersTheTellerOfEachCube) {
  WorldMap map(WorldMap::Config{});
  const Eigen::Vector3i near(1, 1, 1);
  map.set_free({0.7, 0.7, 0.7}, 0.1);
  map.hear(near, 0, Space::free, 3);
  EXPECT_EQ(map.known(near).teller, kOwn);
  map.hear({10, 10, 10}, 2, Space::free, 3);
  EXPECT_EQ(map.known({40, 41, 43}).space, Space::free);
  EXPECT_EQ(map.known({40, 41, 43}).teller, 3);
  EXPECT_EQ(map.known({39, 41, 43}).space, Space::unknown);
  map.hear({41, 41, 41}, 0, Space::occupied, 2);
  EXPECT_EQ(map.known({41, 41, 41}).space, Space::occupied);
  EXPECT_EQ(map.known({41, 41, 41}).teller, 2);
  map.hear({41, 41, 41}, 0, Space::free, 3);
  map.hear({10, 10, 10}, 2, Space::free, 3);
  EXPECT_EQ(map.known({41, 41, 41}).space, Space::occupied);
  map.hear({42, 41, 41}, 0, Space::free, 4);
  EXPECT_EQ(map.known({42, 41, 41}).teller, 3) << "the first sender";
  WorldMap::Chunk chunk;
  for (const Eigen::Vector3i& at : {Eigen::Vector3i(0, 0, 0), Eigen::Vector3i(5, 5, 5), Eigen::Vector3i(4, 5, 5)}) {
    map.read(at, chunk);
    for (int i = 0; i < MapLevel::kCells; ++i) {
      const Eigen::Vector3i cube = 8 * at + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64);
      EXPECT_EQ(chunk[static_cast<std::size_t>(i)].space, map.known(cube).space) << cube.transpose();
      EXPECT_EQ(chunk[static_cast<std::size_t>(i)].teller, map.known(cube).teller) << cube.transpose();
    }
  }
}

TEST(WorldMap, NumbersTheLastChangeOfEachChunkAndRegion) {
  WorldMap map(WorldMap::Config{});
  EXPECT_EQ(map.changed_at({0, 0, 0}), 0U);
  map.set_free({1.0, 1.0, 1.0}, 0.3);
  const std::uint64_t first = map.changed_at({0, 0, 0});
  EXPECT_GT(first, 0U);
  EXPECT_EQ(map.region_changed_at({0, 0, 0}), first);
  map.hear({-3, 0, 0}, 2, Space::free, 1);  // from 6 m to 4 m to the west, in chunk -2
  EXPECT_EQ(map.changed_at({0, 0, 0}), first);
  EXPECT_GT(map.changed_at({-2, 0, 0}), first);
  EXPECT_GT(map.region_changed_at({-1, 0, 0}), first);
  for (int i = 0; i < WorldMap::kRegionChunks; ++i) {
    const WorldMap::Cube chunk = WorldMap::chunk_of({-1, 0, 0}, i);
    EXPECT_EQ(map.chunks_changed_at({-1, 0, 0})[WorldMap::place_in_region(chunk)], map.changed_at(chunk)) << i;
  }
  EXPECT_EQ(map.regions(), (std::vector<Eigen::Vector3i>{{0, 0, 0}, {-1, 0, 0}}));
  const std::uint64_t last = map.region_changed_at({-1, 0, 0});
  map.hear({-3, 0, 0}, 2, Space::free, 1);
  EXPECT_EQ(map.region_changed_at({-1, 0, 0}), last) << "the same message again changes nothing";
  EXPECT_EQ(map.regions().size(), 2U);
}

TEST(WorldMap, MeasuresTheDistanceToStructureThatComesAndGoes) {
  WorldMap map(WorldMap::Config{});
  const Vector3d p_W(0.1, 0.1, 5.1);
  EXPECT_EQ(map.structure_distance_m(p_W), 4.0);
  map.insert({}, std::vector<Eigen::Vector3f>{{3.1F, 0.1F, 5.1F}});  // cubes between: 0.5 m to 3 m
  EXPECT_DOUBLE_EQ(map.structure_distance_m(p_W), 2.5);
  map.hear(map.cube_of({0.1, 1.6, 5.1}), 0, Space::occupied, 2);
  EXPECT_DOUBLE_EQ(map.structure_distance_m(p_W), 1.0);
  map.vacate({0.1, 1.6, 5.1}, 0.2);
  EXPECT_DOUBLE_EQ(map.structure_distance_m(p_W), 2.5);
  EXPECT_DOUBLE_EQ(map.structure_distance_m({3.1, 0.1, 5.1}), 0.0);
}

}  // namespace
}  // namespace skein::agent
