// The options of a hunt, and which of them it refuses; and capsules: fault tests that record a failure.
#include "cli/hunt/plan.hpp"

#include <gtest/gtest.h>

#include "cli/hunt/capsule_run.hpp"
#include "core/faults/fault_writer.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

class HuntPlans : public testing::Test {
 protected:
  HuntOptions options() const {
    HuntOptions hunt;
    hunt.run.scenario = programs_.scenario().string();
    hunt.run.planner = "hover";
    hunt.run.duration_s = 120.0;
    hunt.dds = "cyclonedds";
    hunt.out = programs_.dir() / "hunt";
    return hunt;
  }
  void refused(const HuntOptions& hunt, const std::string& words) const {
    try {
      plan_hunt(hunt);
      ADD_FAILURE() << "the hunt was accepted, expected: " << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  const FakePrograms programs_;
};

TEST_F(HuntPlans, ACapsuleIsAFaultTestThatReadsBack) {
  const HuntPlan plan = plan_hunt(options());
  const FaultMaker maker(plan.fleet.scenario, plan.space);
  for (std::uint64_t number = 0; number < 40; ++number) {
    RandomStream draw(11, "test", number);
    Trial trial{plan.fleet.options, maker.schedule(draw)};
    trial.run.seed = number;
    if (number % 2 == 0) trial.run.uavs = 2;
    if (number % 3 == 0) trial.run.scene_seed = number;
    if (number % 5 == 0) trial.run.conditions = "breezy,wind=harsh";
    const CapsuleMark mark{plan.entries[number % plan.entries.size()].first, "12ab", "1.2.3", "cd34",
                           "skein hunt 'x: y'"};
    const std::filesystem::path file = programs_.dir() / "capsule.yaml";
    write_text(file, capsule_text("capsule", trial, mark, "it did not hold at 3 s: 'x'", plan.entries));
    const FaultTest test = load_fault_test(file);
    ASSERT_TRUE(test.capsule);
    EXPECT_EQ(test.capsule->property, mark.property);
    EXPECT_EQ(test.capsule->digest, mark.digest);
    EXPECT_EQ(test.capsule->command, mark.command);
    EXPECT_EQ(test.capsule->build, mark.build);
    EXPECT_EQ(test.plan.options.seed, trial.run.seed);
    EXPECT_EQ(test.plan.options.uavs, trial.run.uavs);
    EXPECT_EQ(test.plan.options.scene_seed, trial.run.scene_seed);
    EXPECT_EQ(test.plan.options.conditions, trial.run.conditions);
    EXPECT_EQ(test.plan.scenario.conditions.wind.on(), number % 5 == 0);
    EXPECT_EQ(test.plan.options.planner, "hover");
    ASSERT_EQ(test.property_set.size(), 1U);
    EXPECT_EQ(test.property_set[0].name, mark.property);
    EXPECT_EQ((Trial{{}, test.plan.faults.faults}.text()), trial.text());
  }
}

// Otherwise, a hunt would go on with outcomes of another planner.
TEST_F(HuntPlans, TheFilesOfPlannersAreSettings) {
  HuntOptions hunt = options();
  EXPECT_FALSE(plan_hunt(hunt).settings.contains("inputs")) << "a hunt of an earlier version has no such key";
  const std::string program = programs_.dir() / "mine.sh", parameters = programs_.dir() / "mine.yaml";
  for (const auto& [planner, file] : {std::pair("exec:sh " + program + " --fast", program),
                                      std::pair("exec:cd / && exec sh " + program + "; exit", program),
                                      std::pair("hover:" + parameters, parameters)}) {
    hunt.run.planner = planner;
    write_text(file, "one");
    const Json before = plan_hunt(hunt).settings;
    EXPECT_EQ(plan_hunt(hunt).settings, before);
    write_text(file, "another");
    EXPECT_NE(plan_hunt(hunt).settings.at("inputs"), before.at("inputs")) << planner;
  }
}

// Otherwise a search with another size of rounds could take logged cases beyond a gap for its own.
TEST_F(HuntPlans, TheSizeOfRoundsIsASettingUnlessItIsTheDefault) {
  HuntOptions hunt = options();
  EXPECT_FALSE(plan_hunt(hunt).settings.contains("round")) << "a hunt of an earlier version has no such key";
  hunt.round = 128;
  EXPECT_EQ(plan_hunt(hunt).settings.value("round", std::size_t{0}), hunt.round);
}

TEST_F(HuntPlans, UsersTextsAndParametersStayInACapsule) {
  const properties::PropertyEntries entries = {
      {"low", std::string("for u in uavs, always z(u) < 60 m")},
      {"apart", std::string("always separation > 1 m and not link(alpha, gcs)")}};
  Trial trial{options().run, {}};
  for (const auto& [name, text] : entries) {
    const std::filesystem::path file = programs_.dir() / "capsule.yaml";
    write_text(file, capsule_text("c", trial, {name, "", "1", "", ""}, "told", entries));
    const FaultTest test = load_fault_test(file);
    ASSERT_EQ(test.property_set.size(), 1U);
    EXPECT_EQ(test.property_set[0].text, std::get<std::string>(text));
  }
}

TEST_F(HuntPlans, ChecksTheReadyPropertiesExceptThoseThatAreNotForHunts) {
  HuntOptions hunt = options();
  hunt.without = {"separation"};
  std::vector<std::string> names;
  for (const auto& [name, entry] : plan_hunt(hunt).entries) names.push_back(name);
  const auto asks = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  EXPECT_TRUE(asks("custody_kept"));
  EXPECT_FALSE(asks("separation"));
  EXPECT_FALSE(asks("score_share"));
}

TEST_F(HuntPlans, RefusesOptionsThatMakeNoSense) {
  HuntOptions hunt = options();
  hunt.faults = {"kil"};
  refused(hunt, "--faults: there is no fault 'kil'; did you mean 'kill'?");
  hunt.faults = {"kill", "battery_loss"};
  refused(hunt, "--faults: no run of this hunt can have the fault 'battery_loss'; fly under conditions that have it");
  hunt.conditions = {"none", "wind=harsh"};
  refused(hunt, "'battery_loss'");
  hunt.conditions = {"none", "battery=harsh"};
  EXPECT_NO_THROW(plan_hunt(hunt));
  hunt = options();
  hunt.without = {"separatoin"};
  refused(hunt, "--without: there is no property 'separatoin' in this hunt; did you mean 'separation'?");
  hunt = options();
  hunt.run.duration_s = 42.0;
  refused(hunt, "--duration: a mission of 42 s has no time for faults");
  refused(hunt, "the shortest mission for these properties is ");
  hunt = options();
  hunt.properties = programs_.dir() / "mine.yaml";
  write_text(*hunt.properties, "properties:\n  low: always hold < 30\n");
  refused(hunt, "mine.yaml:2:15: properties.low: there is no signal 'hold'; did you mean 'held'?");
}

TEST_F(HuntPlans, RefusesPropertiesNamedLikeTheFindingsOfEveryHunt) {
  for (const char* name : {kCompletes, kSameDigest}) {
    HuntOptions hunt = options();
    hunt.properties = programs_.dir() / "properties.yaml";
    write_text(*hunt.properties, std::string("properties:\n  ") + name + ": always held < 3\n");
    refused(hunt, std::string("properties.") + name + ": every hunt has a finding of this name");
  }
}

TEST_F(HuntPlans, FaultsTurnOffPropertiesThatTheyMakeMeaningless) {
  const HuntPlan plan = plan_hunt(options());
  const properties::PropertySet set = properties::parse_properties(plan.entries, plan.fleet.scenario);
  const auto asked = [&](const std::vector<Fault>& faults, const std::string& name) {
    const properties::PropertySet rest = asked_of(faults, set);
    return std::ranges::find(rest, name, &properties::NamedProperty::name) != rest.end();
  };
  LinkEffect twice, lost;
  twice.duplication = 0.5;
  lost.loss = 0.5;
  EXPECT_TRUE(asked({{1.0, 2.0, lost}}, "delivered_once"));
  EXPECT_FALSE(asked({{1.0, 2.0, lost}, {1.0, 2.0, twice}}, "delivered_once"));
  EXPECT_FALSE(asked({{1.0, 2.0, OdometryFreeze{"alpha"}}}, "separation"));
  EXPECT_TRUE(asked({{1.0, 2.0, OdometryFreeze{"alpha"}}}, "custody_kept"));
}

// A capsule never reports that it reproduced the run if the run has another digest.
TEST(CapsuleRuns, ReproduceTheRunOnlyIfTheDigestIsTheOneOfTheFind) {
  const CapsuleMark mark{"separation", "12ab", "0.0.9", "commit 77", "skein hunt"};
  EXPECT_EQ(comparison_text(mark, "12ab"),
            "this is the run that was found, bit for bit (found with skein 0.0.9, build commit 77)");
  for (const std::string digest : {"12ac", ""}) {
    const std::string text = comparison_text(mark, digest);
    EXPECT_EQ(text.find("bit for bit"), std::string::npos) << text;
    EXPECT_NE(text.find("found with skein 0.0.9, build commit 77; this build"), std::string::npos) << text;
    EXPECT_NE(text.find("flies it differently"), std::string::npos) << text;
    EXPECT_NE(text.find("that one had 12ab"), std::string::npos) << text;
  }
  CapsuleMark unknown = mark;
  unknown.digest.clear();
  for (const std::string digest : {"12ab", ""}) {
    const std::string text = comparison_text(unknown, digest);
    EXPECT_EQ(text.find("bit for bit"), std::string::npos) << text;
    EXPECT_NE(text.find("not known"), std::string::npos) << text;
  }
  unknown.property = kCompletes;
  EXPECT_NE(comparison_text(unknown, "").find("this run has no digest"), std::string::npos);
}

}  // namespace
}  // namespace skein::cli
