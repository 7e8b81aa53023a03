#include "uav_agent/maps/uav_traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr Tick kTraceExchange = 20;

AgentConfig traced_fleet() {
  AgentConfig config;
  config.fleet.resize(3);
  config.fleet[1].p_WB_start = {10.0, 0.0, 0.0};
  config.fleet[2].p_WB_start = {-10.0, 0.0, 0.0};
  return config;
}

/// UAV 0 with its map. The link to UAV 1 comes and goes, and UAV 2 is heard all the time.
class UavTracesTest : public testing::Test {
 protected:
  UavTracesTest() {
    map_.on_met([this](const Eigen::Vector3i& cube, bool news) { traces_.met(cube, news); });
  }

  /// One exchange.   @param p_W, v_W  what UAV 1 reports; nullopt: it is not heard, or reports no velocity.
  void exchange(const std::optional<Vector3d>& p_W, const std::vector<Vector3d>& hits_W = {},
                const std::optional<Vector3d>& v_W = Vector3d(Vector3d::Zero())) {
    now_ += kTraceExchange;
    std::vector<Neighbour> neighbours = {{node_of_uav(UavIndex{2}), {-10.0, 0.0, 0.0}}};
    if (p_W) neighbours.insert(neighbours.begin(), {node_of_uav(UavIndex{1}), *p_W, v_W});
    peers_.update(now_, neighbours);
    traces_.update(now_, peers_);
    std::vector<Eigen::Vector3f> hits;
    for (const Vector3d& hit_W : hits_W) hits.push_back(hit_W.cast<float>());
    map_.insert({}, hits);
    traces_.doubt(map_);
  }
  void wait(const std::optional<Vector3d>& p_W, double time_s) {
    for (int i = 0; i < time_s * 20.0; ++i) exchange(p_W);
  }
  bool doubted(const Vector3d& p_W) const { return map_.doubted(map_.cube_of(p_W)); }

  /// Some points that a LiDAR sees on a body.
  std::vector<Vector3d> body(const Vector3d& p_W) {
    std::vector<Vector3d> hits_W;
    for (int i = 0; i < 12; ++i) {
      const Vector3d direction(random_.normal(), random_.normal(), random_.normal());
      hits_W.push_back(p_W + 0.6 * random_.uniform() * direction.normalized());
    }
    return hits_W;
  }
  Vector3d drawn_place() {
    return {random_.uniform(-15.0, 15.0), random_.uniform(-15.0, 15.0), random_.uniform(5.0, 25.0)};
  }

  RandomStream random_{1, "uav_traces", 0};
  WorldMap map_{WorldMap::Config()};
  UavTraces traces_{traced_fleet(), 0.5};
  Peers peers_{traced_fleet()};
  Tick now_ = 0;
};

TEST_F(UavTracesTest, HitsWhereAUavMayHaveFlownUnheardAreDoubtedOnceItIsHeardAgain) {
  for (int drawn = 0; drawn < 40; ++drawn) {
    map_ = WorldMap(WorldMap::Config());
    map_.on_met([this](const Eigen::Vector3i& cube, bool news) { traces_.met(cube, news); });
    const Vector3d from_W = drawn_place(), to_W = drawn_place();
    wait(std::nullopt, 1.0);
    wait(from_W, 4.0);
    std::vector<Vector3d> met_W;
    const double speed_mps = random_.uniform(0.0, 6.0), length_m = (to_W - from_W).norm();
    const bool seen_all_the_time = random_.uniform() < 0.5;
    double way_m = 0.0;
    for (int i = 0; way_m < length_m && i < 200; ++i, way_m += speed_mps / 20.0) {
      const Vector3d p_W = from_W + std::min(1.0, way_m / length_m) * (to_W - from_W);
      const bool seen = seen_all_the_time || i % 60 < 10;
      const std::vector<Vector3d> hits_W = seen ? body(p_W) : std::vector<Vector3d>();
      met_W.insert(met_W.end(), hits_W.begin(), hits_W.end());
      exchange(std::nullopt, hits_W);
    }
    const Vector3d found_W = from_W + std::min(1.0, way_m / length_m) * (to_W - from_W);
    std::size_t occupied = 0, doubts = 0;
    for (const Vector3d& p_W : met_W) EXPECT_FALSE(doubted(p_W)) << "it is not heard yet";
    wait(found_W, 4.0);
    for (const Vector3d& p_W : met_W) {
      EXPECT_EQ(map_.at(p_W), Space::occupied) << "nothing has proved it to be free";
      ++occupied;
      doubts += doubted(p_W);
    }
    if (map_.counts().occupied > UavTraces::kMostInTrace) continue;
    EXPECT_EQ(doubts, occupied) << drawn;
  }
}

