// A hunt finds planted defects without knowing them, minimises the finds, and writes capsules that fail with the defect
// and pass without it, over DDS. The usual suite tests one defect, SKEIN_LONG=1 all of them.
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes kPatience{60};
constexpr std::size_t kMostFaults = 3;

/// A program with a defect, and the same program without it.
struct Planted {
  std::string name;
  Arguments defect, sound;      ///< options for the agent, for `skein hunt` and `skein test --faults`
  std::string planner;          ///< the planner with the defect
  std::string sound_planner;    ///< the planner without it
  Environment defect_programs;  ///< variables for the programs with the defect, if it is not in the agent
};

Planted of_planner(const std::string& defect) {
  const Arguments agent = {"--agent", helper_program("planted_agent")};
  return {defect, agent, agent, "planted:defect=" + defect, "planted", {}};
}

class Hunts : public FleetTest {
 protected:
  /// Variables for a folder with the station that acknowledges too early, and with the other programs unchanged.
  Environment hasty() const {
    const fs::path dir = folder() / "hasty";
    fs::create_directories(dir);
    for (const char* name : {"skein", "sim_server", "comm_router", "uav_agent"}) {
      fs::create_symlink(program(name), dir / name);
    }
    for (const char* name : {"station", "uav_agent_fleet"})
      fs::create_symlink(build_path("tests/hasty") + "/" + name, dir / name);
    return {{"SKEIN_BIN_DIR", dir}};
  }

  /// Runs `skein`; its output is in `said_`. @returns its exit code.
  int skein(const Arguments& words, const Environment& environment = {}) {
    const std::string name = "call-" + std::to_string(++calls_);
    Arguments argv = {program("skein")};
    argv.insert(argv.end(), words.begin(), words.end());
    ChildProcess child(argv, environment, folder() / (name + ".out"), folder() / (name + ".err"));
    EXPECT_TRUE(eventually([&] { return child.ended().has_value(); }, kPatience)) << name;
    said_ = child.out() + child.err();
    return child.ended()->code;
  }

  std::vector<fs::path> capsules(const std::string& out) const {
    std::vector<fs::path> files;
    if (!fs::exists(folder() / out / "finds")) return files;
    for (const auto& entry : fs::directory_iterator(folder() / out / "finds")) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    return files;
  }

  /// Expects a hunt to find the defect, and its capsules to fail with the defect and to pass without it.
  void expect_found(const Planted& planted, int runs, const Arguments& more) {
    const Arguments words = joined({"hunt", "towers", "--planner", planted.planner, "--runs", std::to_string(runs),
                                    "--first", "--seed", "1", "--out", folder() / planted.name},
                                   joined(planted.defect, more));
    ASSERT_EQ(skein(words, planted.defect_programs), 1) << said_;
    const std::vector<fs::path> found = capsules(planted.name);
    ASSERT_FALSE(found.empty()) << said_;
    for (const fs::path& capsule : found) {
      const std::string text = text_of(capsule);
      std::size_t faults = 0;
      for (std::size_t at = 0; (at = text.find("\n  - {", at)) != std::string::npos; ++at) ++faults;
      EXPECT_LE(faults, kMostFaults) << text;
      EXPECT_EQ(skein(joined({"test", "--faults", capsule, "--out", folder() / "with"}, planted.defect),
                      planted.defect_programs),
                1)
          << text << said_;
      const fs::path mended = folder() / (planted.name + "-mended.yaml");
      std::string without = text;
      if (const std::size_t at = without.find("planner: "); at != std::string::npos) {
        without.replace(at, without.find(',', at) - at, "planner: " + planted.sound_planner);
      }
      std::ofstream(mended) << without;
      EXPECT_EQ(skein(joined({"test", "--faults", mended, "--out", folder() / "without"}, planted.sound)), 0)
          << without << said_;
    }
  }

  std::string said_;
  int calls_ = 0;
};

/// A small fleet and short missions.
const Arguments kQuick = {"--uavs", "2", "--duration", "90", "--faults", "kill,link,blackout", "--shrink", "12"};

TEST_F(Hunts, FindARestartedProgramThatKnowsNoBoxes) { expect_found(of_planner("no_boxes_again"), 40, kQuick); }

