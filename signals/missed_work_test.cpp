// The signal `missed`: the work that is left undone since a UAV came back, in a hand-made run.
#include <cmath>
#include <cstdlib>

#include "signals/judge.hpp"
#include "signals/run_signals_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::signals {
namespace {

using Outcome = properties::Verdict::Outcome;

// `a` comes back at 10 s, and the last fault is over at 12 s.
class MissedWork : public RunSignalsTest {
 protected:
  MissedWork() {
    run_.result["sim_time_s"] = 80.0;
    undisturbed_ = run_;
    undisturbed_.captures = {capture("a", 0, 5.0, {}, 1), capture("a", 1, 15.0, {}, 2), capture("a", 2, 16.0, {}, 3),
                             capture("a", 3, 17.0, {}, 3), capture("b", 0, 5.0, {}, 4)};
    run_.events = {{0, "joined", "a", ""}, {0, "joined", "b", ""}, {100, "left", "a", ""}, {200, "joined", "a", ""}};
    run_.result["faults"] = Json::array({{{"began_step", 100}, {"ended_step", 200}}, fault(120, 240)});
  }
  static Json fault(int began_step, const Json& ended_step) {
    return {{"kind", "link"}, {"began_step", began_step}, {"ended_step", ended_step}};
  }
  /// The value of the signal at a time.
  double missed_at(double time_s, const std::string& uav = "a") {
    return number("missed(" + uav + ")", &undisturbed_).at(static_cast<std::size_t>(std::llround(time_s / 0.05)));
  }

  /// The outcome of a ready property.
  Outcome outcome(const std::string& property) {
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    FolderSignals signals(run_, scenario_, &undisturbed_);
    const properties::PropertyEntries entries = {{property, properties::PropertyEntry("ready")}};
    return judge_properties(properties::parse_properties(entries, scenario_), signals).at(0).verdict.outcome;
  }
  void fly(double speed_mps) {
    run_.poses.clear();
    for (int tenth = 0; tenth <= 800; ++tenth) {
      const double t = 0.1 * tenth;
      run_.poses.push_back({t, "a", {speed_mps * t, 0, 1}, {speed_mps, 0, 0}, true, 5.0});
    }
  }

  results::RunRecord undisturbed_;
};

TEST_F(MissedWork, CountsThePointsOfTheUndisturbedFlightUpToTheSameTimeMinusTheWayBack) {
  EXPECT_EQ(missed_at(12.0), 0.0);
  EXPECT_EQ(missed_at(12.0 + 40.0 + 4.9), 0.0);
  EXPECT_EQ(missed_at(12.0 + 40.0 + 5.0), 1.0);
  EXPECT_EQ(missed_at(12.0 + 40.0 + 15.0), 2.0);
  EXPECT_EQ(missed_at(12.0 + 40.0 + 16.0), 3.0);
  EXPECT_EQ(missed_at(80.0), 3.0) << "each point counts once";
  EXPECT_EQ(missed_at(80.0, "b"), 0.0) << "its program was never away";
  EXPECT_THROW(number("missed(a)"), InputError);
}

TEST_F(MissedWork, LeavesOutPointsThatAnyUavPhotographs) {
  run_.captures = {capture("a", 0, 3.0, {}, 1), capture("b", 0, 59.0, {}, 2)};
  EXPECT_EQ(missed_at(80.0), 1.0);
}

TEST_F(MissedWork, EndsWithTheFirstPhotograph) {
  run_.events.push_back({200 + 10, "captured", "a", "0"});
  EXPECT_EQ(missed_at(80.0), 3.0) << "this photograph was before the end of the last fault";
  run_.events.push_back({20 * 60, "captured", "a", "1"});
  EXPECT_EQ(missed_at(59.0), 1.0);
  EXPECT_EQ(missed_at(60.0), 0.0);
  EXPECT_EQ(missed_at(80.0), 0.0);
}

TEST_F(MissedWork, BeginsAnewWhenTheProgramIsAwayAgain) {
  run_.result["sim_time_s"] = 160.0;
  run_.events.push_back({20 * 30, "captured", "a", "1"});
  run_.events.push_back({20 * 90, "left", "a", ""});
  run_.events.push_back({20 * 91, "joined", "a", ""});
  EXPECT_EQ(missed_at(89.0), 0.0) << "the UAV photographs again";
  EXPECT_EQ(missed_at(91.0 + 40.0 + 4.9), 0.0);
  EXPECT_EQ(missed_at(91.0 + 40.0 + 17.0), 3.0);
}

TEST_F(MissedWork, IsZeroForAnAbsentUavAndWhileAFaultLasts) {
  run_.result["faults"].push_back(fault(300, nullptr));
  EXPECT_EQ(missed_at(80.0), 0.0);
  run_.result["faults"].erase(2);
  run_.events.push_back({20 * 60, "left", "a", ""});
  EXPECT_EQ(missed_at(59.0), 1.0);
  EXPECT_EQ(missed_at(80.0), 0.0);
  run_.result["faults"].erase(1);
  run_.events.back() = {20 * 30, "left", "a", ""};
  run_.events.push_back({20 * 31, "joined", "a", ""});
  EXPECT_EQ(missed_at(31.0 + 40.0 + 4.9), 0.0) << "since it came back again";
  EXPECT_EQ(missed_at(31.0 + 40.0 + 5.0), 1.0);
}

TEST_F(MissedWork, IgnoresCapturesThatDoNotCount) {
  scenario_.rules.min_point_score = 0.2;
  undisturbed_.captures[0].q = 0.1;
  undisturbed_.captures[1].reason = run_tables::kUavCollided;
  EXPECT_EQ(missed_at(80.0), 1.0);
}

TEST_F(MissedWork, DecidesWhetherAUavPhotographsAgain) {
  fly(2.0);
  for (int point = 10; point < 21; ++point) undisturbed_.captures.push_back(capture("a", 9, 18.0, {}, point));
  EXPECT_EQ(outcome("photographs_again"), Outcome::holds) << "14 points are not enough";
  undisturbed_.captures.push_back(capture("a", 9, 18.0, {}, 21));
  EXPECT_EQ(outcome("photographs_again"), Outcome::fails);
  run_.events.push_back({20 * 69, "captured", "a", "0"});
  EXPECT_EQ(outcome("photographs_again"), Outcome::holds) << "it photographs again just in time";
  run_.events.back().step = 20 * 71;
  EXPECT_EQ(outcome("photographs_again"), Outcome::fails) << "too late";
  fly(0.0);
  EXPECT_EQ(outcome("photographs_again"), Outcome::holds) << "the UAV stands and waits, which other properties judge";
  run_.events.resize(2);  // no program was ever away
  EXPECT_EQ(outcome("photographs_again"), Outcome::vacuous);
}

// The property `works_again` demands a photograph before a deadline.
TEST_F(MissedWork, WorksAgainSaysNothingWhereNoUavWasAway) {
  fly(2.0);
  EXPECT_EQ(outcome("works_again"), Outcome::fails);
  run_.events.push_back({20 * 50, "captured", "a", "0"});
  EXPECT_EQ(outcome("works_again"), Outcome::holds);
  std::erase_if(run_.events, [](const results::EventRow& row) { return row.step == 200; });
  EXPECT_EQ(outcome("works_again"), Outcome::vacuous) << "the UAV did not come back";
  std::erase_if(run_.events, [](const results::EventRow& row) { return row.step == 100; });
  EXPECT_EQ(outcome("works_again"), Outcome::vacuous) << "no UAV was away";
}

}  // namespace
}  // namespace skein::signals