TEST_F(UavTracesTest, HitsThatCannotBeTheUavAreNotDoubted) {
  const Vector3d p_W(10.0, 0.0, 10.0), there_W(15.0, 0.0, 10.0);
  const std::vector<Vector3d> too_far_W = {{p_W.x(), 60.0, 10.0}};
  std::vector<Vector3d> pole_W, before_W = {{10.0, 5.0, 20.0}}, beside_W = {{10.4, 5.6, 20.4}};
  for (double z = 5.0; z < 9.0; z += 0.2) pole_W.emplace_back(10.0, -6.0, z);
  const std::vector<Vector3d> met_again_W = {{10.0, -9.0, 14.0}}, met_late_W = {{5.0, 0.0, 10.0}};
  const std::vector<Vector3d> good_W = body({13.0, 3.0, 10.0});
  wait(p_W, 3.0);
  exchange(p_W, before_W);
  exchange(std::nullopt, too_far_W);
  wait(std::nullopt, 4.0);
  exchange(std::nullopt, pole_W);
  exchange(std::nullopt, beside_W);
  exchange(std::nullopt, met_again_W);
  exchange(std::nullopt, good_W);
  wait(std::nullopt, 4.0);
  exchange(std::nullopt, met_late_W);
  exchange(there_W, met_again_W);
  exchange(there_W, met_again_W);
  wait(there_W, 4.0);
  for (const Vector3d& hit_W : good_W) EXPECT_TRUE(doubted(hit_W)) << hit_W.transpose();
  EXPECT_FALSE(doubted(too_far_W[0])) << "it would have flown too fast to there";
  EXPECT_FALSE(doubted(met_late_W[0])) << "it would have flown too fast from there";
  EXPECT_FALSE(doubted(before_W[0])) << "it was heard then";
  EXPECT_FALSE(doubted(beside_W[0])) << "it touches what was there before";
  EXPECT_FALSE(doubted(met_again_W[0])) << "it was met when the UAV was elsewhere";
  for (const Vector3d& hit_W : pole_W) EXPECT_FALSE(doubted(hit_W)) << "it is longer than a UAV";
}

TEST_F(UavTracesTest, HitsOnAUavThatIsNeverHeardAgainStayStructure) {
  const std::vector<Vector3d> hits_W = body({12.0, 0.0, 10.0});
  wait(Vector3d(10.0, 0.0, 10.0), 3.0);
  exchange(std::nullopt, hits_W);
  wait(std::nullopt, 60.0);
  for (const Vector3d& hit_W : hits_W) EXPECT_FALSE(doubted(hit_W));
}

TEST_F(UavTracesTest, AFlickeringLinkIsOneAbsence) {
  const Vector3d p_W(12.0, 0.0, 10.0);
  wait(p_W, 3.0);
  std::vector<Vector3d> met_W;
  for (int i = 0; i < 100; ++i) {
    const bool heard = random_.uniform() < 0.7;
    const std::vector<Vector3d> hits_W = heard ? std::vector<Vector3d>() : body(p_W);
    met_W.insert(met_W.end(), hits_W.begin(), hits_W.end());
    exchange(heard ? std::optional(p_W) : std::nullopt, hits_W);
  }
  wait(p_W, 4.0);
  for (const Vector3d& hit_W : met_W) EXPECT_TRUE(doubted(hit_W));
}

