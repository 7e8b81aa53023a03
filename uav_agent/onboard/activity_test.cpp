#include "uav_agent/onboard/activity.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "tests/support/places.hpp"

namespace skein::agent {
namespace {

using What = Doing::What;

class ActivityWords : public testing::Test {
 protected:
  ActivityWords() { facts_.what = Doing{}; }

  /// Another exchange with the same facts. @returns the activity that it reports, if any.
  std::optional<Activity> step() {
    const auto told = teller_.step(facts_);
    facts_.no_way.clear();
    facts_.tick += 20;
    if (told) last_ = *told;
    count_ += told ? 1 : 0;
    return told;
  }
  /// Several exchanges with the same facts. @returns how many of them report an activity.
  int steps(int exchanges) {
    count_ = 0;
    for (int i = 0; i < exchanges; ++i) step();
    return count_;
  }
  void doing(What what, std::optional<Vector3d> goal_W = {}) { facts_.what = Doing{what, goal_W, {}}; }

  const std::vector<FleetMember> fleet_{{.name = "jurong"}, {.name = "changi"}};
  ActivityTeller teller_{fleet_};
  ActivityFacts facts_;
  Activity last_;
  int count_ = 0;
};

TEST_F(ActivityWords, AreReportedWhenTheyChangeAndOnceASecond) {
  const auto first = step();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->mode, "on the ground");
  facts_.speed_mps = 1.0;  // a change of numbers alone is not reported at once
  EXPECT_EQ(steps(60), 3);
  doing(What::takeoff, Vector3d(0.0, 0.0, 5.0));
  const auto takeoff = step();
  ASSERT_TRUE(takeoff);
  EXPECT_EQ(takeoff->mode, "takes off");
  EXPECT_EQ(takeoff->goal_W, Vector3d(0.0, 0.0, 5.0));
  doing(What::takeoff, Vector3d(0.0, 0.4, 5.0));
  EXPECT_FALSE(step()) << "a place less than 0.5 m away counts as the same";
  doing(What::takeoff, Vector3d(0.0, 0.6, 5.0));
  EXPECT_TRUE(step());
}

TEST_F(ActivityWords, DifferForAllStatesOfAUav) {
  std::set<std::string> words;
  facts_.undelivered = 1;
  for (int what = 0; what <= static_cast<int>(What::awaits_link); ++what) {
    doing(static_cast<What>(what));
    facts_.tick += 400;
    step();
    steps(20);  // beyond the time between two goals
    EXPECT_FALSE(last_.mode.empty());
    EXPECT_TRUE(words.insert(last_.mode).second) << last_.mode;
  }
  doing(What::delivers);
  facts_.undelivered = 0;
  step();
  EXPECT_EQ(last_.mode, "stays within the station's line of sight");
  facts_.what = Doing{What::shows_mate, {}, 1};
  step();
  EXPECT_EQ(last_.mode, "shows changi its way up");
}

/// The texts in quotes in those lines of a file that contain `mark`, after it.
std::vector<std::string> quoted_after(const std::string& mark, const std::string& file, const std::string& quoted) {
  std::ifstream in(source_path(file));
  std::vector<std::string> texts;
  const std::regex pattern(quoted);
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(mark);
    if (at == std::string::npos) continue;
    for (std::sregex_iterator it(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), pattern), end; it != end;
         ++it) {
      texts.push_back((*it)[1]);
    }
  }
  return texts;
}

TEST_F(ActivityWords, AreKnownToTheLivePageAndToTheReport) {
  // The beginnings of the texts to which the page gives a colour, and the report a use of the time, of their own.
  const std::map<std::string, std::vector<std::string>> known = {
      {"live page", quoted_after("begins: [", "web/src/modes.js", "'([^']+)'")},
      {"report", quoted_after("{\"", "report/time_budget.cpp", "\\{\"([^\"]+)\", TimeUse::")}};
  std::set<std::string> words;
  for (int what = 0; what <= static_cast<int>(What::awaits_link); ++what) {
    doing(static_cast<What>(what));
    facts_.tick += 400;
    step();
    steps(20);
    words.insert(last_.mode);
  }
  for (int kind = 0; kind <= static_cast<int>(OwnMotion::Kind::command); ++kind) {
    facts_.what = OwnMotion{static_cast<OwnMotion::Kind>(kind)};
    facts_.tick += 400;
    step();
    steps(20);
    words.insert(last_.mode);
  }
  for (const auto& [reader, beginnings] : known) {
    ASSERT_GT(beginnings.size(), 10u) << reader;
    for (const std::string& mode : words) {
      const auto begins = [&](const std::string& beginning) { return mode.starts_with(beginning); };
      EXPECT_TRUE(std::ranges::any_of(beginnings, begins)) << mode << " is unknown to the " << reader;
    }
  }
}

