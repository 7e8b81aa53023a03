// Whole scenarios with a pilot who flies around the highest box: runs repeat exactly. Some tests print their CPU time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>

#include "core/scenario/scenario_reader.hpp"
#include "scenes/scene_source.hpp"
#include "sim_server/simulation.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

/// Flies each UAV straight up, out over the highest box's edge, down to its height and round it, camera to the middle.
class Surveyor {
 public:
  Surveyor(const Scenario& scenario, const Scene& scene) : scenario_(scenario) {
    const auto top = [](const OrientedBox& box) { return box.center.z() + 0.5 * box.size.z(); };
    box_ = *std::max_element(scene.boxes.begin(), scene.boxes.end(),
                             [&](const OrientedBox& x, const OrientedBox& y) { return top(x) < top(y); });
    for (const OrientedBox& box : scene.boxes) ceiling_ = std::max(ceiling_, top(box));
  }
  TrajectoryCommand at(UavIndex uav, double t) const {
    constexpr double kClimb = 20.0, kOut = 25.0, kDown = 8.0;
    const double i = static_cast<double>(uav), cruise = ceiling_ + 5.0 + 2.0 * i;
    TrajectoryCommand command;
    if (t < kClimb) {
      command.p_WB << scenario_.fleet[uav].start + Vector2d(0.1, 0.0), cruise;
      return command;
    }
    const double way = 2.0 * std::max(0.0, t - kClimb - kOut - kDown) + 25.0 * i;
    const Vector3d p_OB = around(way, 5.0 + 0.5 * i);
    command.p_WB = box_.center + box_.R_WO * p_OB;
    command.p_WB.z() = t < kClimb + kOut ? cruise : box_.center.z() + 0.5 * i;
    const Vector3d inwards = box_.center - command.p_WB;
    command.yaw = std::atan2(inwards.y(), inwards.x());
    return command;
  }

 private:
  /// A point on the rectangle `margin` outside the box, after a way along it.
  Vector3d around(double way, double margin) const {
    const double a = box_.size.x() + 2.0 * margin, b = box_.size.y() + 2.0 * margin;
    double s = std::fmod(way, 2.0 * (a + b));
    if (s < a) return {s - 0.5 * a, -0.5 * b, 0.0};
    if ((s -= a) < b) return {0.5 * a, s - 0.5 * b, 0.0};
    if ((s -= b) < a) return {0.5 * a - s, 0.5 * b, 0.0};
    return {-0.5 * a, 0.5 * b - (s - a), 0.0};
  }

  const Scenario& scenario_;
  OrientedBox box_;
  double ceiling_ = 0.0;
};

/// Runs for a time. @returns the digest.
std::string survey(const Scenario& scenario, Simulation& sim, double duration_s) {
  std::vector<std::string> names;
  for (const UavConfig& uav : scenario.fleet) names.push_back(uav.name);
  RunDigest digest(names);
  const Surveyor surveyor(scenario, sim.scene());
  digest.add(sim.digest_input());
  while (seconds(sim.tick()) < duration_s) {
    const double t = seconds(sim.tick());
    for (const UavIndex i : FirstUavs(sim.size())) {
      sim.command_trajectory(i, surveyor.at(i, t));
      sim.command_gimbal(i, {GimbalMode::rate, 0.2 * std::sin(t), 0.1 * std::cos(t)});
    }
    sim.advance();
    digest.add(sim.digest_input());
  }
  return digest.hex();
}

std::string survey(const Scenario& scenario, const Scene& scene, std::uint64_t seed, double duration_s) {
  Simulation sim(scenario, scene, seed);
  return survey(scenario, sim, duration_s);
}

Scenario towers() { return load_scenario("towers", {.config_dir = source_path("config")}); }

TEST(WholeSimulation, ARunRepeatsBitForBitAndSeedsDiffer) {
  const Scenario scenario = towers();
  const Scene scene = load_scene(scenario);
  for (const std::uint64_t seed : {0U, 7U}) {
    const std::string first = survey(scenario, scene, seed, 30.0);
    std::vector<std::unique_ptr<char[]>> noise;
    for (std::size_t i = 1; i < 1000; ++i) noise.push_back(std::make_unique<char[]>(91 * i % 7000 + 1));
    for (std::size_t i = 0; i < noise.size(); i += 3) noise[i].reset();
    EXPECT_EQ(survey(scenario, scene, seed, 30.0), first);
  }
  EXPECT_NE(survey(scenario, scene, 0, 5.0), survey(scenario, scene, 1, 5.0));
  EXPECT_NE(survey(scenario, scene, 1, 5.0), survey(scenario, scene, 2, 5.0));
}