TEST_F(Hunts, KeepTheirFindsWhichCanBeTestedAndBlamed) {
  const Planted planted = of_planner("no_boxes_again");
  const Arguments words = joined(
      {"hunt", "towers", "--planner", planted.planner, "--runs", "10", "--seed", "2", "--out", folder() / "hunt"},
      joined(planted.defect, kQuick));
  const auto finds = [&] {
    std::map<std::string, std::string> texts;
    for (const fs::path& capsule : capsules("hunt")) texts[capsule.filename()] = text_of(capsule);
    return texts;
  };
  ASSERT_EQ(skein(words), 1) << said_;
  const auto before = finds();
  ASSERT_FALSE(before.empty()) << said_;
  EXPECT_EQ(skein(words), 1) << "the continued hunt has lost its finds";
  EXPECT_NE(said_.find("10 of 10 runs are complete already"), std::string::npos) << said_;
  EXPECT_EQ(finds(), before);
  for (const auto& [name, text] : before) EXPECT_NE(said_.find(name), std::string::npos) << said_;

  const fs::path folder_of_finds = folder() / "hunt" / "finds";
  EXPECT_EQ(skein(joined({"test", "--faults", folder_of_finds, "--out", folder() / "again"}, planted.defect)), 1);
  EXPECT_NE(said_.find("0 passed, " + std::to_string(before.size()) + " failed"), std::string::npos) << said_;

  const fs::path capsule = folder_of_finds / before.begin()->first;
  EXPECT_EQ(skein(joined({"blame", capsule, "--messages", "20", "21"}, planted.defect)), 0) << said_;
  EXPECT_NE(said_.find("kill"), std::string::npos) << "blame does not name the fault: " << said_;
  EXPECT_NE(said_.find("without messages from"), std::string::npos) << said_;
}

TEST_F(Hunts, ContinueWhereTheyWereStoppedAndDoNotDependOnJobs) {
  const auto hunt = [&](const std::string& out, const std::string& runs, const std::string& jobs) {
    return skein({"hunt", "towers", "--planner", "hover", "--uavs", "2", "--duration", "50", "--faults",
                  "kill,link,blackout", "--without", "explorers_fly_on,others_fly_on,linked_delivers", "--runs", runs,
                  "--jobs", jobs, "--out", folder() / out});
  };
  const auto lines = [&](const std::string& out) {
    std::set<std::string> all;
    std::istringstream text(text_of(folder() / out / "log.jsonl"));
    for (std::string line; std::getline(text, line);) all.insert(line);
    return all;
  };
  hunt("one", "18", "1");
  hunt("two", "7", "2");
  hunt("two", "18", "2");
  EXPECT_NE(said_.find("7 of 18 runs are complete already"), std::string::npos) << said_;
  EXPECT_EQ(lines("one"), lines("two"));
  EXPECT_EQ(hunt("two", "18", "1"), hunt("one", "18", "1"));
  EXPECT_EQ(skein({"hunt", "towers", "--planner", "hover", "--out", folder() / "one"}), 2)
      << "the folder has another hunt";
}

TEST_F(Hunts, FlyUnderTheConditionsThatAreGiven) {
  const auto hunt = [&](const std::string& conditions) {
    return skein({"hunt", "towers", "--planner", "hover", "--uavs", "2", "--duration", "50", "--faults", "link",
                  "--without", "explorers_fly_on,others_fly_on,linked_delivers", "--runs", "8", "--conditions",
                  conditions, "--out", folder() / "hunt"});
  };
  ASSERT_EQ(hunt("none,wind=breezy+odometry=breezy"), 0) << said_;
  std::map<std::string, std::set<std::string>> digests;  // digests of the flights of a seed, by conditions
  std::istringstream lines(text_of(folder() / "hunt" / "log.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    const Json flown = Json::parse(line);
    const bool windy = flown["flown"].get<std::string>().find("wind=breezy") != std::string::npos;
    digests[windy ? "windy" : "none"].insert(flown["outcome"]["digest"].get<std::string>());
  }
  ASSERT_EQ(digests.size(), 2U) << "all eight cases had the same conditions, which has a probability of 1 in 128";
  for (const std::string& digest : digests["none"]) EXPECT_FALSE(digests["windy"].contains(digest));
  EXPECT_EQ(hunt("none,wind=breezy+odometry=breezy"), 0);
  EXPECT_NE(said_.find("8 of 8 runs are complete already"), std::string::npos) << said_;
  EXPECT_EQ(hunt("none"), 2) << "the folder has another hunt";
  EXPECT_EQ(hunt("none,wind=brezy"), 2);
  EXPECT_NE(said_.find("--conditions wind=brezy: there is no preset 'brezy' of conditions"), std::string::npos)
      << said_;
}

/// The defects in planted.cpp, and one in each of two programs of Skein.
class AllDefects : public Hunts, public testing::WithParamInterface<const char*> {};

TEST_P(AllDefects, AreFound) {
  if (!long_tests()) GTEST_SKIP() << "takes minutes: SKEIN_LONG=1";
  const std::string name = GetParam();
  Planted planted = of_planner(name);
  if (name == "trusting")
    planted = {name, {"--agent", helper_program("mutants/trusting_agent")}, {}, "patrol", "patrol", {}};
  if (name == "hasty") planted = {name, {}, {}, "patrol", "patrol", hasty()};
  expect_found(planted, 200, {"--shrink", "30"});
}

INSTANTIATE_TEST_SUITE_P(Planted, AllDefects,
                         testing::Values("no_boxes_again", "waits_for_dead", "endless_lease", "mutual_wait",
                                         "looks_away", "flies_blind", "undying_counter", "trusting", "hasty"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace skein::test
