// Tests the controller with random sequences of crashes and failures ("orders", each with its own seed). Whatever an
// engine does to the units, the nodes and the controller, in the end the sweep has exactly one result of each flight,
// and it is the result that a node without faults (a "sound" node) produces.
#include "cli/sweep/controller.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "cli/sweep/testing/made_up_nodes.hpp"
#include "cli/sweep/unit_run.hpp"
#include "core/types.hpp"
#include "results/result_file.hpp"
#include "tests/support/test_program.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// A sweep on fake nodes, with a fake engine. Each control() starts another controller on the same sweep folder, as if
/// the user repeated the command.
class Sweep {
 public:
  Sweep(std::uint64_t seed, std::size_t flights, std::size_t unit_flights, std::vector<MadeUpNode> its_nodes)
      : world(seed, flights), nodes(std::move(its_nodes)), engine(world, nodes), unit_flights_(unit_flights) {}

  /// Runs one controller until it ends or is killed. @returns false if it was killed.
  bool control() try {
    said.str("");
    SweepFolder folder = world.folder();
    folder.on_step([this] {
      if (world.draw.uniform() < engine.manners.kills_controller) throw Killed{};
    });
    const SweepNode node = world.node(here, [] {});
    SweepController controller(folder, engine, node, said);
    controller.plan(world.plan(unit_flights_));
    controller.fly();
    return true;
  } catch (const Killed&) {
    return false;
  }
  /// Ends all random failures of engine and disks, and runs two controllers to their end. Two are needed: a worker
  /// that outlived its controller may have lost a flight to a full disk. Now its reference flight succeeds, so it
  /// records the flight as failed, and only the second controller has this flight flown again.
  void end_well() {
    engine.manners = {};
    for (MadeUpNode& node : nodes) {
      node.disk_fills = 0.0;
      node.sick = false;
    }
    ASSERT_TRUE(control());
    ASSERT_TRUE(control());
  }

  std::map<std::size_t, std::vector<SweepRow>> rows() {
    SweepFolder folder = world.folder();
    const SweepNode node = world.node(here, [] {});
    SweepController controller(folder, engine, node, said);
    controller.look();
    std::map<std::size_t, std::vector<SweepRow>> rows;
    controller.collect([&](const SweepRow& row) { rows[row.index].push_back(row); });
    return rows;
  }
  void expect_all(std::size_t flights) {
    const auto all = rows();
    ASSERT_EQ(all.size(), flights);
    for (const auto& [index, its] : all) {
      ASSERT_EQ(its.size(), 1U) << "flight " << index << " counts more than once";
      ASSERT_EQ(its[0].problem, world.fails(index) ? kMadeUpProblem : "") << index;
      ASSERT_EQ(its[0].figures["digest"], world.digest(index)) << "flown by node " << its[0].node;
      const SweepFlight flight = world.flight(index);
      const Json mark = read_json(flight.dir / kFlightMark);
      ASSERT_EQ(value_or(mark, "command", nullptr), flight.made_under) << index;
      ASSERT_EQ(value_or(read_json(flight.dir / run_folder::kResult), "digest", nullptr), world.digest(index)) << index;
    }
  }
  bool quarantined(const std::string& node) const { return world.folder().quarantined(node).has_value(); }

  MadeUpWorld world;
  std::vector<MadeUpNode> nodes;
  MadeUpNode here{"here"};
  MadeUpEngine engine;
  std::ostringstream said;

 private:
  const std::size_t unit_flights_;
};

std::vector<MadeUpNode> drawn_nodes(RandomStream& draw) {
  std::vector<MadeUpNode> nodes = {{"sound 1"}, {"sound 2"}, {"full"}, {"other cpu"}, {"other build"}};
  nodes[2].disk_fills = 0.2;
  nodes[3].other_arithmetic = true;
  nodes[4].other_build = true;
  const auto count = 1 + static_cast<std::size_t>(draw.uniform() * static_cast<double>(nodes.size()));
  nodes.resize(std::min(count, nodes.size()));
  return nodes;
}

