// A search draws each case from the seed and from results that are old enough; newer results have no influence. It
// varies cases that reached new states or came close to a failure.
#include "cli/hunt/search.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

using Outcomes = std::vector<std::optional<TrialOutcome>>;

class Searches : public testing::Test {
 protected:
  Searches() {
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    towers_ = load_scenario("towers", {});
  }
  HuntSearch search(std::uint64_t seed) const { return HuntSearch(FaultMaker(towers_, {}), seed); }

  /// A made-up outcome of a flight: a state for each kind of fault, and less margin the more faults the case has.
  static TrialOutcome outcome_of(const HuntCase& flown) {
    TrialOutcome outcome;
    for (const Fault& fault : flown.faults) outcome.states.push_back(std::hash<std::string>()(fault_kind(fault)));
    TrialFinding finding;
    finding.property = "few";
    finding.outcome = properties::Verdict::Outcome::holds;
    finding.margin = 10.0 - static_cast<double>(flown.faults.size());
    outcome.findings.push_back(finding);
    return outcome;
  }
  static std::string text_of(const HuntCase& one) {
    return std::to_string(one.seed) + "\n" + Trial{{}, one.faults}.text();
  }

  Scenario towers_;
};

TEST_F(Searches, ACaseDependsOnlyOnTheSeedAndOnResultsThatAreOldEnough) {
  constexpr std::size_t kCases = 120;
  HuntSearch one = search(3), other = search(3), third = search(4);
  Outcomes known_at_once, known_late;
  std::size_t different = 0;
  for (std::size_t i = 0; i < kCases; ++i) {
    const std::string text = text_of(one.next(known_at_once));
    known_at_once.push_back(outcome_of(one.cases()[i]));
    // The other search learns each result as late as possible.
    known_late = known_at_once;
    known_late.resize(i < HuntSearch::kLag ? 0 : i - HuntSearch::kLag + 1);
    ASSERT_TRUE(other.may_go_on(known_late)) << i;
    EXPECT_EQ(text_of(other.next(known_late)), text) << i;
    if (text_of(third.next(known_at_once)) != text) ++different;
  }
  EXPECT_GT(different, kCases / 2);
}

TEST_F(Searches, CasesFlyUnderAllOfTheConditions) {
  const std::vector<std::string> conditions = {"none", "breezy", "wind=harsh+battery=breezy"};
  HuntSearch some(FaultMaker(towers_, {}), 3, HuntSearch::kLag, conditions), none = search(3);
  Outcomes known;
  std::map<std::string, int> flown;
  for (std::size_t i = 0; i < 120; ++i) {
    const HuntCase& one = some.next(known);
    if (i == 0) {
      EXPECT_EQ(one.conditions, "none");
    }
    ++flown[one.conditions];
    EXPECT_EQ(none.next(known).conditions, "") << "the conditions of the scenario";
    known.push_back(outcome_of(one));
  }
  ASSERT_EQ(flown.size(), conditions.size());
  for (const std::string& one : conditions) EXPECT_GT(flown[one], 10) << one;
}

TEST_F(Searches, ASearchWaitsForTheResultsOnWhichACaseDepends) {
  HuntSearch one = search(1);
  Outcomes outcomes;
  for (std::size_t i = 0; i < HuntSearch::kLag; ++i) one.next(outcomes);
  EXPECT_FALSE(one.may_go_on(outcomes));
  outcomes.resize(HuntSearch::kLag);
  outcomes[1] = TrialOutcome{};
  EXPECT_FALSE(one.may_go_on(outcomes));
  outcomes[0] = TrialOutcome{};
  EXPECT_TRUE(one.may_go_on(outcomes));
}

TEST_F(Searches, TheFirstCaseHasNoFaultsAndLaterCasesHaveLessMargin) {
  // The number of faults in the last hundred cases. With sign 1 or -1, more faults give less or more margin.
  const auto faults_late = [&](double sign) {
    HuntSearch one = search(1);
    Outcomes outcomes;
    std::size_t late = 0;
    for (std::size_t i = 0; i < 300; ++i) {
      const HuntCase& next = one.next(outcomes);
      EXPECT_EQ(next.faults.empty(), i == 0);
      if (i >= 200) late += next.faults.size();
      outcomes.push_back(outcome_of(next));
      *outcomes.back()->findings[0].margin *= sign;
    }
    return late;
  };
  EXPECT_GT(faults_late(1.0), faults_late(-1.0) + 50);
}

}  // namespace
}  // namespace skein::cli
