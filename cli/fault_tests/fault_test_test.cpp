// Fault tests: reading of their files, error messages, and the judgement of runs with the report of failures. The runs
// are made up.
#include "cli/fault_tests/fault_test.hpp"

#include <gtest/gtest.h>

#include <set>

#include "cli/fault_tests/conversion.hpp"
#include "cli/fault_tests/flights.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

constexpr const char* kBlackout =
    "run: {scenario: ./small.yaml, duration_s: 60}\nfaults: [{at_s: 10, blackout: alpha}]\n";

class FaultTestFile : public testing::Test {
 protected:
  FaultTest load(const std::string& text) {
    write_text(programs_.dir() / "mine.yaml", text);
    return load_fault_test(programs_.dir() / "mine.yaml");
  }
  void refused(const std::string& text, const std::string& words) {
    try {
      load(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  FakePrograms programs_;
};

TEST_F(FaultTestFile, NamesTheRunsAndTheirFaults) {
  const FaultTest test = load(
      "name: mine\ndescription: mine too\n"
      "run: {scenario: ./small.yaml, planner: hover, seed: 7, duration_s: 33, dds: mixed}\n"
      "faults: [{at_s: 10, blackout: alpha}]\n"
      "expect: {same_digest: [again, chaos]}\n");
  EXPECT_EQ(test.name, "mine");
  const RunOptions& options = test.plan.options;
  EXPECT_EQ(std::filesystem::path(options.scenario).filename(), "small.yaml");
  EXPECT_EQ(options.planner, "hover");
  EXPECT_EQ(options.seed, 7u);
  EXPECT_EQ(options.duration_s, 33.0);
  EXPECT_EQ(options.dds, "mixed");
  EXPECT_EQ(options.faults, programs_.dir() / "mine.yaml");
  ASSERT_EQ(test.plan.faults.faults.size(), 1u);
  EXPECT_EQ(test.expect.same_digest, (std::vector<Repeat>{Repeat::again, Repeat::chaos}));
  EXPECT_FALSE(test.needs_fault_free());
  EXPECT_TRUE(load(kBlackout + std::string("properties: {score_share: ready}")).needs_fault_free());
}

// Over DDS, at most 128 UAVs can fly.
TEST_F(FaultTestFile, AFleetThatIsTooLargeForDdsFliesInOneProcess) {
  const std::string faults = "faults: [{at_s: 10, blackout: u1}]\n", capsule = "capsule: {property: completes}\n";
  const auto run = [](const std::string& more) {
    return "run: {scenario: ./small.yaml, planner: hover, duration_s: 20" + more + "}\n";
  };
  write_text(programs_.scenario(), scenario_of(129));
  programs_.script(std::string(programs::kAgent) + programs::kFleetSuffix, "");
  for (const std::string& text : {faults, faults + capsule}) {
    const FaultTest test = load(run("") + text);
    EXPECT_TRUE(test.plan.options.one_process);
    EXPECT_EQ(test.plan.scenario.fleet.size(), 129U);
  }
  EXPECT_FALSE(load(run(", uavs: 128") + faults).plan.options.one_process);
  refused(run(", dds: fastdds") + faults,
          "mine.yaml:1: run.dds: asks for a flight over DDS, which carries at most 128");
  refused(run("") + faults + "expect: {same_digest: [again, mixed]}",
          "mine.yaml:3: expect.same_digest[1]: 'mixed' asks for a flight over DDS, which carries at most 128");
  refused(run("") + faults + "capsule: {property: same_digest}",
          "mine.yaml:3:11: capsule.property: 'same_digest' compares");
  refused("run: {scenario: ./small.yaml, planner: 'hover,u1=exec:./mine', duration_s: 20}\n" + faults,
          "a fleet of 129 UAVs must fly in one process, because over DDS at most 128 can; but --planner u1=exec:");
}

// The command line asks for more repetitions than `expect.same_digest`.
TEST_F(FaultTestFile, AFleetThatIsTooLargeForDdsIsNotRepeatedOverDds) {
  write_text(programs_.scenario(), scenario_of(129));
  programs_.script(std::string(programs::kAgent) + programs::kFleetSuffix, "");
  const std::vector<FaultTest> tests = {
      load("run: {scenario: ./small.yaml, planner: hover, duration_s: 20}\nfaults: [{at_s: 1, blackout: u1}]")};
  TestOptions options;
  options.repeat = {"again"};
  EXPECT_EQ(plan_fault_flights(tests, options).tests[0].repeats.size(), 1U);
  options.long_tests = true;
  EXPECT_EQ(plan_fault_flights(tests, options).tests[0].repeats.size(), 3U) << "again, chaos, one_process";
  options.repeat = {"again", "fastdds"};
  EXPECT_THROW(plan_fault_flights(tests, options), InputError);
}

// A capsule of a hunt in a generated world names the world, for which there is no file.
TEST_F(FaultTestFile, TheScenarioMayBeAGeneratedWorld) {
  const char* const given = std::getenv("XDG_CACHE_HOME");
  const std::optional<std::string> before = given != nullptr ? std::optional<std::string>(given) : std::nullopt;
  ::setenv("XDG_CACHE_HOME", (programs_.dir() / "cache").c_str(), 1);
  write_script(programs_.dir() / "sim_server", kDrawWorld);
  const FaultTest test = load("run: {scenario: wild, scene_seed: 3}\nfaults: [{at_s: 10, blackout: alpha}]");
  EXPECT_EQ(test.plan.scenario.fleet.size(), 2U);
  EXPECT_EQ(read_text(programs_.dir() / "drawn.log"), "wild_3\n") << "generated once";
  before ? ::setenv("XDG_CACHE_HOME", before->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
}

TEST_F(FaultTestFile, FaultsMayStandInAnotherFile) {
  write_text(programs_.dir() / "others.yaml", "faults: [{at_s: 1, blackout: alpha}, {at_s: 2, blackout: beta}]");
  EXPECT_EQ(load("run: {scenario: ./small.yaml}\nfaults: ./others.yaml\nexpect: {}").plan.faults.faults.size(), 2u);
}

TEST_F(FaultTestFile, EachMistakeIsReportedWithItsLine) {
  const std::string run = kBlackout;
  refused("expect: {}", "mine.yaml:1: faults: is missing");
  refused(run + "expect: {exit_cod: 3}", "mine.yaml:3: unknown key 'expect.exit_cod'; did you mean 'exit_code'?");
  refused(run + "expect: {exit_code: high}", "mine.yaml:3: expect.exit_code: must be a number, or {at_least: NUMBER");
  refused(run + "expect: {exit_code: {at_leats: 3}}", "unknown key 'expect.exit_code.at_leats'");
  refused(run + "expect: {exit_code: {}}", "one of them must be there");
  refused(run + "expect: {exit_code: {at_least: 3, at_most: 2}}", "must not be below at_least");
  refused(run + "expect: {same_digest: [twice]}", "expect.same_digest[0]: must be one of again, cyclonedds");
  refused(run + "expect: {radio: {lost: 3}}", "unknown key 'expect.radio.lost'");
  refused(run + "properties: {score: always scor > 3}", "mine.yaml:3:28: properties.score: there is no signal 'scor'");
  refused(run + "properties: {separation: off}", "only a property that holds by default can be off: custody_kept");
  refused("run: {scenario: ./small.yaml, dds: fast}\nfaults: []\n", "run.dds: must be one of cyclonedds");
  refused("run: {scenario: towrs}\nfaults: []\n", "mine.yaml:1: run.scenario: ");
  refused("run: {scenario: ./none.yaml}\nfaults: []\n", "mine.yaml:1: run.scenario: ");
  refused("run: {scenario: ./small.yaml,\n  conditions: brezy}\nfaults: []\n",
          "mine.yaml:2: run.conditions: there is no preset 'brezy' of conditions; did you mean 'breezy'?");
  refused("run:\n  scenario: ./small.yaml\n  planner: nobody=hover\nfaults: []\n", "mine.yaml:3: run.planner: ");
  refused("run: {scenario: ./small.yaml, duration_s: 5}\nfaults: [{at_s: 10, blackout: alpha}]\n",
          "faults[0].at_s: is after the end");
}

TEST_F(FaultTestFile, PlannersMayNameTheCopiesOfALargerFleetAndOnlyUavsThatFly) {
  const std::string run = "faults: []\nrun:\n  scenario: towers\n  planner: hover,";
  EXPECT_EQ(load(run + "jurong2=patrol\n  uavs: 7\n").plan.scenario.fleet.size(), 7u);
  refused(run + "jurong3=patrol\n  uavs: 7\n", "mine.yaml:4: run.planner: ");
  refused(run + "changi=patrol\n  uavs: 2\n", "mine.yaml:4: run.planner: ");
}

TEST_F(FaultTestFile, ASettingThatDoesNotFitTheScenarioIsNamedWithItsLine) {
  const std::string towers = "faults: []\nrun:\n  scenario: towers\n";
  refused(towers + "  duration_s: 1e-9\n", "mine.yaml:4: run.duration_s: ");
  refused(towers + "  uavs: 12\n", "mine.yaml:4: run.uavs: ");
  refused("faults: []\nrun:\n  scenario: mbs\n  scene_seed: 1\n", "mine.yaml:4: run.scene_seed: ");
}

TEST_F(FaultTestFile, AnExpectationThatBecameAPropertyIsRefusedWithTheCommandThatConvertsIt) {
  for (const std::string& key : old_expectations()) {
    const std::string file = (programs_.dir() / "mine.yaml").string();
    refused(kBlackout + std::string("expect:\n  status: completed\n  ") + key + ": 3\n",
            file + ":5: expect." + key + ": is a property now; `skein convert --in-place " + file + "`");
  }
}

TEST_F(FaultTestFile, SomePropertiesHoldUnlessTheFileSaysOtherwise) {
  const auto names = [&](const std::string& text) {
    std::set<std::string> all;
    for (const auto& property : load(kBlackout + text).property_set) EXPECT_TRUE(all.insert(property.name).second);
    return all;
  };
  const std::set<std::string> usual = {"custody_kept", "no_collision", "score_adds_up"};
  EXPECT_EQ(names(""), usual);
  EXPECT_EQ(names("expect: {}"), usual);
  EXPECT_EQ(names("properties: {no_collision: off, separation: ready}"),
            (std::set<std::string>{"custody_kept", "score_adds_up", "separation"}));
  EXPECT_EQ(names("properties: {no_collision: ready}"), usual);
  const FaultTest own = load(kBlackout + std::string("properties: {no_collision: always alive(beta)}"));
  EXPECT_EQ(own.property_set.front().text, "always alive(beta)");
  EXPECT_TRUE(own.states("no_collision"));
  EXPECT_FALSE(own.states("custody_kept"));
  write_text(programs_.dir() / "asked.yaml", "properties: {custody_kept: off, low: 'always z(alpha) < 60 m'}");
  EXPECT_EQ(names("properties: ./asked.yaml"), (std::set<std::string>{"low", "no_collision", "score_adds_up"}));
  EXPECT_EQ(names("properties: {separation: ready}\ncapsule: {property: separation, skein: '1'}"),
            std::set<std::string>{"separation"})
      << "a capsule is about one property";
}

TEST_F(FaultTestFile, AnErrorInACapsuleIsReportedWithItsColumn) {
  const std::string run = "run: {scenario: ./small.yaml, duration_s: 60, uavs: 2}\n";
  const std::string rest =
      "faults:\n  - {at_s: 10, until_s: 20, blackout: alpha}\nproperties: {separation: ready}\n"
      "capsule: {property: separation, digest: '12', skein: '1'}\n";
  load(run + rest);
  const auto with = [&](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    return at == std::string::npos ? ADD_FAILURE() << from, text : text.replace(at, from.size(), to);
  };
  refused(with(run, "60", "long") + rest, "mine.yaml:1:31: run.duration_s: must be a number");
  refused(with(run, "uavs", "uavz") + rest, "mine.yaml:1:47: unknown key 'run.uavz'");
  refused(with(run, "./small", "./none") + rest, "mine.yaml:1:7: run.scenario: ");
  refused(run + with(rest, "at_s: 10", "at_s: soon"), "mine.yaml:3:6: ");
  refused(run + with(rest, "blackout", "blackot"), "mine.yaml:3:");
  refused(run + with(rest, "alpha", "gamma"), "mine.yaml:3:");
  refused(run + with(rest, "property: separation", "property: separatoin"),
          "mine.yaml:5:11: capsule.property: there is no property 'separatoin' in this file; did you mean");
  refused(run + with(rest, "property: separation, ", ""), "mine.yaml:5:");
  refused(run + with(rest, "skein", "sken"), "mine.yaml:5:47: unknown key 'capsule.sken'");
}

TEST_F(FaultTestFile, AFolderStandsForItsFilesAndAFileForItself) {
  EXPECT_EQ(fault_test_files(programs_.dir() / "small.yaml").size(), 1u);
  EXPECT_THROW(fault_test_files(programs_.dir() / "none.yaml"), InputError);
  write_text(programs_.dir() / "tests_b.yaml", "");
  EXPECT_EQ(fault_test_files(programs_.dir()).back().filename(), "tests_b.yaml");
  std::filesystem::create_directory(programs_.dir() / "empty");
  EXPECT_THROW(fault_test_files(programs_.dir() / "empty"), InputError);
}

/// A run without failures. Each test changes it.
class JudgedRun : public FaultTestFile {
 protected:
  JudgedRun() {
    run_.result = Json::parse(R"({"status": "completed", "deterministic": true, "digest": "d1", "sim_time_s": 60.3,
      "faults": [{"kind": "blackout", "began_step": 200}], "radio": {"sent": 50, "dropped_fault": 3}})");
  }

  /// The message about `run_` when a file has this `expect`.
  std::string broken(const std::string& expect) {
    const FaultTest test = load(kBlackout + std::string("expect: {") + expect + "}");
    Evidence evidence{test.plan.faults, run_, exit_code_, {}};
    if (again_) evidence.repeats.emplace_back("again", &*again_);
    std::string text;
    for (const Judgement& judgement : judged(test.expect, evidence)) {
      if (judgement.holds) continue;
      text += judgement.path + ": " + judgement.text + "\n";
      place_ = test.said_of(judgement.path, "");
    }
    return text;
  }

  results::RunRecord run_;
  std::optional<results::RunRecord> again_;
  int exit_code_ = 0;
  std::string place_;  ///< file, line and key of the last expectation that did not hold
};

TEST_F(JudgedRun, AGoodRunMeetsTheDefaultExpectations) { EXPECT_EQ(broken(""), ""); }

TEST_F(JudgedRun, TheDefaultExpectationsApplyUnlessTheFileReplacesThem) {
  run_.result["status"] = "no_takeoff";
  run_.result["digest"] = nullptr;
  run_.result["faults"][0]["began_step"] = nullptr;
  exit_code_ = 3;
  EXPECT_EQ(broken(""),
            "expect.status: expected completed, seen no_takeoff, at 60.3 s\n"
            "expect.exit_code: expected 0, seen 3, at 60.3 s\n"
            "expect.deterministic: expected a digest, seen none, at 60.3 s\n"
            "expect.faults_acted: expected that blackout of alpha begins at 10 s, seen that it did not; the run ended "
            "at 60.3 s\n");
  EXPECT_EQ(broken("status: no_takeoff, exit_code: 3, deterministic: false, faults_acted: false"), "");
}

TEST_F(JudgedRun, CountersOfTheRadioHaveLimits) {
  EXPECT_EQ(broken("radio: {dropped_fault: {at_least: 3}, sent: {at_least: 5, at_most: 50}}"), "");
  EXPECT_EQ(broken("radio: {dropped_fault: 0}"),
            "expect.radio.dropped_fault: expected 0 dropped_fault, seen 3, at "
            "60.3 s\n");
  EXPECT_EQ(broken("radio: {sent: {at_least: 1, at_most: 3}}"),
            "expect.radio.sent: expected from 1 to 3 sent, seen 50, at 60.3 s\n");
}

TEST_F(JudgedRun, RepetitionsHaveTheSameDigest) {
  again_ = run_;
  EXPECT_EQ(broken("same_digest: [again]"), "");
  again_->result["digest"] = "d2";
  EXPECT_EQ(broken(""),
            "expect.same_digest: expected the digest \"d1\" of the repetition 'again' too, seen \"d2\"; compare  with "
            "\n");
  run_.result["digest"] = again_->result["digest"] = nullptr;
  EXPECT_NE(broken("deterministic: false"), "") << "a missing digest is not equal to any other";
}

TEST_F(JudgedRun, TheReportNamesTheLineOfAFailedExpectation) {
  const std::string file = (programs_.dir() / "mine.yaml").string();
  EXPECT_NE(broken("status: completed,\n  radio: {\n  sent: 3}"), "");
  EXPECT_EQ(place_, file + ":5: expect.radio.sent: ");
  run_.result["deterministic"] = false;
  EXPECT_NE(broken("status: completed"), "") << "the file states the default expectation";
  EXPECT_EQ(place_, file + ":3: expect.deterministic: ")
      << "the file does not state this expectation, so the message names the line of `expect`";
}

TEST_F(FaultTestFile, AnotherSeedDrawsOtherTimesOfFaults) {
  const FaultTest test = load(
      "run: {scenario: ./small.yaml, duration_s: 60}\nfaults: [{at_s: [10, 20], until_s: [30, 40], blackout: alpha}]\n"
      "expect: {}\n");
  std::set<double> begins;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const FaultTest drawn = with_seed(test, seed);
    EXPECT_EQ(drawn.plan.options.seed, seed);
    const Fault& fault = drawn.plan.faults.faults.front();
    EXPECT_TRUE(fault.at_s >= 10.0 && fault.at_s <= 20.0) << fault.at_s;
    EXPECT_TRUE(*fault.until_s >= 30.0 && *fault.until_s <= 40.0) << *fault.until_s;
    EXPECT_EQ(with_seed(test, seed).plan.faults.faults.front().at_s, fault.at_s) << "the same seed draws the same time";
    begins.insert(fault.at_s);
  }
  EXPECT_GT(begins.size(), 15u);
}

}  // namespace
}  // namespace skein::cli
