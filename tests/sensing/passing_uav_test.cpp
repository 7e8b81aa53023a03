// A UAV whose position is not received flies within sight of a LiDAR, among short poles that look like a UAV in a map.
// Later its position is received again, elsewhere. Checks what the map then contains of its trace, and of the poles.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "core/vehicle/lidar_geometry.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "tests/sensing/sensed_space.hpp"
#include "tests/support/test_scenes.hpp"
#include "uav_agent/maps/uav_traces.hpp"

namespace skein::sensing {
namespace {

constexpr double kLostS = 6.0, kFoundS = 16.0, kEndS = 46.0;
constexpr double kPoleWidthM = 0.06;

/// Pose X_WB of the UAV with the LiDAR, which turns so that it scans all directions, and drifts.
Isometry3d looker(double t) {
  return Eigen::Translation3d(0.15 * t, 0.3 * std::sin(0.4 * t), kHeightM) *
         Eigen::AngleAxisd(0.25 * t, Vector3d::UnitZ());
}

Vector3d drawn_place(RandomStream& random, double from_m, double to_m) {
  const double a = random.uniform(-std::numbers::pi, std::numbers::pi), r = random.uniform(from_m, to_m);
  return {r * std::cos(a), r * std::sin(a), kHeightM + random.uniform(-3.0, 3.0)};
}

struct DrawnPassing {
  std::vector<Vector3d> way_W;    ///< route of the other UAV while it is not received; equal time for each leg
  std::vector<Vector3d> poles_W;  ///< points on the poles
  TriangleMesh mesh;

  explicit DrawnPassing(std::uint64_t seed) {
    RandomStream random(seed, "passing", 0);
    const Vector3d begin_W = drawn_place(random, 5.0, 9.0);
    way_W = {begin_W, begin_W + 6.0 * sim::test::random_unit(random)};
    way_W.push_back(way_W[1] + 0.2 * sim::test::random_unit(random));  // a leg so short that it nearly stays there
    way_W.push_back(way_W[2] + 12.0 * sim::test::random_unit(random));
    while (poles_W.size() < 400) {
      const Vector3d middle_W = drawn_place(random, 5.0, poles_W.size() < 200 ? 10.0 : 22.0);
      double clear_m = 1e9;
      for (double t = kLostS; t < kFoundS; t += 0.1) clear_m = std::min(clear_m, (middle_W - at(t)).norm());
      for (const Vector3d& other_W : poles_W) clear_m = std::min(clear_m, (middle_W - other_W).norm());
      if (clear_m < 3.5) continue;
      const double length_m = random.uniform(0.6, 1.4);
      sim::test::add_box(mesh, middle_W, {kPoleWidthM, kPoleWidthM, length_m});
      for (int i = 0; i < 100; ++i) {
        poles_W.push_back(middle_W + (i / 99.0 - 0.5) * length_m * Vector3d::UnitZ());
      }
    }
  }

  Vector3d at(double t) const {
    const double leg = std::clamp(3.0 * (t - kLostS) / (kFoundS - kLostS), 0.0, 2.999);
    const auto i = static_cast<std::size_t>(leg);
    return way_W[i] + (leg - static_cast<double>(i)) * (way_W[i + 1] - way_W[i]);
  }
};

struct Seen {
  std::size_t trace = 0;      ///< cubes on the other UAV's route that were occupied when it was received again
  std::size_t left = 0;       ///< of these, cubes that are still occupied at the end
  std::size_t free = 0;       ///< of these, cubes that are free at the end
  std::size_t poles = 0;      ///< cubes of poles that were occupied when it was received again
  std::size_t lost = 0;       ///< of these, cubes that are not occupied any more at the end
  std::size_t pole_free = 0;  ///< how often since then a cube of a pole, or a tube around one of its points, was free
};

class Passing {
 public:
  explicit Passing(std::uint64_t seed, bool doubts)
      : drawn_(seed), world_(drawn_.mesh, {sim::body_shape({}), sim::body_shape({})}), doubts_(doubts) {
    agent::AgentConfig config;
    config.fleet.resize(2);
    config.fleet[1].p_WB_start = drawn_.at(0.0);
    peers_.emplace(config);
    traces_.emplace(config, mapper_.map().config().cell_m);
    mapper_.map().on_met([this](const Eigen::Vector3i& cube, bool news) { traces_->met(cube, news); });
  }

