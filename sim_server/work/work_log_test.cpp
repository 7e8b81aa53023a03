// Tests which UAVs work, judged by the true state: flights of seconds and minutes before a wall, with random places and
// distances.
#include "sim_server/work/work_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr int kDraws = 3;

/// A field with a wall from y = -10 to 10, between x = 12 and 13, 20 m high.
class WorkLogTest : public testing::Test {
 protected:
  WorkLogTest() {
    scenario_.file = "wall.yaml";
    scenario_.station_position = {-5, 0, 0.3};
    scenario_.duration_s = 600.0;
    test::add_box(scene_.mesh, {12.5, 0, 10}, {1, 20, 20});
  }
  void add(const std::string& type, double x, double y) {
    scenario_.fleet.push_back({.name = "uav" + std::to_string(scenario_.fleet.size()),
                               .vehicle = load_vehicle(type, source_path("config")),
                               .start = {x, y}});
  }
  /// Points a metre apart about a place on the near side of the wall, or on the far one.
  void add_patch(int y, int z, int half, bool near = true) {
    for (int dy = -half; dy <= half; ++dy) {
      for (int dz = -half; dz <= half; ++dz) {
        const Eigen::Vector3f p(near ? 12.0F : 13.0F, static_cast<float>(y + dy), static_cast<float>(z + dz));
        scene_.points.push_back({p, {near ? -1.0F : 1.0F, 0, 0}});
      }
    }
  }
  void start() {
    simulation_ = std::make_unique<Simulation>(scenario_, scene_, 0);
    log_ = std::make_unique<WorkLog>(scenario_, *simulation_);
  }
  using Targets = std::function<std::vector<TrajectoryCommand>(double t)>;
  void fly(
      double duration_s, const Targets& targets,
      const std::function<bool(const std::string&)>& is_member = [](const std::string&) { return true; }) {
    for (double t = 0.0; t < duration_s - 1e-9; t += scenario_.exchange_period_s) {
      const std::vector<TrajectoryCommand> commands = targets(t);
      for (std::size_t i = 0; i < commands.size(); ++i) simulation_->command_trajectory(UavIndex(i), commands[i]);
      simulation_->advance();
      log_->end_step(is_member);
    }
  }
  std::vector<WorkTime> judged() const { return judge_work(log_->tracks(), {}); }
  double done(std::size_t uav, std::size_t from = 0) const {
    const std::vector<double>& all = log_->tracks()[uav].done;
    return std::accumulate(all.begin() + static_cast<std::ptrdiff_t>(from), all.end(), 0.0);
  }
  std::ptrdiff_t open(std::size_t uav) const { return std::ranges::count(log_->tracks()[uav].open, WorkTrack::kOpen); }

  Scenario scenario_;
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<WorkLog> log_;
};

TrajectoryCommand hover(double x, double y, double z, double yaw = 0.0) { return {.p_WB = {x, y, z}, .yaw = yaw}; }

TEST_F(WorkLogTest, AUavThatFliesToAndFroWithoutAPictureIsFrozen) {
  add("photographer", -5, 0);
  add_patch(0, 10, 6);
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(1, "work_log", draw);
    const double x = random.uniform(-30.0, -10.0), way = random.uniform(5.0, 25.0), pace = random.uniform(0.1, 0.3);
    start();
    fly(150.0, [&](double t) { return std::vector{hover(x, way * std::sin(pace * t), 8.0, std::numbers::pi)}; });
    EXPECT_GT(simulation_->uav(UavIndex{0}).distance_m, 50.0);
    EXPECT_GE(judged()[0].frozen_s, 100u) << "of 150 s, less the time to fly to the wall";
    EXPECT_EQ(done(0), 0.0);
  }
}

TEST_F(WorkLogTest, AUavThatPhotographsKnownPointsWorseIsFrozen) {
  add("photographer", 0, 0);
  add_patch(0, 8, 1);
  add_patch(0, 8, 3, false);
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(2, "work_log", draw);
    const double back = random.uniform(1.5, 5.0), sway = random.uniform(0.2, 1.5);
    start();
    fly(40.0, [](double) { return std::vector{hover(9.0, 0, 8)}; });
    const double first = done(0);
    EXPECT_GT(first, 1.0) << "the first pictures are work";
    const std::uint64_t captures = simulation_->uav(UavIndex{0}).captures;
    fly(120.0, [&](double t) { return std::vector{hover(9.0 - back, sway * std::sin(t), 8)}; });
    EXPECT_GT(simulation_->uav(UavIndex{0}).captures, captures + 200) << "the UAV goes on to photograph";
    EXPECT_LT(done(0) - first, 1.0);
    EXPECT_GE(judged()[0].frozen_s, 90u);
  }
}

