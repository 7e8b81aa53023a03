#include "cli/hunt/flights.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

// A scenario that could be read when the hunt began may be gone, or be another one, when a case flies.
TEST(FlightsOfTrials, AScenarioThatCannotBeReadAnyMoreHasNoFindings) {
  FakePrograms programs;
  const ScratchDir folder;
  std::ostringstream said;
  const Console console{said, said};
  HuntPlan plan;
  plan.options.jobs = 1;
  plan.out = folder.path();
  for (const int code : {0, 2}) {
    programs.script("skein", "exit " + std::to_string(code));
    Trial trial;
    trial.run.scenario = folder.path() / "gone.yaml";
    TrialFlights flights(plan, console);
    std::vector<std::size_t> flown;
    flights.fly(
        {0, 1}, [&](std::size_t) { return trial; },
        [&](std::size_t index, const TrialOutcome& outcome) {
          flown.push_back(index);
          EXPECT_TRUE(outcome.findings.empty()) << "exit code " << code;
        });
    EXPECT_EQ(flown, (std::vector<std::size_t>{0, 1}));
  }
}

}  // namespace
}  // namespace skein::cli
