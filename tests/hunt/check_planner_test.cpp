// `skein check-planner`: a repeatable planner passes in all surroundings. For another planner, the command names the
// surroundings in which the run differs, the first difference, the UAV whose output differs first, and usual causes.
#include <regex>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class CheckPlanner : public FleetTest {
 protected:
  struct Said {
    int code = -1;
    std::string out;
  };
  Said check(const std::string& planner, bool with_agent = true) {
    Arguments words = {"check-planner", planner, "--uavs", "1", "--duration", "12"};
    if (with_agent) words.insert(words.end(), {"--agent", helper_program("planted_agent")});
    ChildProcess& child = skein(words);
    return {child.wait().code, child.out() + child.err()};
  }

  static constexpr const char* kSurroundings[] = {"again", "heap", "clock", "load", "cyclonedds", "fastdds", "chaos"};

  /// The surroundings that the command lists with `word`: for the mission without faults, then for that with a restart.
  static std::vector<std::set<std::string>> told(const std::string& said, const std::string& word) {
    std::vector<std::set<std::string>> all;
    static const std::regex line(R"((?:^|\n)(?:a mission[^:\n]*: digest|  (same|DIFFERENT)  (\w+):))");
    for (std::sregex_iterator at(said.begin(), said.end(), line), end; at != end; ++at) {
      if (!(*at)[1].matched) {
        all.emplace_back();
      } else if ((*at)[1] == word && !all.empty()) {
        all.back().insert((*at)[2]);
      }
    }
    return all;
  }
  static std::vector<std::set<std::string>> all_but(const std::vector<std::set<std::string>>& different) {
    std::vector<std::set<std::string>> rest(different.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
      for (const char* name : kSurroundings) {
        if (!different[i].contains(name)) rest[i].insert(name);
      }
    }
    return rest;
  }

  void expect_different(const std::string& planner, const std::vector<std::set<std::string>>& different,
                        const std::vector<std::string>& words) {
    const Said said = check(planner);
    EXPECT_EQ(said.code, 1) << said.out;
    EXPECT_EQ(told(said.out, "DIFFERENT"), different) << said.out;
    EXPECT_EQ(told(said.out, "same"), all_but(different)) << said.out;
    EXPECT_NE(said.out.find("\nnot repeatable\n"), std::string::npos) << said.out;
    for (const std::string& word : words) EXPECT_NE(said.out.find(word), std::string::npos) << word << "\n" << said.out;
  }
};

TEST_F(CheckPlanner, ARepeatablePlannerPassesInAllSurroundings) {
  const Said said = check("planted");
  EXPECT_EQ(said.code, 0) << said.out;
  EXPECT_EQ(told(said.out, "same"), all_but({{}, {}})) << said.out;
  EXPECT_EQ(said.out.find("DIFFERENT"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("\nrepeatable: all runs are the same\n"), std::string::npos) << said.out;
  // Before each flight, the command prints its number and the total, and after the first also the remaining time.
  const std::size_t all = 2 * (1 + std::size(kSurroundings));
  static const std::regex flight(R"((?:^|\n)flight (\d+) of (\d+)(, about [^\n]+ left)?(?=\n))");
  std::size_t flights = 0;
  for (std::sregex_iterator at(said.out.begin(), said.out.end(), flight), end; at != end; ++at) {
    EXPECT_EQ((*at)[1], std::to_string(++flights));
    EXPECT_EQ((*at)[2], std::to_string(all));
    EXPECT_EQ((*at)[3].matched, flights > 1) << (*at)[0];
  }
  EXPECT_EQ(flights, all) << said.out;
}

TEST_F(CheckPlanner, StateThatOutlivesARestartInOneProcessIsNamed) {
  const std::set<std::string> over_dds = {"cyclonedds", "fastdds", "chaos"};
  expect_different("planted:defect=undying_counter", {{}, over_dds},
                   {"the runs first differ at step ", "jurong first differs at 4.00 s on /jurong/",
                    "usually it is something that UAVs share in one process"});
}

TEST_F(CheckPlanner, APlannerThatReadsTheCalendarIsNamed) {
  expect_different("planted:defect=reads_calendar", {{"clock"}, {"clock"}},
                   {"the runs first differ at step ", "jurong first differs at ", "usually it is the wall clock\n"});
}

TEST_F(CheckPlanner, APlannerInPythonThatDependsOnTheOrderOfASetIsNamed) {
  const std::string planner = write("sets.py",
                                    "from skein.planner import *\n"
                                    "class Sets(Planner):\n"
                                    "    def plan(self, inputs):\n"
                                    "        if inputs.k != 20: return None\n"
                                    "        first = next(iter({f'text {i}' for i in range(50)}))\n"
                                    "        up = [0, 0, 2 + 0.1 * int(first[5:])]\n"
                                    "        return PlannerOutput(Path([Waypoint(inputs.state.p_WB + up)]))\n");
  const Said said = check("py:" + planner, false);
  EXPECT_EQ(said.code, 1) << said.out;
  const auto different = told(said.out, "DIFFERENT");
  ASSERT_EQ(different.size(), 2U) << said.out;
  EXPECT_EQ(different[0], std::set<std::string>{"hash"}) << said.out;
}

TEST_F(CheckPlanner, APlannerOfAnotherAgentIsUnknownWithoutIt) {
  const Said said = check("planted", false);
  EXPECT_EQ(said.code, 2) << said.out;
  EXPECT_NE(said.out.find("planted"), std::string::npos) << said.out;
}

}  // namespace
}  // namespace skein::test
