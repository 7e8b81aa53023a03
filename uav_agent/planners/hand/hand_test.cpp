// A UAV that is flown by hand, in a world without physics: it obeys, and with the safety filter no command makes it hit
// anything.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "core/planners/hand_file.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/guarded_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr Tick kExchange = 20;
constexpr double kBodyRadiusM = 0.63;

struct Wanted {
  double at_s = 0.0;
  HandCommand command;
};

std::filesystem::path hand_csv(const std::string& name, const std::vector<Wanted>& commands) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("hand_test_" + name + ".csv");
  std::ofstream out(file);
  out << hand_file::head();
  for (const Wanted& wanted : commands) {
    const Tick tick = ticks(wanted.at_s) / kExchange * kExchange;
    out << hand_file::line_of({static_cast<std::uint64_t>(tick / kExchange), tick, wanted.command});
  }
  return file;
}

HandCommand level(double ahead, double left, double yaw_rate = 0.0) {
  return {.velocity = {ahead, left, 0.0}, .yaw_rate = yaw_rate};
}
HandCommand up(double mps) { return {.velocity = {0.0, 0.0, mps}}; }

/// One explorer that starts at (-8, -14) and looks along x. It takes some seconds until its LiDAR has proved the air
/// above it; until then the filter lets it go nowhere.
TestWorld flown(const std::string& name, const std::vector<Wanted>& commands, const std::string& more = "") {
  return {two_towers(), test_fleet(1), "hand:file=" + hand_csv(name, commands).string() + more, 300.0};
}

TEST(Hand, ObeysCommandsAndComesToRest) {
  TestWorld world = flown(
      "moves", {{1.0, up(1.0)}, {16.0, {}}, {19.0, level(2.0, 0.0)}, {33.0, {}}, {36.0, level(0.0, 1.0)}, {43.0, {}}});
  world.run(1.0);
  EXPECT_LT(world.highest_m(0), 0.2) << "before the first command, it stands";
  world.run(17.0);
  const Vector3d top = world.position(0);
  EXPECT_NEAR(top.z(), 9.0, 3.0);
  EXPECT_LT((top.head<2>() - Vector2d(-8.0, -14.0)).norm(), 0.1) << "it climbs straight up";
  world.run(17.0);
  const Vector3d ahead = world.position(0);
  EXPECT_GT(ahead.x() - top.x(), 12.0) << "14 s at up to 2 m/s, as its LiDAR proves the way";
  EXPECT_LT(ahead.x() - top.x(), 28.5);
  EXPECT_NEAR(ahead.y(), top.y(), 0.05);
  EXPECT_NEAR(ahead.z(), top.z(), 0.05);
  world.run(10.0);
  const Vector3d left = world.position(0);
  EXPECT_GT(left.y() - ahead.y(), 3.0);
  EXPECT_NEAR(left.x(), ahead.x(), 0.3);
  world.run(3.0);
  const Vector3d rests = world.position(0);
  world.run(20.0);
  EXPECT_EQ(world.position(0), rests) << "without a command, its place stays the same to the bit";
  EXPECT_EQ(world.bad_commands(), 0U);
}

TEST(Hand, AheadIsWhereItLooks) {
  const double quarter_s = 0.5 * std::numbers::pi / 0.4;
  TestWorld world =
      flown("turns", {{1.0, up(1.0)}, {14.0, level(0.0, 0.0, -0.4)}, {14.0 + quarter_s, {}}, {22.0, level(1.0, 0.0)}});
  world.run(22.0);
  const Vector3d before = world.position(0);
  world.run(9.0);
  EXPECT_LT(world.position(0).y() - before.y(), -3.0) << "ahead is a quarter turn to the right of x";
  EXPECT_NEAR(world.position(0).x(), before.x(), 0.5);
}

