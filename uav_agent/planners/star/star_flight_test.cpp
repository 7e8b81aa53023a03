// The STAR planner in flight: the goals that it gives to the flight core, and the resulting flights in a world without
// physics.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/star/talk.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kRestingMps = 0.1;

AgentConfig photographer_and_explorer() {
  AgentConfig agent;
  agent.fleet = {{.name = "eye", .role = Role::photographer, .body_radius_m = 0.32},
                 {.name = "lidar", .p_WB_start = {0.0, -8.0, 0.0}}};
  return agent;
}

/// A photographer that the navigator flies for STAR, in space that is known to be free.
struct AtWork : FlownUav {
  explicit AtWork(AgentConfig of_agent = photographer_and_explorer(), const std::string& spec = "star")
      : FlownUav(std::move(of_agent), {-10.0, 0.0, 10.0}), planner(make_planner(spec, agent)) {
    clear({-24.0, -30.0, 0.0}, {60.0, 30.0, 26.0});
  }

  PlannerInput planners_input(const FreeSpace& space) {
    PlannerInput in = input();
    in.gimbal = gimbal;
    in.space = &space;
    in.radio = radio;
    in.flight = {.working = true, .on_way = navigator.on_way(), .leg = navigator.leg()};
    if (navigator.current()) in.flight.goal = navigator.current()->id;
    in.flight.outcomes = navigator.take_outcomes();
    if (in.flight.goal && says) in.flight.outcomes.push_back({.id = *in.flight.goal, .kind = *says});
    return in;
  }
  /// One exchange. @returns what STAR wants.
  PlannerOutput work() {
    navigator.update(input());
    const FreeSpace space = navigator.open_space(input());
    const PlannerInput in = planners_input(space);
    PlannerOutput out = planner->plan(in);
    if (out.goals) navigator.want(*out.goals);
    Steering steering;
    navigator.step(in, filter.held(), steering);
    if (!steering.yaw) steering.yaw = out.yaw;
    if (const auto* command = std::get_if<GimbalCommand>(&out.gimbal)) gimbal.pitch = command->pitch;
    fly(steering);
    state.q_WB = Eigen::AngleAxisd(tracker.commanded().yaw, Vector3d::UnitZ());
    radio.clear();
    return out;
  }

  std::unique_ptr<Planner> planner;
  GimbalState gimbal;
  std::vector<RadioMessage> radio;
  std::optional<Outcome::Kind> says;  ///< an outcome that each goal gets, whatever the navigator does
};

/// Draws long walls. The UAV flies along them, plans anew on the way, and hardly rests.
TEST(StarFlight, GoesOnThroughItsViewpointsWithoutAStop) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "wall", 0);
    AtWork uav;
    const double x = random.uniform(6.0, 16.0), half = random.uniform(12.0, 18.0);
    uav.boxes = {make_box({x, 0.0, 10.0}, {8.0, 2.0 * half, 16.0})};
    uav.build({x - 0.5, -half, 5.0}, {x + 0.5, half, 15.0});
    int lists = 0, resting = 0;
    double flown_m = 0.0;
    while (uav.k < 900) {
      const Vector3d before = uav.state.p_WB;
      lists += uav.work().goals ? 1 : 0;
      flown_m += (uav.state.p_WB - before).norm();
      if (uav.k > 100 && uav.state.v_WB.norm() < kRestingMps) ++resting;
    }
    EXPECT_GT(lists, 20) << "seed " << seed;
    EXPECT_GT(flown_m, 50.0) << "seed " << seed;
    EXPECT_LT(resting, 80) << "seed " << seed << ": number of exchanges at rest, of 800";
  }
}

/// The first place of a goal's way, without the place where the UAV is.
Vector3d first_place(const Goal& goal, const Vector3d& here_W) {
  const bool begins_here = (goal.way.front().p_WB - here_W).norm() < 0.3;
  return goal.way[begins_here && goal.way.size() > 1 ? 1 : 0].p_WB;
}

TEST(StarFlight, AGoalThatCannotBeReachedIsPutOff) {
  for (const auto kind : {Outcome::Kind::no_way, Outcome::Kind::blocked}) {
    AtWork uav;
    uav.boxes = {make_box({12.0, 0.0, 10.0}, {8.0, 36.0, 16.0})};
    uav.build({11.5, -18.0, 5.0}, {12.5, 18.0, 15.0});
    std::vector<Goal> first, second;
    while (first.empty() && uav.k < 200) first = uav.work().goals.value_or(first);
    ASSERT_FALSE(first.empty());
    const Vector3d here_W = uav.state.p_WB;
    uav.says = kind;
    while (second.empty() && uav.k < 400) second = uav.work().goals.value_or(second);
    ASSERT_FALSE(second.empty());
    EXPECT_GT((first_place(first.front(), here_W) - first_place(second.front(), uav.state.p_WB)).norm(), 1.0);
  }
}