TEST_F(UavTracesTest, HitsOnAUavThatReportedWrongPositionsAreDoubted) {
  for (int drawn = 0; drawn < 40; ++drawn) {
    map_ = WorldMap(WorldMap::Config());
    map_.on_met([this](const Eigen::Vector3i& cube, bool news) { traces_.met(cube, news); });
    const bool stuck = drawn % 2 == 0;
    const Vector3d direction = Vector3d(random_.normal(), random_.normal(), random_.normal()).normalized();
    const Vector3d offset_W = direction * random_.uniform(1.5, 4.0);
    const Vector3d v_W = direction.unitOrthogonal() * random_.uniform(stuck ? 1.5 : 0.0, 4.0);
    const int wrong_exchanges = static_cast<int>(20.0 * random_.uniform(1.0, stuck ? 4.0 : 25.0));
    Vector3d p_W = drawn_place();
    wait(std::nullopt, 1.0);
    wait(p_W, 4.0);
    exchange(p_W, {}, v_W);
    const Vector3d stuck_W = p_W;
    std::vector<Vector3d> met_W;
    for (int i = 0; i < wrong_exchanges; ++i) {
      p_W += v_W * 0.05;
      const Vector3d told_W = stuck ? stuck_W : Vector3d(p_W + offset_W);
      // Near the place that a UAV reports, returns count as its body. Elsewhere, they count as structure.
      const bool taken = (told_W - p_W).norm() > 1.2 && i % 10 == 0;
      const std::vector<Vector3d> hits_W = taken ? body(p_W) : std::vector<Vector3d>();
      met_W.insert(met_W.end(), hits_W.begin(), hits_W.end());
      exchange(told_W, hits_W, v_W);
    }
    for (int i = 0; i < 60; ++i) exchange(p_W += v_W * 0.05, {}, v_W);
    for (const Vector3d& hit_W : met_W) EXPECT_FALSE(doubted(hit_W)) << "it may still report wrong positions";
    wait(p_W, 35.0);
    if (map_.counts().occupied > UavTraces::kMostInTrace) continue;
    for (const Vector3d& hit_W : met_W) EXPECT_TRUE(doubted(hit_W)) << drawn << ": " << hit_W.transpose();
  }
}

// Otherwise isolated structure would be doubted wherever UAVs turn, brake, or report with noise.
TEST_F(UavTracesTest, AUavThatReportsRightPositionsCountsAsHeard) {
  for (int drawn = 0; drawn < 20; ++drawn) {
    Vector3d p_W = drawn_place(), v_W = Vector3d::Zero(), to_mps = Vector3d::Zero();
    wait(std::nullopt, 1.0);
    wait(p_W, 4.0);
    for (int i = 0; i < 1200; ++i) {
      if (i % 40 == 0) to_mps = 5.0 * Vector3d(random_.normal(), random_.normal(), random_.normal()).normalized();
      const Vector3d v_before = v_W;
      v_W += std::min(1.0, 6.0 * 0.05 / std::max(1e-9, (to_mps - v_W).norm())) * (to_mps - v_W);
      p_W += 0.025 * (v_before + v_W);
      exchange(p_W, body(p_W + Vector3d(8.0, 0.0, 0.0)), v_W);
    }
    EXPECT_EQ(traces_.cubes(), 0U) << drawn;
  }
}