TEST(SweepController, LosesAndDoublesNoFlightInRandomOrders) {
  // Each order starts many threads and writes many small files, so at each commit a tenth of them runs (SKEIN_TURN).
  std::size_t orders = 0, killed = 0, failing = 0;
  for (std::uint64_t order = 1; order <= 2000; ++order) {
    if (!has_turn(order, 10)) continue;
    ++orders;
    SCOPED_TRACE("order " + std::to_string(order));
    RandomStream draw(order, "manners", 0);
    const auto flights = 1 + static_cast<std::size_t>(12.0 * draw.uniform());
    const auto unit = 1 + static_cast<std::size_t>(4.0 * draw.uniform());
    Sweep sweep(order, flights, unit, drawn_nodes(draw));
    sweep.engine.manners = {0.03 * draw.uniform(), 0.02 * draw.uniform(), draw.uniform(), 0.5 * draw.uniform(),
                            1 + static_cast<std::size_t>(5.0 * draw.uniform())};
    if (draw.uniform() < 0.3) sweep.world.failing = {static_cast<std::size_t>(draw.uniform() * 3.0)};
    for (int controller = 0; controller < 3 && !sweep.control(); ++controller) ++killed;
    sweep.end_well();
    sweep.expect_all(flights);
    if (::testing::Test::HasFatalFailure()) return;
    failing += sweep.world.failing.size();
    const SweepFolder folder = sweep.world.folder();
    EXPECT_FALSE(folder.quarantined("sound 1")) << *folder.quarantined("sound 1");
    EXPECT_FALSE(folder.quarantined("sound 2")) << *folder.quarantined("sound 2");
    EXPECT_TRUE(fs::is_empty(folder.dir() / "air"));
  }
  EXPECT_GT(killed, orders / 5) << "controllers are killed in many orders";
  EXPECT_GT(failing, orders / 10);
}

TEST(SweepController, TheStatusTellsHowManyChecksDiffer) {
  Sweep sweep(1, 12, 2, {{"sound 1"}, {"sound 2"}});
  ASSERT_TRUE(sweep.control());
  SweepFolder folder(sweep.world.study());
  const std::string token = folder.settings().value().token;
  const SweepNode node = sweep.world.node(sweep.here, [] {});
  SweepController controller(folder, sweep.engine, node, sweep.said);
  controller.look();
  const std::string before = controller.findings().back(), nodes = before.substr(0, before.find("; ") + 2);
  EXPECT_EQ(before, nodes + "1 flight flown again elsewhere, each with the same digest");
  // The checks are now as a worker leaves them, before a controller judges them.
  for (const std::size_t index : folder.checks(token)) folder.forget_check(token, index);
  EXPECT_EQ(controller.findings().back(), nodes + "no flight was flown again on a second node");
  folder.write_check(token, {0, "sound 2", "a", "sound 1", "a"});
  folder.write_check(token, {1, "sound 2", "b?", "sound 1", "b"});
  EXPECT_EQ(controller.findings().back(),
            nodes +
                "2 flights flown again elsewhere, 1 with another digest: continue the study to find out which node is "
                "wrong");
}

// In a sweep of fewer than 100 flights, one flight is repeated on another node as a check. The controller excludes the
// node that flew it first, so in every order the check takes only one further call of the engine. If only one node took
// part, this machine ("here") repeats the flight, without the engine.
TEST(SweepController, ACheckGoesToAnotherNodeAtOnce) {
  std::size_t meanwhile = 0;
  for (std::uint64_t order = 1; order <= 50; ++order) {
    SCOPED_TRACE("order " + std::to_string(order));
    Sweep sweep(order, 12, 2, {{"sound 1"}, {"sound 2"}});
    sweep.engine.asks_for_more = order % 2 == 0;
    ASSERT_TRUE(sweep.control());
    sweep.expect_all(12);
    const SweepFolder folder = sweep.world.folder();
    EXPECT_EQ(folder.checks(folder.settings().value().token).size(), 1U);
    const std::size_t elsewhere = folder.nodes().size() == 2 ? 1 : 0;  // 0: this machine flies the check
    const std::size_t rounds = sweep.engine.rounds - 1;
    EXPECT_LE(rounds, elsewhere) << sweep.said.str();
    if (sweep.engine.asks_for_more) {
      meanwhile += elsewhere - rounds;
    } else {
      EXPECT_EQ(rounds, elsewhere) << sweep.said.str();
    }
  }
  EXPECT_GT(meanwhile, 5U) << "an idle slot must fly the check while the last units fly";
}