  Seen fly() {
    Seen seen;
    std::vector<Eigen::Vector3i> trace, poles;
    constexpr Tick kExchange = 20;
    const agent::WorldMap& map = mapper_.map();
    for (Tick tick = 0; seconds(tick) < kEndS; tick += kExchange) {
      const double t = seconds(tick);
      const bool heard = t <= kLostS || t >= kFoundS;
      std::vector<agent::Neighbour> neighbours;
      if (heard) neighbours.push_back({node_of_uav(UavIndex{1}), drawn_.at(t)});
      peers_->update(tick, neighbours);
      traces_->update(tick, *peers_);
      if (tick % lidar_period(config_) == 0) scan(tick, heard);
      if (tick == ticks(kFoundS)) {
        trace = occupied_about([&](const Vector3d& p_W) { return on_way(p_W); });
        poles = occupied_about([&](const Vector3d& p_W) { return !on_way(p_W); });
      }
      if (doubts_) traces_->doubt(mapper_.map());
      if (t < kFoundS || tick % kTicksPerSecond != 0) continue;
      for (const Eigen::Vector3i& cube : poles) seen.pole_free += map.known(cube).space == agent::Space::free;
      for (const Vector3d& p_W : drawn_.poles_W) seen.pole_free += map.tube_free(p_W, p_W, kTubeM);
    }
    seen.trace = trace.size();
    for (const Eigen::Vector3i& cube : trace) {
      seen.left += map.known(cube).space == agent::Space::occupied;
      seen.free += map.known(cube).space == agent::Space::free;
    }
    seen.poles = poles.size();
    for (const Eigen::Vector3i& cube : poles) seen.lost += map.known(cube).space != agent::Space::occupied;
    return seen;
  }

 private:
  bool on_way(const Vector3d& p_W) const {
    for (double t = kLostS; t < kFoundS; t += 0.05) {
      if ((drawn_.at(t) - p_W).norm() < 1.5) return true;
    }
    return false;
  }

  std::vector<Eigen::Vector3i> occupied_about(const auto& take) const {
    std::vector<Eigen::Vector3i> cubes;
    const agent::WorldMap& map = mapper_.map();
    const Eigen::Vector3i middle = map.cube_of({0.0, 0.0, kHeightM});
    constexpr int kReach = 60;
    for (int i = 0; i < 8 * kReach * kReach * kReach; ++i) {
      const Eigen::Vector3i cube =
          middle + Eigen::Vector3i(i % (2 * kReach), i / (2 * kReach) % (2 * kReach), i / (4 * kReach * kReach)) -
          Eigen::Vector3i::Constant(kReach);
      if (map.known(cube).space != agent::Space::occupied) continue;
      if (take((cube.cast<double>() + Vector3d::Constant(0.5)) * map.config().cell_m)) cubes.push_back(cube);
    }
    return cubes;
  }

  /// Scans. @param heard  the other UAV is received, so it is not structure, and this test removes it from the world.
  void scan(Tick tick, bool heard) {
    const double t = seconds(tick);
    world_.set_pose(UavIndex{1}, Isometry3d(Eigen::Translation3d(heard ? Vector3d(900, 0, 0) : drawn_.at(t))));
    const sim::LidarScan scan = lidar_.scan(tick, looker(t), world_);
    agent::BeamScan beams{.columns = config_.columns};
    for (const double range : lidar_.ranges()) {
      const bool returned = range >= config_.range_min_m && range <= config_.range_max_m;
      beams.beams.push_back(returned ? agent::BeamScan::Beam{agent::BeamState::range, static_cast<float>(range)}
                                     : agent::BeamScan::Beam{agent::BeamState::none, 0.0F});
    }
    beams.tick = tick;
    beams.fired = {{.first_column = 0, .tick = tick, .X_WL = scan.X_WL}};
    mapper_.insert(beams);
  }

  const DrawnPassing drawn_;
  const LidarConfig config_;
  sim::RayScene world_;
  sim::Lidar lidar_{config_, UavIndex{0}, 0};
  agent::WorldMapper mapper_{config_, {}};
  std::optional<agent::Peers> peers_;
  std::optional<agent::UavTraces> traces_;
  const bool doubts_;
};

TEST(PassingUav, ItsTraceIsRemovedFromTheMapAndPolesStay) {
  Seen all;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Seen seen = Passing(seed, true).fly();
    std::cout << "seed " << seed << ": trace of " << seen.trace << " cubes, then " << seen.left << " occupied, "
              << seen.free << " free; poles of " << seen.poles << " cubes, " << seen.lost
              << " of them occupied no more\n";
    all.trace += seen.trace;
    all.left += seen.left;
    all.free += seen.free;
    all.poles += seen.poles;
    EXPECT_EQ(seen.lost, 0U) << seed;
    EXPECT_EQ(seen.pole_free, 0U) << seed;
  }
  EXPECT_GT(all.trace, 100U) << "the LiDAR has hardly seen the other UAV";
  EXPECT_GT(all.poles, 30U) << "the LiDAR has hardly seen the poles";
  EXPECT_GT(static_cast<double>(all.free), 0.8 * static_cast<double>(all.trace));
}

TEST(PassingUav, ItsTraceStaysOnAMapThatDoubtsNoCubes) {
  const Seen seen = Passing(1, false).fly();
  EXPECT_GT(seen.trace, 20U);
  EXPECT_EQ(seen.left, seen.trace);
}

}  // namespace
}  // namespace skein::sensing