/// The tower's south face is at y = 8.
TEST(Hand, StopsInFrontOfAWallAndObeysAgainOnTheWayBack) {
  std::vector<Wanted> commands = {
      {1.0, up(2.0)}, {14.0, {}}, {15.0, level(0.0, 4.0)}, {75.0, level(0.0, -2.0)}, {85.0, {}}};
  TestWorld world = flown("wall", commands);
  world.run(75.0);
  const Vector3d stopped = world.position(0);
  EXPECT_GT(stopped.y(), 3.0) << "it came near";
  EXPECT_GT(world.clearance(), kBodyRadiusM + 0.5);
  world.run(11.0);
  EXPECT_LT(world.position(0).y(), stopped.y() - 5.0);
  // Without the filter, the same commands fly it into the wall.
  TestWorld bold = flown("wall", commands, ",safe=false");
  bold.run(75.0);
  EXPECT_LT(bold.clearance(), 0.1);
}

TEST(Hand, WithTheFilterItStaysAboveTheFloorAndClimbsFirst) {
  TestWorld world = flown("floor", {{1.0, level(2.0, 1.0)}, {5.0, up(1.0)}, {12.0, up(-3.0)}, {40.0, level(1.0, 0.0)}});
  world.run(5.0);
  EXPECT_LT(world.highest_m(0), 0.2) << "it does not slide over the ground";
  world.run(33.0);
  EXPECT_NEAR(world.position(0).z(), 2.0, 0.1);
  const Vector3d low = world.position(0);
  world.run(12.0);
  EXPECT_GT(world.position(0).x() - low.x(), 3.0) << "along the floor it flies on";
}

/// Draws commands of any speed, some long and some short.
std::vector<Wanted> drawn_hands(std::uint64_t seed, double duration_s) {
  RandomStream random(seed, "drawn hands", 0);
  std::vector<Wanted> commands = {{1.0, up(random.uniform(0.5, 3.0))}};
  for (double at_s = random.uniform(4.0, 9.0); at_s < duration_s; at_s += random.uniform(0.1, 6.0)) {
    const auto speed = [&] { return random.uniform() < 0.3 ? 0.0 : random.uniform(-8.0, 8.0); };
    commands.push_back({at_s, {.velocity = {speed(), speed(), 0.4 * speed()}, .yaw_rate = random.uniform(-1.0, 1.0)}});
  }
  return commands;
}

class DrawnHands : public testing::TestWithParam<std::uint64_t> {};

TEST_P(DrawnHands, HitNothingAndRepeatFromTheFile) {
  const std::string name = "drawn" + std::to_string(GetParam());
  TestWorld world = flown(name, drawn_hands(GetParam(), 150.0)), again = flown(name, drawn_hands(GetParam(), 150.0));
  world.run(150.0);
  EXPECT_GT(world.clearance(), kBodyRadiusM + 0.3);
  EXPECT_GT(world.highest_m(0), 2.0);
  EXPECT_EQ(world.bad_commands(), 0U);
  again.run(150.0);
  EXPECT_EQ(world.fingerprint(), again.fingerprint());
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnHands, testing::Range<std::uint64_t>(1, 7));

/// Commands that arrive one by one, as from the web page, and the file that records them give the same flight.
TEST(Hand, AFileOfCommandsRepeatsTheFlight) {
  for (const char* safe : {"true", "false"}) {
    const std::vector<Wanted> commands = drawn_hands(17, 40.0);
    FlownUav told(fleet_of(1, Role::explorer, 0), {100.0, 0.0, 0.16}), repeated(told.agent, {100.0, 0.0, 0.16});
    const std::string safety = std::string("safe=") + safe;
    const auto now = make_planner("hand:" + safety, told.agent);
    const auto then = make_planner("hand:file=" + hand_csv("kept", commands).string() + "," + safety, told.agent);
    std::size_t next = 0, moved = 0;
    for (std::uint64_t k = 0; k < 800; ++k) {
      PlannerInput in = told.input(), again = repeated.input();
      in.k = again.k = k;
      in.tick = again.tick = static_cast<Tick>(k) * kExchange;
      while (next < commands.size() && ticks(commands[next].at_s) / kExchange * kExchange <= in.tick) {
        in.hand = commands[next++].command;
      }
      const PlannerOutput out = now->plan(in), same = then->plan(again);
      ASSERT_EQ(out.motion.index(), same.motion.index()) << k;
      const auto *a = std::get_if<TrajectoryCommand>(&out.motion), *b = std::get_if<TrajectoryCommand>(&same.motion);
      if (a == nullptr) continue;
      ASSERT_EQ(a->p_WB, b->p_WB) << k;
      ASSERT_EQ(a->yaw, b->yaw) << k;
      told.state.p_WB = repeated.state.p_WB = a->p_WB;
      told.state.v_WB = repeated.state.v_WB = a->v_WB;
      told.map.set_free(a->p_WB, 6.0);
      repeated.map.set_free(a->p_WB, 6.0);
      moved += a->v_WB.norm() > 0.1 ? 1 : 0;
    }
    EXPECT_GT(moved, 200U);
  }
}