// The node that flew a flight first must not fly its check, and all other nodes have died. The engine says so once, and
// this machine repeats the flight.
TEST(SweepController, ThisMachineFliesACheckForWhichNoOtherNodeIsLeft) {
  std::size_t gone = 0;
  for (std::uint64_t order = 1; order <= 30; ++order) {
    SCOPED_TRACE("order " + std::to_string(order));
    Sweep sweep(order, 12, 2, {{"sound 1"}, {"sound 2"}});
    sweep.engine.asks_for_more = order % 2 == 0;
    sweep.engine.others_are_gone = true;
    ASSERT_TRUE(sweep.control());
    sweep.expect_all(12);
    const SweepFolder folder = sweep.world.folder();
    EXPECT_EQ(folder.checks(folder.settings().value().token).size(), 1U);
    EXPECT_LE(sweep.engine.rounds, 2U) << "asking again takes time: " << sweep.said.str();
    gone += sweep.engine.lacks_nodes() ? 1 : 0;
  }
  EXPECT_GT(gone, 10U);
}

TEST(SweepController, TheReferenceFlightRevealsANodeWithOtherArithmetic) {
  std::vector<MadeUpNode> nodes = {{"sound"}, {"odd"}};
  nodes[1].other_arithmetic = true;
  Sweep sweep(1, 20, 2, nodes);
  ASSERT_TRUE(sweep.control());
  sweep.expect_all(20);
  EXPECT_TRUE(sweep.quarantined("odd"));
  EXPECT_FALSE(sweep.quarantined("sound"));
  EXPECT_NE(sweep.said.str().find("no result of the node odd counts: its reference flight has the digest"),
            std::string::npos)
      << sweep.said.str();
}

/// The node "odd" flies the reference flight correctly and all other flights wrongly. Only flights that other nodes
/// repeat can reveal this.
TEST(SweepController, IfOneFlightOfANodeDiffersElsewhereNoneOfItsFlightsCounts) {
  int found = 0;
  for (std::uint64_t order = 1; order <= 20; ++order) {
    SCOPED_TRACE("order " + std::to_string(order));
    std::vector<MadeUpNode> nodes = {{"sound"}, {"odd"}, {"sound too"}};
    nodes[1].odd_once_proved = true;
    Sweep sweep(order, 30, 3, nodes);
    ASSERT_TRUE(sweep.control());
    const auto all = sweep.rows();
    ASSERT_EQ(all.size(), 30U);
    EXPECT_FALSE(sweep.quarantined("sound"));
    EXPECT_FALSE(sweep.quarantined("sound too"));
    // Flight 15 is the one that the sweep checks, so its result must be right even if "odd" flew it first. Once "odd"
    // is in quarantine, no result of it may be left.
    EXPECT_EQ(all.at(15).front().figures["digest"], sweep.world.digest(15));
    if (!sweep.quarantined("odd")) continue;
    ++found;
    sweep.expect_all(30);
    for (std::size_t i = 0; i < 30; ++i) {
      const Json mark = read_json(sweep.world.flight(i).dir / kFlightMark);
      EXPECT_NE(value_or(mark, "node", ""), "odd") << i;
    }
  }
  EXPECT_GT(found, 5);
}

