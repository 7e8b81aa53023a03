// XXH's task assignment: properties over many fleets and sites, and the radio in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "uav_agent/api/ground_program.hpp"
#include "uav_agent/planners/xxh/crew.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kTolerance = 0.05;

/// Numbers in [lo, hi), the same everywhere.
class Draws {
 public:
  explicit Draws(unsigned seed) : engine_(seed) {}
  double operator()(double lo, double hi) { return lo + (hi - lo) * (engine_() / 4294967296.0); }

 private:
  std::mt19937 engine_;
};

std::vector<OrientedBox> draw_boxes(Draws& draw, int count) {
  std::vector<OrientedBox> boxes;
  for (int i = 0; i < count; ++i) {
    const Vector3d size(draw(4.0, 60.0), draw(4.0, 40.0), draw(4.0, 50.0));
    const Vector3d centre(draw(-80.0, 80.0), draw(-80.0, 80.0), 0.5 * size.z());
    boxes.push_back(make_box(centre, size, draw(0.0, 3.0)));
  }
  return boxes;
}

std::vector<XxhStart> draw_starts(Draws& draw, std::size_t uavs, std::size_t explorers) {
  std::vector<XxhStart> starts;
  for (std::size_t i = 0; i < uavs; ++i) {
    starts.push_back({i, i < explorers ? Role::explorer : Role::photographer, {draw(-50, 50), draw(-50, 50), 0.0}});
  }
  return starts;
}

/// Every combination of 1 to 8 UAVs, of which some explore, and 1 to 15 boxes.
void for_many_sites(const auto& check) {
  for (std::size_t uavs = 1; uavs <= 8; ++uavs) {
    for (std::size_t explorers = 0; explorers <= uavs; explorers += 1 + uavs / 3) {
      for (int boxes = 1; boxes <= 15; ++boxes) {
        Draws draw(static_cast<unsigned>(1000 * uavs + 100 * explorers) + static_cast<unsigned>(boxes));
        const auto site = draw_boxes(draw, boxes);
        check(draw_starts(draw, uavs, explorers), site);
      }
    }
  }
}

TEST(XxhPlan, EachUavIsInOneTeamAndEachBoxIsCoveredOnce) {
  for_many_sites([](const std::vector<XxhStart>& starts, const std::vector<OrientedBox>& boxes) {
    const XxhPlan plan = assign(starts, boxes, kTolerance);
    std::map<std::size_t, int> members;
    std::map<std::size_t, std::vector<std::pair<int, int>>> slices;
    for (const XxhTeam& team : plan.teams) {
      for (const std::size_t uav : team.members) ++members[uav];
      for (const XxhRegion& region : team.regions) slices[region.box].emplace_back(region.from, region.to);
    }
    ASSERT_EQ(members.size(), starts.size());
    for (const auto& [uav, times] : members) EXPECT_EQ(times, 1);
    ASSERT_EQ(slices.size(), boxes.size());
    for (auto& [box, parts] : slices) {
      std::ranges::sort(parts);
      int at = 0;
      for (const auto& [from, to] : parts) {
        EXPECT_EQ(from, at) << "no gap, no overlap";
        EXPECT_GT(to, from);
        at = to;
      }
      EXPECT_EQ(at, XxhRegion::kWhole);
    }
  });
}

TEST(XxhPlan, SharesAreInProportionToTheTeams) {
  for_many_sites([](const std::vector<XxhStart>& starts, const std::vector<OrientedBox>& boxes) {
    const XxhPlan plan = assign(starts, boxes, kTolerance);
    double total = 0.0;
    for (const OrientedBox& box : boxes) total += volume_of(box);
    for (const XxhTeam& team : plan.teams) {
      double volume = 0.0;
      for (const XxhRegion& region : team.regions) volume += volume_of(region_box(region, boxes[region.box]));
      const double fair = static_cast<double>(team.members.size()) / static_cast<double>(starts.size());
      EXPECT_NEAR(volume / total, fair, 2.0 * kTolerance + 0.002) << "off by the tolerance at either end";
    }
  });
}