TEST_F(ActivityWords, StayTheSameForHalfASecondBetweenTwoGoals) {
  doing(What::to_goal, Vector3d(9.0, 0.0, 5.0));
  facts_.speed_mps = 1.0;
  step();
  doing(What::no_goal);
  steps(10);
  EXPECT_EQ(last_.mode, "flies to a goal");
  EXPECT_TRUE(last_.goal_W);
  steps(2);
  EXPECT_EQ(last_.mode, "has no goal");
  EXPECT_FALSE(last_.goal_W);
}

// A strategy that waits at a place sets it as its goal again and again.
TEST_F(ActivityWords, StayTheSameWhileTheUavRestsAtAPlace) {
  doing(What::to_goal, Vector3d(9.0, 0.0, 5.0));
  facts_.p_WB = {9.0, 0.4, 5.0};
  steps(20);
  EXPECT_EQ(last_.mode, "flies to a goal");
  steps(1);
  EXPECT_EQ(last_.mode, "rests at its goal");
  count_ = 0;
  for (int i = 0; i < 400; ++i) {
    doing(i % 40 < 28 ? What::no_goal : What::along_goal);
    if (i % 40 >= 28) doing(What::along_goal, Vector3d(9.0, 0.0, 5.0));
    step();
    EXPECT_EQ(last_.mode, "rests at its goal");
  }
  EXPECT_EQ(count_, 20) << "each second";
  EXPECT_EQ(last_.goal_W, Vector3d(9.0, 0.0, 5.0));
  doing(What::no_goal);
  facts_.no_way = "no way";  // to another goal
  steps(30);
  EXPECT_EQ(last_.mode, "has no goal");
}

TEST_F(ActivityWords, TellWhyNoPathWasFoundUntilTheUavFliesAgain) {
  doing(What::no_goal);
  step();
  facts_.no_way = "not proved to be free";
  ASSERT_TRUE(step());
  steps(100);
  EXPECT_EQ(last_.no_way, "not proved to be free") << "the UAV still stands there for this reason";
  doing(What::looks_round);
  steps(100);
  EXPECT_EQ(last_.no_way, "not proved to be free");
  doing(What::to_goal, Vector3d::Zero());
  step();
  EXPECT_EQ(last_.no_way, "");
  facts_.no_way = "no way";  // another goal
  steps(20);
  EXPECT_EQ(last_.no_way, "no way") << "a reason stays for a second, so that viewers can read it";
  steps(2);
  EXPECT_EQ(last_.no_way, "");
}

TEST_F(ActivityWords, NameTheUavForWhichAUavWaits) {
  step();
  facts_.waits_for = 1;
  ASSERT_TRUE(step());
  EXPECT_EQ(last_.waits_for, "changi");
  facts_.waits_for.reset();
  EXPECT_EQ(steps(5), 0) << "a short break does not count";
  steps(10);
  EXPECT_EQ(last_.waits_for, "");
  facts_.waits_for = 7;  // a planner may name any number
  steps(20);
  EXPECT_EQ(last_.waits_for, "");
}

TEST_F(ActivityWords, TellWhatHoldsAUavThatStands) {
  doing(What::to_goal, Vector3d(9.0, 0.0, 5.0));
  facts_.speed_mps = 2.0;
  facts_.held = {.by = Held::By::unproved};
  steps(60);
  EXPECT_EQ(last_.mode, "flies to a goal") << "it still flies, perhaps more slowly";
  facts_.speed_mps = 0.1;
  steps(20);
  EXPECT_EQ(last_.mode, "flies to a goal");
  steps(1);
  EXPECT_TRUE(last_.waits_for.empty());
  EXPECT_EQ(last_.mode, "stands: what is ahead is not proved to be free");
  EXPECT_TRUE(last_.goal_W) << "it still wants to get there";
  facts_.held = {.by = Held::By::peer, .peer = 1};
  steps(1);
  EXPECT_EQ(last_.mode, "stands: another UAV is in the way");
  EXPECT_EQ(last_.waits_for, "changi");
  facts_.speed_mps = 1.0;
  steps(1);
  EXPECT_EQ(last_.mode, "flies to a goal");
  doing(What::awaits_way_up, Vector3d(9.0, 0.0, 5.0));
  facts_.speed_mps = 0.0;
  steps(60);
  EXPECT_EQ(last_.mode, "waits to be shown its way up") << "this mode says already why it stands";
}

TEST_F(ActivityWords, DescribeTheMotionOfPlannersWithoutTheFlightCore) {
  facts_.what = OwnMotion{};
  step();
  EXPECT_EQ(last_.mode, "on the ground");
  facts_.what = OwnMotion{OwnMotion::Kind::path, Vector3d(1.0, 2.0, 3.0)};
  step();
  EXPECT_EQ(last_.mode, "flies along a path");
  EXPECT_EQ(last_.goal_W, Vector3d(1.0, 2.0, 3.0));
  facts_.what = OwnMotion{OwnMotion::Kind::path, {}};
  step();
  EXPECT_EQ(last_.mode, "holds its place");
  EXPECT_FALSE(last_.goal_W);
  facts_.what = OwnMotion{OwnMotion::Kind::command, {}};
  step();
  EXPECT_EQ(last_.mode, "sends commands of its own");
}

}  // namespace
}  // namespace skein::agent