TEST(SweepController, ASweepWhoseNodesFlyNothingEndsAndCanBeContinued) {
  std::vector<MadeUpNode> nodes = {{"full"}};
  nodes[0].disk_fills = 1.0;
  Sweep sweep(3, 6, 2, nodes);
  ASSERT_TRUE(sweep.control());
  EXPECT_TRUE(sweep.rows().empty());
  sweep.end_well();
  sweep.expect_all(6);
}

TEST(SweepController, TheNextCommandFliesOnlyTheFailedFlightAgain) {
  Sweep sweep(4, 9, 3, {{"one"}, {"two"}});
  sweep.world.failing = {4};
  ASSERT_TRUE(sweep.control());
  sweep.expect_all(9);
  std::map<std::size_t, fs::file_time_type> before;
  for (std::size_t i = 0; i < 9; ++i) before[i] = fs::last_write_time(sweep.world.flight(i).dir / run_folder::kResult);
  sweep.world.failing.clear();
  ASSERT_TRUE(sweep.control());
  sweep.expect_all(9);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(fs::last_write_time(sweep.world.flight(i).dir / run_folder::kResult) == before[i], i != 4) << i;
  }
}

TEST(SweepController, AnotherBuildStartsTheSweepAgainAndEndsTheFormerUnits) {
  Sweep sweep(5, 8, 2, {{"one"}, {"two"}});
  ASSERT_TRUE(sweep.control());
  MadeUpWorker late(sweep.world, sweep.nodes[0], 1);
  ASSERT_TRUE(late.run_a_step()) << "the unit of the former build has begun";
  sweep.world.build = "build 2";
  ASSERT_TRUE(sweep.control());
  while (late.run_a_step()) {
  }
  sweep.expect_all(8);
}

TEST(SweepController, AFlightThatAUserRemovedIsFlownAgain) {
  Sweep sweep(6, 8, 2, {{"one"}});
  ASSERT_TRUE(sweep.control());
  fs::remove_all(sweep.world.flight(5).dir);
  ASSERT_TRUE(sweep.control());
  sweep.expect_all(8);
}

