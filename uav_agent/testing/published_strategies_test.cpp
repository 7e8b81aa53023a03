// The published strategies with fleets and boxes that their papers do not have, and what `faithful=true` changes:
// docs/strategies.md must list all of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <string_view>

#include "core/config/config_writer.hpp"
#include "core/math/random_stream.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"
#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planners/star/config.hpp"
#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kBodyAndABit_M = kExplorerRadiusM + 0.3, kBetweenBodiesM = 0.3;

class PublishedStrategy : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Planners, PublishedStrategy, testing::Values("flock", "kios", "xxh", "star"));

std::vector<TestUav> fleet_of(int explorers, int photographers) {
  std::vector<TestUav> fleet;
  for (int i = 0; i < explorers + photographers; ++i) {
    fleet.push_back(
        {"uav" + std::to_string(i), i < explorers ? Role::explorer : Role::photographer, {3.0 * i - 8.0, -14.0}});
  }
  return fleet;
}

void expect_work(const TestScene& scene, const std::vector<TestUav>& fleet, const std::string& planner) {
  TestWorld world(scene, fleet, planner, 300.0);
  world.run(200.0);
  EXPECT_EQ(world.bad_commands(), 0U);
  EXPECT_GT(world.clearance(), kBodyAndABit_M);
  EXPECT_GT(world.gap(), kBetweenBodiesM);
  EXPECT_GT(world.coverage(), 0.05);
}

/// One explorer and many photographers; fewer photographers than explorers; explorers alone.
TEST_P(PublishedStrategy, InspectsWithAnyFleetThatHasAnExplorer) {
  RandomStream random(7, GetParam(), 0);
  std::vector<std::pair<int, int>> fleets = {{1, 5}, {3, 1}, {2, 0}, {1, 0}, {4, 2}};
  const std::size_t left_out = random.bits() % fleets.size();
  fleets.erase(fleets.begin() + static_cast<std::ptrdiff_t>(left_out));
  for (const auto& [explorers, photographers] : fleets) {
    SCOPED_TRACE(std::to_string(explorers) + " explorers, " + std::to_string(photographers) + " photographers");
    expect_work(two_towers(), fleet_of(explorers, photographers), GetParam());
  }
}

TEST_P(PublishedStrategy, InspectsWhateverTheBoxes) {
  TestScene around_all = two_towers(), overlapping = two_towers(), one = two_towers();
  around_all.boxes = {make_box({14.0, 12.0, 16.0}, {54.0, 26.0, 32.0})};
  overlapping.boxes.push_back(overlapping.boxes[0]);
  overlapping.boxes.back().center += Vector3d(4.0, 1.0, 1.0);
  one.boxes.pop_back();  // one team gets no box
  for (const TestScene* scene : {&around_all, &overlapping, &one}) {
    SCOPED_TRACE(std::to_string(scene->boxes.size()) + " boxes");
    expect_work(*scene, fleet_of(2, 2), GetParam());
  }
}

/// The clock counts its readings, so a part that is timed takes at least one unit of time.
TEST_P(PublishedStrategy, FliesTheSameWhileItsPartsAreTimed) {
  TestWorld alone(two_towers(), fleet_of(1, 1), GetParam(), 300.0);
  TestWorld timed(two_towers(), fleet_of(1, 1), GetParam(), 300.0);
  double readings = 0.0;
  timed.time_parts([&] { return ++readings; });
  alone.run(60.0);
  timed.run(60.0);
  EXPECT_EQ(timed.fingerprint(), alone.fingerprint());
  double sum = 0.0;
  std::set<std::string_view> of_planner, of_flight;
  for (const std::size_t uav : {0U, 1U}) {
    for (const WorkParts::Part& part : timed.parts(uav).all()) {
      EXPECT_GT(part.cpu_s, 0.0) << part.name;
      sum += part.cpu_s;
      if (part.name.starts_with("planner/")) of_planner.insert(part.name);
      if (part.name.starts_with("flight/")) of_flight.insert(part.name);
    }
  }
  EXPECT_LE(sum, readings);
  EXPECT_GE(of_planner.size(), 4U);
  EXPECT_GE(of_flight.size(), 4U);
}

/// Lines "| planner | key | ours | faithful |" of all that `faithful` changes.
template <class Config>
void list_changes(const std::string& planner, std::vector<std::string>& lines) {
  Config faithful;
  faithful.faithful = true;
  const ConfigNode ours = *ConfigWriter::node_of(Config().resolved());
  const ConfigNode changed = *ConfigWriter::node_of(faithful.resolved());
  const std::string never = ConfigWriter::node_of(kNeverS)->scalar;
  const auto value = [&](const ConfigNode& node) { return node.scalar == never ? "never" : node.scalar; };
  for (const std::string& key : ours.keys) {
    const ConfigNode &before = *ours.find(key), &after = *changed.find(key);
    if (key == "faithful" || after.scalar == before.scalar) continue;
    lines.push_back("| `" + planner + "` | `" + key + "` | " + value(before) + " | " + value(after) + " |");
  }
}

TEST(Faithful, ChangesWhatItsTableListsAndNothingElse) {
  std::vector<std::string> changes;
  list_changes<KiosConfig>("kios", changes);
  list_changes<XxhConfig>("xxh", changes);
  list_changes<StarConfig>("star", changes);
  std::ifstream page(source_path("docs/strategies.md"));
  std::vector<std::string> told;
  const std::regex row(R"((\| `\w+` \| `\w+` \| [^|]+ \| [^|]+ \|).*)");
  std::smatch match;
  for (std::string line; std::getline(page, line);) {
    if (std::regex_match(line, match, row)) told.push_back(match[1]);
  }
  std::ranges::sort(changes);
  std::ranges::sort(told);
  EXPECT_EQ(told, changes);
}

/// The test of the table compares configurations. So planners may read `faithful` only in resolved(), because the table
/// would not show other changes of behaviour.
TEST(Faithful, IsReadOnlyWhereParametersAreFilledIn) {
  for (const std::string planner : {"kios", "xxh", "star"}) {
    for (const auto& file : std::filesystem::directory_iterator(source_path("uav_agent/planners/" + planner))) {
      const std::string name = file.path().filename();
      if (name.ends_with("_test.cpp") || name == "config.hpp") continue;
      const std::string text = skein::read_text(file.path());
      EXPECT_FALSE(std::regex_search(text, std::regex(R"(\.faithful)"))) << planner << "/" << name;
    }
  }
}

/// `faithful` does not change parameters that the user sets by name.
TEST(Faithful, LeavesGivenParametersUnchanged) {
  XxhConfig config;
  config.faithful = true;
  config.layer_step = 2;
  config.order = XxhOrder::spiral;
  EXPECT_EQ(config.resolved().layer_step, 2);
  EXPECT_EQ(config.resolved().order, XxhOrder::spiral);
  EXPECT_EQ(config.resolved().begin, XxhBegin::path);
}

}  // namespace
}  // namespace skein::agent