TEST(XxhPlan, EachTeamHasAnExplorerAndThePhotographersThatStandNearIt) {
  for_many_sites([](const std::vector<XxhStart>& starts, const std::vector<OrientedBox>& boxes) {
    const auto explores = [&](std::size_t uav) { return starts[uav].role == Role::explorer; };
    const XxhPlan plan = assign(starts, boxes, kTolerance);
    const auto explorers = std::ranges::count(starts, Role::explorer, &XxhStart::role);
    ASSERT_EQ(plan.teams.size(), std::max<std::size_t>(1, static_cast<std::size_t>(explorers)));
    for (const XxhTeam& team : plan.teams) {
      if (explorers == 0) continue;
      const Vector3d leader = starts[team.members.front()].p_WB;
      EXPECT_TRUE(explores(team.members.front()));
      for (std::size_t i = 1; i < team.members.size(); ++i) {
        const Vector3d p = starts[team.members[i]].p_WB;
        EXPECT_FALSE(explores(team.members[i]));
        for (const XxhStart& other : starts) {
          if (other.role != Role::explorer) continue;
          EXPECT_LE((p - leader).norm(), (p - other.p_WB).norm());
        }
      }
    }
  });
}

TEST(XxhPlan, DoesNotDependOnTheOrderOfReports) {
  for_many_sites([](const std::vector<XxhStart>& starts, const std::vector<OrientedBox>& boxes) {
    std::vector<XxhStart> reversed(starts.rbegin(), starts.rend());
    EXPECT_EQ(assign(starts, boxes, kTolerance), assign(reversed, boxes, kTolerance));
  });
}

TEST(XxhPlan, GoesFromEachBoxToTheNearestEndOfTheNext) {
  const std::vector<OrientedBox> row = {make_box({70.0, 0.0, 5.0}, {20.0, 6.0, 10.0}),
                                        make_box({10.0, 0.0, 5.0}, {20.0, 6.0, 10.0}),
                                        make_box({40.0, 0.0, 5.0}, {20.0, 6.0, 10.0})};
  const XxhPlan plan = assign({{0, Role::explorer, {-5.0, 0.0, 0.0}}}, row, kTolerance);
  const std::vector<XxhRegion> expected = {{1, 0, 1000, false}, {2, 0, 1000, false}, {0, 0, 1000, false}};
  EXPECT_EQ(plan.teams.front().regions, expected);
}

TEST(XxhPlan, CutsABoxAcrossItsLongestEdgeWhereTheShareEnds) {
  const std::vector<OrientedBox> one = {make_box({0.0, 0.0, 5.0}, {60.0, 6.0, 10.0})};
  const XxhPlan plan = assign({{0, Role::explorer, {40.0, 0.0, 0.0}},
                               {1, Role::explorer, {-40.0, 0.0, 0.0}},
                               {2, Role::photographer, {41.0, 0.0, 0.0}}},
                              one, kTolerance);
  ASSERT_EQ(plan.teams.size(), 2U);
  const std::vector<XxhRegion> first = {{0, 333, 1000, true}}, second = {{0, 0, 333, true}};
  EXPECT_EQ(plan.teams[0].regions, first);
  EXPECT_EQ(plan.teams[1].regions, second);
  EXPECT_NEAR(region_box(plan.teams[1].regions[0], one[0]).center.x(), -20.0, 0.1);
}

TEST(XxhPlan, IsReadAsItWasWrittenAndADamagedOneIsRefused) {
  Draws draw(7);
  const auto boxes = draw_boxes(draw, 6);
  const XxhPlan plan = assign(draw_starts(draw, 5, 2), boxes, kTolerance);
  PayloadWriter writer;
  write_plan(plan, writer);
  PayloadReader reader(writer.data());
  EXPECT_EQ(read_plan(reader, 5, 6), plan);
  PayloadReader fewer_boxes(writer.data());
  EXPECT_FALSE(read_plan(fewer_boxes, 5, 5));
  PayloadReader fewer_uavs(writer.data());
  EXPECT_FALSE(read_plan(fewer_uavs, 4, 6));
  for (std::size_t length = 0; length < writer.size(); ++length) {
    PayloadReader cut(std::span(writer.data()).first(length));
    EXPECT_FALSE(read_plan(cut, 5, 6));
  }
}

