// The options of a finished run, as `skein rerun`, `fork` and `blame` take them from its result.
#include "cli/rerun_command.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

class OptionsOfRun : public testing::Test {
 protected:
  OptionsOfRun() { std::filesystem::create_directories(run_); }

  /// The options of a run of small.yaml with seed 3 whose result has this command.
  RunOptions options(const std::string& command) const {
    Json result = {
        {"command", command}, {"scenario", programs_.scenario().string()}, {"status", "completed"}, {"seed", 3}};
    for (const char* uav : {"alpha", "beta"}) result["uavs"].push_back({{"name", uav}});
    write_text(run_ / run_folder::kResult, result.dump());
    return options_of_run(run_);
  }
  std::string refusal(const std::string& command) const {
    try {
      options(command);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const FakePrograms programs_;
  const std::filesystem::path run_ = programs_.dir() / "run";
  const std::string small_ = programs_.scenario();
};

TEST_F(OptionsOfRun, AreThoseOfTheRunsCommand) {
  const RunOptions run = options("skein run " + small_ + " --planner hover --seed 3 --out " + run_.string());
  EXPECT_EQ(run.scenario, small_);
  EXPECT_EQ(run.planner, "hover");
  EXPECT_EQ(run.seed, 3U);
  EXPECT_FALSE(run.out);
}

// Otherwise, the repeated flight would log in on these hosts, although it flies on this one.
TEST_F(OptionsOfRun, DoNotNameTheHostsOfThatRun) {
  const RunOptions run = options("skein run " + small_ +
                                 " --seed 3 --place alpha=host1 --ssh 'ssh -p 2222' --skein-path /opt/skein "
                                 "--network lo --secure");
  EXPECT_FALSE(run.place.at);
  EXPECT_FALSE(run.place.skein);
  EXPECT_EQ(run.place.ssh, PlaceOptions().ssh);
  EXPECT_FALSE(run.network);
  EXPECT_FALSE(run.secure);
}

TEST_F(OptionsOfRun, AreRefusedIfTheyRunAStationProgramThatTheFleetDoesNotHave) {
  RunOptions run = options("skein run " + small_ + " --planner hover --seed 3");
  run.replay = ReplayOf{"recording.mcap", {}, {"gcs"}, {}};
  try {
    plan_fleet(run, programs_.dir());
    ADD_FAILURE() << "the command was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "gcs: this fleet has no program at the ground station");
  }
  run.planner = "hover,gcs=listen";
  EXPECT_NO_THROW(plan_fleet(run, programs_.dir()));
}

TEST_F(OptionsOfRun, AreRefusedIfTheCommandFliesAnotherScenarioFleetOrSeed) {
  const std::string begin = run_.string() + ": the command of this run now flies a different run: ";
  EXPECT_EQ(refusal("skein run " + small_ + " --seed 4").find(begin + "seed 3, now 4. "), 0U);
  EXPECT_EQ(refusal("skein run " + small_ + " --seed 3 --uavs 1").find(begin + "UAVs alpha, beta, now "), 0U);
  EXPECT_EQ(
      refusal("skein run towers --seed 3").find(begin + "scenario small, now towers; UAVs alpha, beta, now jurong"),
      0U);
  const std::filesystem::path copy = programs_.dir() / "copy.yaml";
  write_text(copy, kSmallScenario);
  EXPECT_EQ(refusal("skein run " + copy.string() + " --seed 3").find(begin + "scenario small, now copy. "), 0U);
}

TEST_F(OptionsOfRun, AreRefusedWithThePlaceToStartFromIfAFileOfTheCommandIsMissing) {
  const std::string faults = " --faults faults.yaml", begin = run_.string() + ": its command cannot be repeated: ";
  for (const std::string& command :
       std::vector<std::string>{"skein run small.yaml --seed 3", "skein run " + small_ + " --seed 3" + faults,
                                "skein run find.yaml --seed 3"}) {
    const std::string said = refusal(command);
    EXPECT_EQ(said.find(begin), 0U) << said;
    EXPECT_NE(said.find(". Start from the folder in which that run was started, "), std::string::npos) << said;
    EXPECT_TRUE(said.ends_with(": " + command)) << said;
  }
  const std::string other = refusal("skein run " + small_ + " --seed 4" + faults);
  EXPECT_NE(other.find("seed 3, now 4. "), std::string::npos) << "another run, whatever its faults: " << other;
}

TEST_F(OptionsOfRun, OfACapsuleAreThoseOfItsFile) {
  const std::filesystem::path capsule = programs_.dir() / "find.yaml";
  write_text(capsule,
             "run: {scenario: ./small.yaml, planner: hover, duration_s: 60, seed: 3}\n"
             "faults: [{at_s: 10, blackout: alpha}]\n"
             "properties: {separation: ready}\ncapsule: {property: separation, skein: '1'}\n");
  const RunOptions run = options("skein run " + capsule.string() + " --dds fastdds --force");
  EXPECT_EQ(std::filesystem::path(run.scenario).lexically_normal(), small_);
  EXPECT_EQ(run.faults, std::filesystem::absolute(capsule));
  EXPECT_EQ(run.planner, "hover");
  EXPECT_EQ(run.seed, 3U);
  EXPECT_EQ(run.dds, "fastdds");
  EXPECT_FALSE(run.force);
}

}  // namespace
}  // namespace skein::cli
