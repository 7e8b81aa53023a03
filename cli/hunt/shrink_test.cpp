// Shrinking removes the faults that do not matter from a find and keeps the others, however many flights fly at once.
#include "cli/hunt/shrink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "cli/hunt/fault_maker.hpp"
#include "core/faults/fault_check.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/scenario/conditions.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

constexpr double kAfter_s = 30.0;
constexpr std::size_t kMostFlights = 45;

class Shrinking : public testing::Test {
 protected:
  Shrinking() {
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    LoadOptions load;
    load.duration_s = 120.0;
    towers_ = load_scenario("towers", load);
  }

  /// The defect: a trial fails if raffles is killed while the station is dead.
  static bool breaks(const Trial& trial) {
    for (const Fault& kill : trial.faults) {
      const auto* killed = std::get_if<Kill>(&kill.action);
      if (killed == nullptr || killed->member != "raffles" || kill.waits) continue;
      for (const Fault& outage : trial.faults) {
        if (!std::holds_alternative<StationOutage>(outage.action) || outage.waits) continue;
        if (kill.at_s >= outage.at_s && kill.at_s < *outage.until_s) return true;
      }
    }
    return false;
  }
  static TrialOutcome outcome_of(const Trial& trial) {
    TrialOutcome outcome;
    TrialFinding& finding = outcome.findings.emplace_back();
    finding.property = "whole";
    finding.outcome = breaks(trial) ? properties::Verdict::Outcome::fails : properties::Verdict::Outcome::holds;
    for (const Fault& fault : trial.faults) outcome.began_s.push_back(fault.at_s);
    return outcome;
  }
  Shrunk shrunk(const Trial& trial, std::size_t at_once, std::size_t most = 120) {
    return shrink(trial, outcome_of(trial), "whole", towers_, {kAfter_s, at_once, most},
                  [](const std::vector<Trial>& trials) {
                    std::vector<TrialOutcome> outcomes;
                    for (const Trial& one : trials) outcomes.push_back(outcome_of(one));
                    return outcomes;
                  });
  }
  /// A trial with the two faults that cause the defect, and with random faults that do not matter.
  Trial drawn(std::uint64_t number) const {
    const FaultMaker maker(towers_, {fault_kinds(), 77.0, false});
    RandomStream draw(5, "test", number);
    Trial trial{{}, {}};
    trial.run.duration_s = 120.0;
    trial.run.seed = number;
    trial.run.planner = "planted:defect=this";
    trial.faults = {{20.0 + static_cast<double>(number % 7), 39.3, StationOutage{}}, {31.7, 47.2, Kill{"raffles"}}};
    for (Fault& fault : maker.schedule(draw)) trial.faults.push_back(std::move(fault));
    trial.faults = without_contradictions(std::move(trial.faults));
    return trial;
  }

  Scenario towers_;
};

TEST_F(Shrinking, LeavesOnlyTheFaultsThatMatter) {
  for (std::uint64_t number = 0; number < 30; ++number) {
    const Trial trial = drawn(number);
    ASSERT_TRUE(breaks(trial));
    const Shrunk small = shrunk(trial, 1);
    EXPECT_TRUE(breaks(small.trial)) << small.trial.text();
    EXPECT_EQ(small.trial.faults.size(), 2U) << small.trial.text();
    EXPECT_EQ(small.trial.run.seed, 0U);
    EXPECT_EQ(small.trial.run.planner, "planted");
    EXPECT_LT(small.flights, kMostFlights) << "shrinking takes too many flights";
    EXPECT_EQ(small.trial.run.uavs, 2U);
    EXPECT_LT(*small.trial.run.duration_s, 120.0);
    for (const Fault& fault : small.trial.faults) {
      EXPECT_GE(*small.trial.run.duration_s, *fault.until_s + kAfter_s) << fault_line(fault);
    }
    for (const Fault& fault : small.trial.faults) EXPECT_EQ(fault.at_s, std::round(fault.at_s)) << fault_line(fault);
  }
}