/// An explorer reports at which of two boxes it is. Its photographer flies there while it knows of no surface.
TEST(StarFlight, APhotographerWithoutSurfaceFliesToItsExplorersBox) {
  for (const std::size_t box : {0U, 1U}) {
    AtWork uav;
    uav.boxes = {make_box({30.0, -18.0, 9.0}, {6.0, 6.0, 14.0}), make_box({30.0, 18.0, 9.0}, {6.0, 6.0, 14.0})};
    AgentConfig explorer = uav.agent;
    explorer.self = UavIndex(1);
    StarTalk talk({}, explorer);
    const VoxelGrid nothing(Isometry3d::Identity(), {4.0, 4.0, 4.0}, 2.0);
    double nearest_m = 1e9;
    while (uav.k < 600) {
      PlannerOutput said;
      PlannerInput in = uav.input();
      StarTalk::Word word;
      word.box = box;
      talk.speak(in, nothing, word, said);
      uav.radio = said.radio;
      uav.work();
      nearest_m = std::min(nearest_m, (uav.state.p_WB - uav.boxes[box].center).norm());
      if (nearest_m < 14.0) break;
      ASSERT_GT((uav.state.p_WB - uav.boxes[1 - box].center).norm(), 14.0) << "it must not fly to the other box first";
    }
    EXPECT_LT(nearest_m, 14.0);
  }
}

/// Number of places in front of a wall to which an explorer asks to fly. The wall is completely known, and the explorer
/// has photographers in its team. An explorer that inspects has viewpoints there; another one has nothing to do there.
std::size_t places_before_walls(const std::string& planner, std::size_t photographers) {
  AgentConfig agent;
  agent.fleet = {{.name = "lidar", .body_radius_m = 0.32}};
  for (std::size_t i = 0; i < photographers; ++i) {
    agent.fleet.push_back({.name = "eye", .role = Role::photographer, .p_WB_start = {0.0, -8.0, 0.0}});
  }
  AtWork uav(agent, planner);
  const OrientedBox box = make_box({10.0, 0.0, 10.0}, {8.0, 28.0, 14.0});
  uav.boxes = {box};
  uav.build({9.5, -14.0, 4.0}, {10.5, 14.0, 16.0});
  std::size_t near = 0;
  while (uav.k < 1200) {
    const auto goals = uav.work().goals;
    for (const Goal& goal : goals.value_or(std::vector<Goal>())) {
      const Vector3d place = first_place(goal, uav.state.p_WB);
      const bool on_its_way = (place - uav.state.p_WB).norm() > 0.5;
      near += on_its_way && std::abs(place.x() - 10.0) < 7.0 && std::abs(place.y()) < 13.0 ? 1U : 0U;
    }
  }
  return near;
}

TEST(StarFlight, ExplorersInspectOnlyIfConfiguredOrWithoutPhotographers) {
  EXPECT_LT(places_before_walls("star", 1), places_before_walls("star:explorers_inspect=true", 1) / 4);
  EXPECT_GT(places_before_walls("star:explorers_inspect=true,faithful=true", 1), 20U)
      << "a parameter that is given wins";
  EXPECT_GT(places_before_walls("star", 0), 20U) << "it has no photographer";
}

/// One of two boxes belongs to another team. A team whose own box is explored and photographed goes on to the other box
/// with `helps`, and stays without it.
TEST(StarFlight, ATeamThatHasNothingLeftToDoHelpsUnlessItIsFaithful) {
  for (const bool helps : {true, false}) {
    AgentConfig agent = photographer_and_explorer();
    agent.fleet.push_back({.name = "other", .p_WB_start = {60.0, 20.0, 0.0}});
    AtWork uav(agent, helps ? "star" : "star:helps=false");
    uav.boxes = {make_box({10.0, -20.0, 9.0}, {6.0, 6.0, 14.0}), make_box({40.0, 18.0, 9.0}, {6.0, 6.0, 14.0})};
    AgentConfig explorer = agent;
    explorer.self = UavIndex(1);
    StarTalk talk({}, explorer);
    const VoxelGrid nothing(Isometry3d::Identity(), {4.0, 4.0, 4.0}, 2.0);
    double nearest_m = 1e9;
    while (uav.k < 1200) {
      PlannerOutput said;
      StarTalk::Word word;
      word.explored = true;
      talk.speak(uav.input(), nothing, word, said);
      uav.radio = said.radio;
      uav.work();
      nearest_m = std::min(nearest_m, (uav.state.p_WB - uav.boxes[1].center).norm());
    }
    EXPECT_EQ(nearest_m < 14.0, helps) << nearest_m;
  }
}

TEST(Star, PhotographsTheStructureAndDeliversThePictures) {
  TestWorld world(two_towers(), test_fleet(3), "star", 300.0);
  world.run(300.0);
  EXPECT_GT(world.coverage(), 0.5);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.4);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only captures of the last seconds are left";
}

TEST(Star, PhotographersBeginWhileTheExplorerExplores) {
  TestWorld world(two_towers(), test_fleet(3), "star", 120.0);
  world.run(45.0);
  EXPECT_GT((world.position(1).head<2>() - Vector2d(-5.0, -14.0)).norm(), 3.0);
}

TEST(Star, FaithfulUavsFlySafelyToo) {
  TestWorld world(two_towers(), test_fleet(4), "star:faithful=true", 150.0);
  world.run(150.0);
  EXPECT_EQ(world.bad_commands(), 0U);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.3);
  EXPECT_GT(world.gap(), 0.3);
}

TEST(Star, WithoutALidarItLooksAtTheBoxes) {
  TestWorld world(two_towers(), {{"eye", Role::photographer, {-8.0, -14.0}}}, "star", 250.0);
  world.run(250.0);
  EXPECT_GT(world.coverage(), 0.1);
  EXPECT_GT(world.clearance(), 0.32 + 0.5);
}

}  // namespace
}  // namespace skein::agent