TEST(WholeSimulation, ScansWithoutAReaderChangeNothingElse) {
  const Scenario scenario = towers();
  const Scene scene = load_scene(scenario);
  Simulation all(scenario, scene, 3), lazy(scenario, scene, 3);
  for (std::size_t i = 0; i < lazy.size(); ++i) lazy.want_scans(UavIndex(i), false);
  const Surveyor surveyor(scenario, scene);
  std::size_t scans = 0, lazy_scans = 0, key_frames = 0;
  while (seconds(all.tick()) < 20.0) {
    for (Simulation* sim : {&all, &lazy}) {
      for (std::size_t i = 0; i < sim->size(); ++i)
        sim->command_trajectory(UavIndex(i), surveyor.at(UavIndex(i), seconds(sim->tick())));
      sim->advance();
    }
    ASSERT_EQ(all.events().servos.size(), all.events().scans.size());
    ASSERT_EQ(lazy.events().servos.size(), all.events().scans.size())
        << "the servo's angle is reported at each scan, whether the scan is computed or not";
    for (std::size_t i = 0; i < all.events().scans.size(); ++i) {
      const LidarServo &servo = all.events().servos[i].servo, &lazy_servo = lazy.events().servos[i].servo;
      ASSERT_EQ(servo.tick, all.events().scans[i].scan.tick);
      ASSERT_EQ(servo.angle, all.events().scans[i].scan.servo_angle);
      ASSERT_EQ(lazy_servo.angle, servo.angle);
    }
    scans += all.events().scans.size();
    lazy_scans += lazy.events().scans.size();
    key_frames += all.events().key_frames.size();
    ASSERT_EQ(all.events().key_frames.size(), lazy.events().key_frames.size());
    for (std::size_t i = 0; i < all.events().key_frames.size(); ++i) {
      ASSERT_EQ(all.events().key_frames[i].key_frame.points_W, lazy.events().key_frames[i].key_frame.points_W);
    }
    ASSERT_EQ(all.links(), lazy.links());
    for (std::size_t i = 0; i < all.size(); ++i)
      ASSERT_EQ(all.uav(UavIndex(i)).state.p_WB, lazy.uav(UavIndex(i)).state.p_WB);
  }
  EXPECT_GT(key_frames, 3U);
  EXPECT_LT(10 * lazy_scans, 5 * scans);
}

TEST(WholeSimulation, AHundredUavsTakeOffWithoutACollision) {
  Scenario scenario = towers();
  const UavConfig explorer = scenario.fleet[0], photographer = scenario.fleet[2];
  const Scene scene = load_scene(scenario);
  scenario.fleet.clear();
  for (int i = 0; i < 100; ++i) {
    UavConfig uav = i % 10 == 0 ? explorer : photographer;
    uav.name = "uav" + std::to_string(i);
    uav.start = {-60.0 - 3.0 * (i % 10), 3.0 * (i / 10)};
    scenario.fleet.push_back(uav);
  }
  Simulation sim(scenario, scene, 0);
  const std::clock_t begin = std::clock();
  while (seconds(sim.tick()) < 3.0) {
    for (const UavIndex i : FirstUavs(sim.size())) {
      const Vector2d& start = scenario.fleet[i].start;
      sim.command_trajectory(i, {.p_WB = {start.x(), start.y(), 3.0}});
    }
    sim.advance();
  }
  std::cout << "[ measured ] " << static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / 3.0
            << " s of CPU per simulated second of a hundred UAVs\n";
  for (const UavView& uav : sim.uavs()) {
    EXPECT_TRUE(uav.alive);
    EXPECT_TRUE(uav.airborne);
  }
}

/// Prints the CPU time of a flight.
void measure(const Scenario& scenario, double duration_s) {
  const Scene scene = load_scene(scenario);
  const std::clock_t begin = std::clock();
  Simulation sim(scenario, scene, 0);
  const std::clock_t built = std::clock();
  survey(scenario, sim, duration_s);
  const std::clock_t end = std::clock();
  const auto in_s = [](std::clock_t t) { return static_cast<double>(t) / CLOCKS_PER_SEC; };
  std::size_t alive = 0;
  for (const UavView& uav : sim.uavs()) alive += uav.alive;
  std::cout << "[ measured ] " << scenario.name << ": construction " << in_s(built - begin) << " s, "
            << 1e3 * in_s(end - built) / duration_s << " ms of CPU per simulated second; " << alive << " of "
            << sim.size() << " alive, " << sim.referee().earned().points_detected() << " points, score "
            << sim.referee().earned().score() << "\n";
  EXPECT_GT(sim.referee().earned().points_detected(), 0U);
}

TEST(WholeSimulation, AFlightOnTowersDetectsPoints) { measure(towers(), 120.0); }

TEST(WholeSimulation, AFlightOnMbsDetectsPoints) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (assets == nullptr) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  measure(load_scenario("mbs", {.assets_dir = assets, .config_dir = source_path("config")}), 120.0);
}

}  // namespace
}  // namespace skein::sim