ino_t inode(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// Damages files of a finished unit in one of several ways. @returns the damaged file of the flight, which the sweep
/// must name; empty: only files of the sweep are damaged, and no flight need be repeated.
fs::path damage(const Sweep& sweep, std::size_t index, std::size_t kind) {
  const SweepFolder folder = sweep.world.folder();
  const SweepSettings settings = folder.settings().value();
  const std::string unit = folder.log_of(settings.sizes.unit_of(index)).stem().string() + ".json";
  const fs::path dir = sweep.world.flight(index).dir, result = dir / run_folder::kResult;
  const auto write = [](const fs::path& file, const std::string& text) { std::ofstream(file) << text; };
  std::string text = results::result_text(read_json(result));
  switch (kind) {
    case 0:
      return fs::remove(result) ? dir : fs::path();
    case 1:
      write(result, text.substr(0, text.size() / 2));
      return result;
    case 2:
      write(result, text.replace(text.find("build 1"), 7, "build 7"));
      return result;
    case 3:
      return fs::remove(dir / kFlightMark) ? dir : fs::path();
    case 4:
      write(folder.dir() / "done" / settings.token / unit, "{\"flights\": [{\"ind");
      return {};
    case 5:
      write(folder.dir() / "done" / settings.token / unit, "{}");
      return {};
    default:
      write(folder.dir() / "units" / unit, "{\"flights\": []}");
      return {};
  }
}

// A finished unit has recorded the results of its flights, but a study must not count results that are gone.
TEST(SweepController, FinishedUnitsAreReadAgainAndDamagedFlightsAreFlownAgain) {
  for (std::uint64_t order = 1; order <= 70; ++order) {
    SCOPED_TRACE("order " + std::to_string(order));
    RandomStream draw(order, "damage", 0);
    const auto flights = 1 + static_cast<std::size_t>(9.0 * draw.uniform());
    Sweep sweep(order, flights, 1 + static_cast<std::size_t>(4.0 * draw.uniform()), {{"one"}, {"two"}});
    ASSERT_TRUE(sweep.control());
    const auto index = std::min(static_cast<std::size_t>(draw.uniform() * static_cast<double>(flights)), flights - 1);
    const fs::path named = damage(sweep, index, order % 7);
    {
      SweepFolder folder = sweep.world.folder();
      const SweepNode node = sweep.world.node(sweep.here, [] {});
      SweepController status(folder, sweep.engine, node, sweep.said);
      status.look();
      EXPECT_EQ(status.lost().contains(index), !named.empty());
    }
    std::map<std::size_t, ino_t> before;  // a flight that is flown again has a new folder
    for (std::size_t i = 0; i < flights; ++i) before[i] = inode(sweep.world.flight(i).dir);
    ASSERT_TRUE(sweep.control());
    sweep.expect_all(flights);
    EXPECT_EQ(sweep.said.str().find("this flight again") != std::string::npos, !named.empty()) << sweep.said.str();
    EXPECT_NE(sweep.said.str().find(named.string()), std::string::npos) << sweep.said.str();
    for (std::size_t i = 0; i < flights; ++i) {
      const bool again = inode(sweep.world.flight(i).dir) != before[i];
      EXPECT_EQ(again, i == index && !named.empty()) << i;
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(SweepController, AResultWithAWrongChecksumIsNamedAndDoesNotCount) {
  Sweep sweep(7, 4, 2, {{"one"}});
  ASSERT_TRUE(sweep.control());
  const SweepFolder folder = sweep.world.folder();
  const SweepNode node = sweep.world.node(sweep.here, [] {});
  const SweepFlight flight = sweep.world.flight(2);
  const fs::path result = flight.dir / run_folder::kResult;
  EXPECT_TRUE(row_in_place(folder, flight, node));
  std::string text = results::result_text(read_json(result));
  std::ofstream(result) << text;
  EXPECT_TRUE(row_in_place(folder, flight, node));
  text.replace(text.find("build 1"), 7, "build 7");
  std::ofstream(result) << text;
  std::ostringstream said;
  EXPECT_FALSE(row_in_place(folder, flight, node, &said));
  EXPECT_NE(said.str().find(result.string() + ": is damaged"), std::string::npos) << said.str();
}

TEST(SweepController, ASweepOfAnotherVersionIsNamedAndItsFlightsStay) {
  Sweep sweep(8, 4, 2, {{"one"}});
  ASSERT_TRUE(sweep.control());
  const fs::path settings = sweep.world.folder().dir() / "sweep.json";
  std::ofstream(settings) << R"({"format": 1, "token": "t", "reference": {"index": 0, "dir": "d", "arguments": []}})";
  try {
    sweep.rows();
    ADD_FAILURE() << "the sweep was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a sweep of another version of Skein: "), std::string::npos);
  }
  const ino_t flown = inode(sweep.world.flight(2).dir);
  ASSERT_TRUE(sweep.control());
  sweep.expect_all(4);
  EXPECT_EQ(inode(sweep.world.flight(2).dir), flown) << "the flight must not be flown again";
}

TEST(Sweep, OneFlightInAHundredIsCheckedWhateverTheOrder) {
  for (const std::size_t flights : {std::size_t{100'000}, std::size_t{1700}, std::size_t{99}, std::size_t{1}}) {
    std::size_t checked = 0;
    std::vector<std::size_t> by_seed(100);
    for (std::size_t i = 0; i < flights; ++i) {
      if (!is_checked(i, flights)) continue;
      ++checked;
      ++by_seed[i % 100];
    }
    EXPECT_EQ(checked, std::max<std::size_t>(1, flights / 100));
    if (flights == 100'000) {
      EXPECT_LT(*std::ranges::max_element(by_seed), 35U) << "the place must depend on the seed";
    }
  }
}

}  // namespace
}  // namespace skein::cli