TEST(Hand, TellsWhatHoldsItBack) {
  FlownUav uav(fleet_of(1, Role::explorer, 0), {100.0, 0.0, 6.0});
  uav.map.set_free(uav.state.p_WB, 8.0);
  const auto planner = make_planner("hand", uav.agent);
  std::vector<double> held;
  const auto fly = [&](const HandCommand& command, int exchanges) {
    for (int i = 0; i < exchanges; ++i) {
      PlannerInput in = uav.input();
      if (i == 0) in.hand = command;
      const PlannerOutput out = planner->plan(in);
      for (const DebugValue& value : out.debug) held.push_back(value.value);
      if (const auto* a = std::get_if<TrajectoryCommand>(&out.motion)) {
        uav.state.p_WB = a->p_WB;
        uav.state.v_WB = a->v_WB;
      }
      ++uav.k;
    }
  };
  fly({}, 5);
  EXPECT_EQ(held, std::vector<double>{static_cast<double>(HeldBack::no)});
  fly(up(-2.0), 200);
  EXPECT_EQ(held.back(), static_cast<double>(HeldBack::low));
  fly(up(2.0), 40);
  fly({}, 60);
  EXPECT_EQ(held.back(), static_cast<double>(HeldBack::no));
  fly(level(1.0, 0.0), 400);
  EXPECT_EQ(held.back(), static_cast<double>(HeldBack::unproved)) << "no beam has proved the space beyond";
  EXPECT_LT((uav.state.p_WB - Vector3d(100.0, 0.0, 6.0)).norm(), 8.0);
  fly({}, 60);
  EXPECT_EQ(held.back(), static_cast<double>(HeldBack::no));
}

/// A UAV whose program is started again in flight does not fall, and receives the command that holds by then.
TEST(Hand, ItsProgramStartsAgainInFlight) {
  TestWorld world = flown("again", {{1.0, up(1.0)}, {16.0, {}}, {21.0, level(1.0, 0.0)}, {45.0, {}}});
  world.run(19.0);
  const Vector3d before = world.position(0);
  world.restart(0);
  world.run(1.0);
  EXPECT_LT((world.position(0) - before).norm(), 0.1);
  world.run(14.0);
  world.restart(0);
  world.run(2.0);
  EXPECT_GT(world.position(0).x() - before.x(), 2.0);
  EXPECT_EQ(world.bad_commands(), 0U);
}

TEST(Hand, InvalidFilesOfCommandsAreRefused) {
  const AgentConfig agent = fleet_of(1, Role::explorer, 0);
  EXPECT_THROW(make_planner("hand:/no/such/file.csv", agent), InputError);
  EXPECT_THROW(make_planner("hand:file=/no/such/file.csv", agent), InputError);
  EXPECT_THROW(make_planner("hand:height=3", agent), InputError);
  EXPECT_NO_THROW(make_planner("hand:" + hand_csv("named", {}).string(), agent)) << "a table is the value of `file`";
}

}  // namespace
}  // namespace skein::agent