TEST_F(Shrinking, LeavesTheConditionsThatItNeeds) {
  const auto outcome = [](const Trial& trial) {
    TrialOutcome judged;
    TrialFinding& finding = judged.findings.emplace_back();
    finding.property = "whole";
    const bool windy = trial.run.conditions && chosen_conditions(*trial.run.conditions, {}).wind.on();
    finding.outcome = windy ? properties::Verdict::Outcome::fails : properties::Verdict::Outcome::holds;
    return judged;
  };
  for (const char* preset : {"breezy", "harsh"}) {
    Trial trial{{}, {{20.0, 30.0, Kill{"raffles"}}}};
    trial.run.duration_s = 120.0;
    trial.run.conditions = preset;
    const Shrunk small = shrink(trial, outcome(trial), "whole", towers_, {kAfter_s, 1, 120}, [&](const auto& trials) {
      std::vector<TrialOutcome> outcomes;
      for (const Trial& one : trials) outcomes.push_back(outcome(one));
      return outcomes;
    });
    EXPECT_EQ(small.trial.run.conditions, std::string("none,wind=") + preset);
    EXPECT_TRUE(small.trial.faults.empty());
  }
}

// No preset has the scenario's own values, so a text of presets cannot replace the chosen ones.
TEST_F(Shrinking, ProposesOnlyConditionsThatCanBeChosen) {
  Scenario own = towers_;
  own.conditions.wind.mean_mps = 4.0;
  Trial trial;
  trial.run.duration_s = 120.0;
  trial.run.conditions = "battery=breezy";
  int without_wind = 0;
  for (const Proposal& proposal : simpler(trial, outcome_of(trial), "whole", own, kAfter_s)) {
    if (!proposal.what.starts_with("conditions but")) continue;
    const ConditionsConfig chosen = chosen_conditions(*proposal.trial.run.conditions, own.conditions);
    without_wind += chosen.wind.on() ? 0 : 1;
    EXPECT_NE(chosen.wind.on(), proposal.what == "conditions but wind") << *proposal.trial.run.conditions;
    EXPECT_NE(chosen.battery.on(), proposal.what == "conditions but battery") << *proposal.trial.run.conditions;
  }
  EXPECT_EQ(without_wind, 1);
}

TEST_F(Shrinking, KeepsTheFileOrCommandThatAPlannerIs) {
  for (const std::string planner : {"exec:./mine", "waypoints:path.csv", "py:mine.py", "kios:voxel_m=2"}) {
    Trial trial;
    trial.run.duration_s = 120.0;
    trial.run.planner = planner;
    const auto proposals = simpler(trial, outcome_of(trial), "whole", towers_, kAfter_s);
    const bool any = std::ranges::any_of(proposals, [](const Proposal& one) { return one.what == "parameters"; });
    EXPECT_EQ(any, planner.starts_with("kios")) << planner;
  }
}

TEST_F(Shrinking, DoesNotDependOnHowManyFlightsFlyAtOnce) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    const std::size_t most = number % 2 == 0 ? 120 : number;
    const Shrunk one = shrunk(drawn(number), 1, most), four = shrunk(drawn(number), 4, most);
    EXPECT_LE(one.flights, most);
    EXPECT_EQ(one.trial.text(), four.trial.text());
    EXPECT_EQ(one.flights, four.flights);
  }
}

TEST_F(Shrinking, NeverProposesAnInvalidFaultFile) {
  const ScratchDir scratch;
  for (std::uint64_t number = 0; number < 30; ++number) {
    const Trial trial = drawn(number);
    const auto after_s = number % 2 == 0 ? std::optional(kAfter_s) : std::nullopt;
    for (const auto& [what, proposal] : simpler(trial, outcome_of(trial), "whole", towers_, after_s)) {
      Scenario scenario = towers_;
      scenario.duration_s = *proposal.run.duration_s;
      if (proposal.run.uavs) scenario.fleet.resize(*proposal.run.uavs);
      write_text(scratch.path() / "faults.yaml", proposal.text());
      EXPECT_NO_THROW(load_fault_plan(scratch.path() / "faults.yaml", scenario)) << proposal.text();
    }
  }
}

TEST_F(Shrinking, NeverProposesAFaultThatCannotAct) {
  towers_.exchange_period_s = 0.75;
  for (std::uint64_t number = 0; number < 30; ++number) {
    const Trial trial = drawn(number);
    for (const auto& [what, proposal] : simpler(trial, outcome_of(trial), "whole", towers_, std::nullopt)) {
      for (const Fault& fault : proposal.faults) EXPECT_TRUE(has_exchange(fault, towers_)) << fault_line(fault);
    }
  }
}

}  // namespace
}  // namespace skein::cli