/// A fleet on the ground and its station, which hear each other or not.
struct Ground {
  AgentConfig agent;
  std::vector<OrientedBox> boxes;
  OccupancyMap map;

  Ground() {
    const auto towers = two_towers();
    boxes = towers.boxes;
    for (const TestUav& uav : test_fleet(4)) {
      agent.fleet.push_back({uav.name, uav.role, {uav.start.x(), uav.start.y(), 0.0}, 0.5});
    }
  }
  PlannerInput input(std::uint64_t k, const Peers& peers, const std::vector<RadioMessage>& radio) const {
    PlannerInput in{k, static_cast<Tick>(k) * ticks(0.05), {}, {}, {}, map, boxes, peers, {}, true, 0, {}, radio};
    return in;
  }
  /// The team that a UAV assumes after the exchanges of the test, in which the station hears the UAVs in `reporters`.
  XxhTeam team(UavIndex uav, const std::vector<std::size_t>& reporters, bool hears_station) const {
    AgentConfig ground = agent, self = agent;
    ground.self = UavIndex(agent.fleet.size());
    self.self = UavIndex(uav);
    const auto station = make_ground_program("xxh", ground);
    const XxhConfig config;
    XxhTalk talk({}, self);
    XxhCrew crew(config, self, talk);
    const Peers peers(self);
    std::vector<RadioMessage> said;
    const std::vector<RadioMessage> silence;
    for (std::uint64_t k = 0; k < 20 * 20; ++k) {
      GroundInput at_station{k, static_cast<Tick>(k) * ticks(0.05), boxes, {}, {}, {}};
      for (const std::size_t reporter : reporters) {
        XxhWord word;
        word.start_W = agent.fleet[reporter].p_WB_start + Vector3d(0.1, -0.2, 0.16);  // not quite where it should be
        PayloadWriter writer;
        write_word(word, writer);
        at_station.radio.push_back(send_payload("xxh/1", reporter, writer));
      }
      said = station->work(at_station);
      const PlannerInput in = input(k, peers, hears_station ? said : silence);
      talk.listen(in, nullptr);
      if (crew.seek_assignment(in, false)) break;
    }
    XxhTeam team;
    if (crew.assigned()) team = {crew.members(), crew.regions()};
    return team;
  }
};

TEST(XxhGround, AssignsWhatEachUavWouldAssignItself) {
  const Ground ground;
  for (const UavIndex uav : FirstUavs(4)) {
    const XxhTeam told = ground.team(uav, {0, 1, 2, 3}, true);
    const XxhTeam own = ground.team(uav, {0, 1, 2, 3}, false);
    ASSERT_FALSE(told.regions.empty());
    EXPECT_EQ(told, own);
  }
}

TEST(XxhGround, AUavThatCouldNotReportIsAssignedFromItsNominalStart) {
  const Ground ground;
  for (const UavIndex uav : FirstUavs(4)) {
    EXPECT_EQ(ground.team(uav, {0, 2}, true), ground.team(uav, {}, false));
  }
}

TEST(XxhGround, SendsNothingMoreOnceAllUavsHaveThePlan) {
  const Ground ground;
  AgentConfig config = ground.agent;
  config.self = UavIndex(config.fleet.size());
  const auto station = make_ground_program("xxh", config);
  std::size_t said = 0, said_late = 0;
  for (std::uint64_t k = 0; k < 400; ++k) {
    GroundInput in{k, static_cast<Tick>(k) * ticks(0.05), ground.boxes, {}, {}, {}};
    for (const UavIndex uav : FirstUavs(4)) {
      XxhWord word;
      word.start_W = ground.agent.fleet[uav].p_WB_start;
      word.has_plan = k > 100;
      PayloadWriter writer;
      write_word(word, writer);
      in.radio.push_back(send_payload("xxh/1", uav, writer));
    }
    const auto messages = station->work(in);
    (k > 120 ? said_late : said) += messages.size();
  }
  EXPECT_GT(said, 5U);
  EXPECT_EQ(said_late, 0U);
}

}  // namespace
}  // namespace skein::agent