TEST_F(WorkLogTest, AUavThatPhotographsOnlyPointsOfItsMateIsFrozen) {
  add("photographer", 0, -3);
  add("photographer", 0, 3);
  add_patch(0, 8, 1);
  add_patch(0, 8, 3, false);
  start();
  const double turned = std::numbers::pi;
  fly(40.0, [&](double) { return std::vector{hover(9.0, 0, 8), hover(-8, 3, 8, turned)}; });
  fly(120.0, [&](double t) {
    const double to_post_s = std::min(t, 6.0);  // the mate makes room first
    return std::vector{hover(9.0 - 17.0 / 6.0 * to_post_s, -8, 8, turned), hover(t < 10.0 ? -8.0 : 8.5, 1, 8)};
  });
  EXPECT_GT(done(0), 1.0);
  EXPECT_LT(done(1), 1.0) << "the mate's pictures of all its points are as good";
  EXPECT_GT(simulation_->uav(UavIndex{1}).captures, 200u);
  EXPECT_GE(judged()[1].frozen_s, 90u);
}

TEST_F(WorkLogTest, AUavThatPhotographsMoreAndMoreIsNotFrozen) {
  add("photographer", 0, 0);
  add_patch(0, 10, 8);
  start();
  fly(150.0, [](double t) { return std::vector{hover(8.0, 8.0 * std::sin(0.15 * t), 3.0 + 0.09 * t)}; });
  EXPECT_EQ(judged()[0].frozen_s, 0u);
  EXPECT_GT(open(0), 60);
  EXPECT_GT(done(0), 5.0);
}

TEST_F(WorkLogTest, WhereNothingIsWithinReachNoUavIsFrozen) {
  add("photographer", 0, 0);
  test::add_box(scene_.mesh, {0, 30, 10}, {4, 4, 4});
  for (int i = 0; i < 20; ++i) scene_.points.push_back({{0.1F * static_cast<float>(i), 30, 10}, {1, 0, 0}});  // inside
  start();
  fly(100.0, [](double) { return std::vector{hover(0, 0, 8)}; });
  EXPECT_EQ(open(0), 0);
  EXPECT_EQ(judged()[0].frozen_s, 0u);
}

TEST_F(WorkLogTest, SurfaceIsMappedOnceByMatesThatHearEachOther) {
  add("explorer", -2, 0);
  add("explorer", -2, 4);
  add_patch(0, 10, 8);
  start();
  const auto both = [](double y) {
    return [y](double t) {
      const double turn = 0.3 * t;  // for key frames
      return std::vector{hover(0, y, 8, turn), hover(0, y + 4, 8, turn)};
    };
  };
  fly(40.0, both(0.0));
  const double first = done(0) + done(1);
  EXPECT_GT(first, 10.0) << "the first view of the wall, and a little more from higher and lower";
  EXPECT_GT(std::max(done(0), done(1)), 2.0 * std::min(done(0), done(1)) + 1.0)
      << "the UAV that mapped the wall first gets the credit";
  fly(40.0, both(1.0));
  EXPECT_LT(done(0, 42) + done(1, 42), 0.2 * first) << "to map known surface again is not work";
}

TEST_F(WorkLogTest, NoWorkIsOpenForAUavThatMustTurnHome) {
  add("photographer", 0, 0);
  add_patch(0, 10, 6, false);  // not in sight of the station
  scenario_.duration_s = 120.0;
  start();
  fly(122.0, [](double) { return std::vector{hover(-30, 0, 8, std::numbers::pi)}; });
  const std::string& seconds = log_->tracks()[0].open;
  const std::size_t last = seconds.find_last_of(WorkTrack::kOpen), end = seconds.find_last_not_of(WorkTrack::kAway);
  ASSERT_NE(last, std::string::npos);
  // 45 m to the wall and 18 m home from there, with 50 % of detours, at 4 m/s, and 10 s.
  EXPECT_NEAR(static_cast<double>(end - last), 10.0 + 1.5 * 63.0 / 4.0, 5.0) << seconds;
}

TEST_F(WorkLogTest, AUavWhoseProgramIsAwayIsNotCountedAndBeginsAnew) {
  add("photographer", -5, 0);
  add_patch(0, 10, 6);
  start();
  bool away = false;
  const auto stand = [](double) { return std::vector{hover(-20, 0, 8, std::numbers::pi)}; };
  const auto member = [&](const std::string&) { return !away; };
  fly(70.0, stand, member);
  away = true;
  fly(30.0, stand, member);
  away = false;
  fly(50.0, stand, member);
  const std::string& seconds = log_->tracks()[0].open;
  EXPECT_EQ(seconds.substr(71, 28), std::string(28, WorkTrack::kAway));
  EXPECT_EQ(seconds.substr(101, 20).find(WorkTrack::kOpen), std::string::npos)
      << "a UAV that has come back gets some time before work counts as open";
  EXPECT_EQ(seconds.back(), WorkTrack::kOpen);
  EXPECT_EQ(judged()[0].frozen_s, 0u) << "its program ran for less than a minute each time";
}

TEST_F(WorkLogTest, WorkThatNeedsAFailedCameraIsNotOpen) {
  add("photographer", -5, 0);
  add_patch(0, 10, 6);
  FaultPlan faults;
  faults.faults.emplace_back().action = CameraFailure{"uav0"};
  simulation_ = std::make_unique<Simulation>(scenario_, scene_, 0, faults);
  log_ = std::make_unique<WorkLog>(scenario_, *simulation_);
  fly(60.0, [](double) { return std::vector{hover(-20, 0, 8)}; });
  EXPECT_EQ(open(0), 0);
}

}  // namespace
}  // namespace skein::sim
