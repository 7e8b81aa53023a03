// When cubes of a map appear and disappear: at each time, the sent cubes are those of the newest snapshot.
#include "view/map_steps.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "process/json_text.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::view {
namespace {

using CubePlace = std::tuple<int, int, int>;  // z, y, x
using CubePlaces = std::set<CubePlace>;

CubePlaces places_of(const std::vector<CubeRun>& runs) {
  CubePlaces places;
  for (const CubeRun& run : runs) {
    for (int i = 0; i < run.length; ++i)
      EXPECT_TRUE(places.emplace(run.z, run.y, run.x + i).second) << "two runs contain the same cube";
  }
  return places;
}

/// The cubes that the page shows at this time.
CubePlaces shown_at(double now_s, const std::vector<RunsStep>& steps) {
  std::vector<CubeRun> runs;
  for (const RunsStep& step : steps) {
    const bool there = step.time_s <= now_s && (!step.until_s || now_s < *step.until_s);
    if (there) runs.insert(runs.end(), step.runs.begin(), step.runs.end());
  }
  return places_of(runs);
}

/// Random snapshots of a map that grows and loses some of its cells.
std::vector<RunsAt> drawn_snapshots(std::mt19937& random) {
  std::vector<RunsAt> snapshots;
  CubePlaces known;
  double time_s = 0.0;
  for (unsigned i = 1 + random() % 12; i > 0; --i) {
    const auto along = [&] { return static_cast<int>(random() % 9) - 4; };
    for (unsigned j = random() % 60; j > 0; --j) known.emplace(along() / 2, along(), along());
    for (unsigned j = random() % 30; j > 0; --j) known.erase({along() / 2, along(), along()});
    if (random() % 8 == 0) known.clear();  // as if the UAV's program had been restarted
    std::vector<CubeRun> runs;
    for (const auto& [z, y, x] : known) runs.push_back({x, y, z, 1});
    time_s += 1.0 + static_cast<double>(random() % 5);
    snapshots.push_back({time_s, joined_runs(std::move(runs))});
  }
  return snapshots;
}

TEST(MapSteps, ShowTheNewestSnapshotAtEachTime) {
  std::mt19937 random(1);
  std::size_t gone = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<RunsAt> snapshots = drawn_snapshots(random);
    const std::vector<RunsStep> steps = lifetimes(snapshots);
    EXPECT_TRUE(shown_at(snapshots[0].time_s - 0.5, steps).empty());
    for (const RunsAt& snapshot : snapshots) {
      EXPECT_EQ(shown_at(snapshot.time_s, steps), places_of(snapshot.runs));
      EXPECT_EQ(shown_at(snapshot.time_s + 0.9, steps), places_of(snapshot.runs))
          << "this snapshot holds until the next one";
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      gone += steps[i].until_s ? steps[i].runs.size() : 0;
      EXPECT_EQ(joined_runs(steps[i].runs), steps[i].runs);
      EXPECT_LE(steps[i == 0 ? 0 : i - 1].time_s, steps[i].time_s);
    }
  }
  EXPECT_GT(gone, 1000U) << "too few cubes disappeared for this test";
}

TEST(MapSteps, HaveOneStepForCubesThatStay) {
  const std::vector<CubeRun> wall = {{0, 0, 0, 7}, {0, 0, 1, 7}};
  const std::vector<RunsStep> steps =
      lifetimes(std::vector<RunsAt>{{1.0, wall}, {2.0, wall}, {3.0, {{0, 0, 0, 7}, {2, 0, 1, 3}}}});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].until_s, 3.0);
  EXPECT_EQ(steps[0].runs, (std::vector<CubeRun>{{0, 0, 1, 2}, {5, 0, 1, 2}}));
  EXPECT_EQ(steps[1].until_s, std::nullopt);
  EXPECT_EQ(steps[1].runs, (std::vector<CubeRun>{{0, 0, 0, 7}, {2, 0, 1, 3}}));
}

TEST(MapSteps, HaveLargerCubesIfThereWouldBeTooMany) {
  std::mt19937 random(2);
  std::size_t larger = 0, larger_free = 0;
  for (int round = 0; round < 200; ++round) {
    const std::vector<RunsAt> snapshots = drawn_snapshots(random);
    std::vector<RunsAt> few = snapshots;
    for (RunsAt& snapshot : few) std::erase_if(snapshot.runs, [](const CubeRun& run) { return run.z != 0; });
    const bool at_once = round % 2 == 0;
    const MapInTime map = map_in_time(snapshots, few, 0.5, at_once ? 30 : 1000, at_once ? 1000 : 120);
    std::size_t rows = 0;
    for (const RunsStep& step : map.occupied) rows += step.runs.size();
    EXPECT_LE(rows, at_once ? 1000U : 120U);
    larger += map.cell_m > 0.5 ? 1 : 0;
    larger_free += map.slice_cell_m > map.cell_m ? 1 : 0;
    for (const RunsAt& snapshot : snapshots) {
      std::vector<CubeRun> runs = snapshot.runs;
      for (double cell_m = 0.5; cell_m < map.cell_m; cell_m *= 2.0) runs = coarser_runs(runs);
      EXPECT_LE(runs.size(), at_once ? 30U : 120U);
      EXPECT_EQ(shown_at(snapshot.time_s, map.occupied), places_of(runs));
    }
    for (const RunsAt& snapshot : few) {
      std::vector<CubeRun> runs = snapshot.runs;
      for (double cell_m = 0.5; cell_m < map.slice_cell_m; cell_m *= 2.0) runs = coarser_runs(runs);
      EXPECT_EQ(shown_at(snapshot.time_s, map.free), places_of(runs));
    }
  }
  EXPECT_GT(larger, 20U);
  EXPECT_EQ(larger_free, 0U) << "the size of occupied cubes must not affect that of free ones";
}

TEST(MapSteps, AreSentUnchanged) {
  const MapInTime map{1.0, 0.5, {5.0, 7.5}, {{5.0, 7.5, {{1, 2, 3, 4}}}, {7.5, {}, {{-1, 0, 0, 1}}}}, {{5.0, {}, {}}}};
  const Json told = parse_json(map_text("a", map, "what it flies on"));
  EXPECT_EQ(told["n"], "map a");
  EXPECT_EQ(told["t"], 7.5);
  EXPECT_EQ(told["times"], Json::parse("[5.0, 7.5]"));
  EXPECT_EQ(told["cell"], 1.0);
  EXPECT_EQ(told["freeCell"], 0.5);
  EXPECT_EQ(told["steps"][0]["until"], 7.5);
  EXPECT_FALSE(told["steps"][1].contains("until"));
  EXPECT_EQ(unpacked_runs(told["steps"][0]["runs"].get<std::string>()), map.occupied[0].runs);
  EXPECT_EQ(told["freeSteps"].size(), 1U);
}

}  // namespace
}  // namespace skein::view
