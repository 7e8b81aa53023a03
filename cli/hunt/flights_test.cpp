#include "cli/hunt/flights.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

// A user may delete or change the scenario after the hunt has read it and before a case flies.
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

// No file in config/scenarios has the name of a generated world: sim_server draws it into the cache.
TEST(FlightsOfTrials, ACaseInAGeneratedWorldIsJudged) {
  FakePrograms programs;
  const std::string cache_before = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
  ::setenv("XDG_CACHE_HOME", (programs.dir() / "cache").c_str(), 1);
  write_script(programs.dir() / "sim_server", kDrawWorld);
  programs.script("skein", "exit 3");
  const ScratchDir folder;
  std::ostringstream said;
  HuntPlan plan;
  plan.options.jobs = 1;
  plan.out = folder.path();
  TrialFlights flights(plan, {said, said});
  Trial trial;
  trial.run.scenario = "wild";
  trial.run.scene_seed = 3;
  const TrialOutcome outcome = flights.fly({trial}).front();
  EXPECT_NE(outcome.find(kCompletes), nullptr) << said.str();
  cache_before.empty() ? ::unsetenv("XDG_CACHE_HOME") : ::setenv("XDG_CACHE_HOME", cache_before.c_str(), 1);
}

}  // namespace
}  // namespace skein::cli