// The agent estimates the velocity from the positions, and begins with zero after each gap.
TEST_F(UavTracesTest, AUavThatReportsNoVelocitiesCountsAsHeardAfterAGapAtAnySpeed) {
  for (int drawn = 0; drawn < 30; ++drawn) {
    Vector3d p_W = drawn_place();
    const Vector3d direction(random_.normal(), random_.normal(), random_.normal());
    const Vector3d v_W = direction.normalized() * (drawn % 3 == 0 ? 6.0 : random_.uniform(0.0, 6.0));
    wait(std::nullopt, 1.0);
    for (int gaps = 0; gaps < 3; ++gaps) {
      for (int i = 0; i < 60; ++i) exchange(p_W += v_W * 0.05, body(p_W + Vector3d(8.0, 0.0, 0.0)), std::nullopt);
      EXPECT_EQ(traces_.cubes(), 0U) << drawn << ": at " << v_W.norm() << " m/s";
      const double gap_s = random_.uniform(0.3, 2.0);
      wait(std::nullopt, gap_s);
      p_W += v_W * gap_s;
    }
    wait(p_W, 4.0);
  }
}

// No UAV flies as fast as this one jumps.
TEST_F(UavTracesTest, HitsOnAUavThatReportsNoVelocitiesAndJumpsAreDoubted) {
  for (int drawn = 0; drawn < 10; ++drawn) {
    map_ = WorldMap(WorldMap::Config());
    map_.on_met([this](const Eigen::Vector3i& cube, bool news) { traces_.met(cube, news); });
    const Vector3d p_W = drawn_place();
    const Vector3d jump_W = Vector3d(random_.normal(), random_.normal(), random_.normal()).normalized() * 3.0;
    const std::vector<Vector3d> hits_W = body(p_W);
    for (int i = 0; i < 80; ++i) exchange(p_W, {}, std::nullopt);
    for (int i = 0; i < 40; ++i) {
      exchange(p_W + jump_W, i == 20 ? hits_W : std::vector<Vector3d>(), std::nullopt);
    }
    for (int i = 0; i < 35 * 20; ++i) exchange(p_W, {}, std::nullopt);
    for (const Vector3d& hit_W : hits_W) EXPECT_TRUE(doubted(hit_W)) << drawn;
  }
}

TEST_F(UavTracesTest, OnlyTheSenderOfADoubtedHitCanResolveTheDoubt) {
  const Vector3d p_W(12.0, 0.0, 10.0), met_W(13.0, 1.0, 10.0);
  const Eigen::Vector3i cube = map_.cube_of(met_W);
  wait(p_W, 3.0);
  exchange(std::nullopt);
  map_.hear(cube, 0, Space::occupied, 3);
  map_.hear({cube.x() >> 2, cube.y() >> 2, cube.z() >> 2}, 2, Space::free, 3);
  EXPECT_EQ(map_.at(met_W), Space::occupied) << "there is no doubt yet";
  exchange(std::nullopt);
  wait(p_W, 4.0);
  ASSERT_TRUE(doubted(met_W));
  map_.hear({cube.x() >> 2, cube.y() >> 2, cube.z() >> 2}, 2, Space::free, 2);
  map_.hear(cube, 0, Space::occupied, 3);
  EXPECT_EQ(map_.at(met_W), Space::occupied);
  EXPECT_TRUE(doubted(met_W)) << "a repeated message is not news";
  map_.hear({cube.x() >> 2, cube.y() >> 2, cube.z() >> 2}, 2, Space::free, 3);
  EXPECT_EQ(map_.at(met_W), Space::free);
}

TEST_F(UavTracesTest, TheNumberOfTracedCubesIsBounded) {
  wait(Vector3d(10.0, 0.0, 10.0), 3.0);
  for (int i = 0; i < 400; ++i) {
    std::vector<Vector3d> hits_W;
    for (int hit = 0; hit < 50; ++hit) hits_W.push_back(drawn_place() * 4.0);
    exchange(std::nullopt, hits_W);
    EXPECT_LE(traces_.cubes(), UavTraces::Config().most_cubes);
  }
  wait(Vector3d(10.0, 0.0, 10.0), 4.0);
  EXPECT_EQ(traces_.cubes(), 0U) << "all are heard";
}

}  // namespace
}  // namespace skein::agent
