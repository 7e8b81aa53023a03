// Fault tests: what files say, what is refused and with which words, what is expected of a run, and what is said when
// that does not hold. Runs are made up.
#include "cli/fault_tests/fault_test.hpp"

#include <gtest/gtest.h>

#include <set>

#include "cli/testing/fake_programs.hpp"

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

TEST_F(FaultTestFile, SaysWhatIsFlownAndWithWhichFaults) {
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
  EXPECT_EQ(test.repeats(), (std::vector<Repeat>{Repeat::again, Repeat::chaos}));
  EXPECT_FALSE(test.needs_fault_free());
  EXPECT_TRUE(load(kBlackout + std::string("expect: {score_vs_fault_free: {at_least: 0.9}}")).needs_fault_free());
}

TEST_F(FaultTestFile, FaultsMayStandInAnotherFile) {
  write_text(programs_.dir() / "others.yaml", "faults: [{at_s: 1, blackout: alpha}, {at_s: 2, blackout: beta}]");
  EXPECT_EQ(load("run: {scenario: ./small.yaml}\nfaults: ./others.yaml\nexpect: {}").plan.faults.faults.size(), 2u);
}

TEST_F(FaultTestFile, AnythingWrongIsNamedWithItsLine) {
  const std::string run = kBlackout;
  refused("expect: {}", "mine.yaml:1: faults: is missing");
  refused(run, "missing key 'expect'");
  refused(run + "expect: {scor: 3}", "mine.yaml:3: unknown key 'expect.scor'; did you mean 'score'?");
  refused(run + "expect: {score: high}", "mine.yaml:3: expect.score: must be a number, or {at_least: NUMBER");
  refused(run + "expect: {score: {at_leats: 3}}", "unknown key 'expect.score.at_leats'");
  refused(run + "expect: {score: {}}", "one of them must be there");
  refused(run + "expect: {score: {at_least: 3, at_most: 2}}", "must not be below at_least");
  refused(run + "expect: {same_digest: [twice]}", "expect.same_digest[0]: must be one of again, cyclonedds");
  refused(run + "expect: {left: [gamma]}", "mine.yaml:3: expect.left: there is no program 'gamma'");
  refused(run + "expect: {uavs: {gamma: {captures: 3}}}", "there is no UAV 'gamma'");
  refused(run + "expect: {radio: {lost: 3}}", "unknown key 'expect.radio.lost'");
  refused(run + "expect: {taken_over: {uav: beta}}", "no fault of this file befalls 'beta'");
  refused(run + "expect: {custody: perfect}", "must be one of none, kept, exact");
  refused("run: {scenario: ./small.yaml, dds: fast}\nfaults: []\nexpect: {}", "run.dds: must be one of cyclonedds");
  refused("run: {scenario: towrs}\nfaults: []\nexpect: {}", "mine.yaml:1: run.scenario: ");
  refused("run: {scenario: ./none.yaml}\nfaults: []\nexpect: {}", "mine.yaml:1: run.scenario: ");
  refused("run: {scenario: ./small.yaml,\n  conditions: brezy}\nfaults: []\nexpect: {}",
          "mine.yaml:2: run.conditions: there is no preset 'brezy' of conditions; did you mean 'breezy'?");
  refused("run:\n  scenario: ./small.yaml\n  planner: nobody=hover\nfaults: []\nexpect: {}",
          "mine.yaml:3: run.planner: ");
  refused("run: {scenario: ./small.yaml, duration_s: 5}\nfaults: [{at_s: 10, blackout: alpha}]\nexpect: {}",
          "faults[0].at_s: is after the end");
}

TEST_F(FaultTestFile, WhatIsWrongInACapsuleHasAColumn) {
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

TEST_F(FaultTestFile, AFolderIsAllItsFilesAndAFileIsItself) {
  EXPECT_EQ(fault_test_files(programs_.dir() / "small.yaml").size(), 1u);
  EXPECT_THROW(fault_test_files(programs_.dir() / "none.yaml"), InputError);
  write_text(programs_.dir() / "tests_b.yaml", "");
  EXPECT_EQ(fault_test_files(programs_.dir()).back().filename(), "tests_b.yaml");
  std::filesystem::create_directory(programs_.dir() / "empty");
  EXPECT_THROW(fault_test_files(programs_.dir() / "empty"), InputError);
}

/// A run that went well, to be spoilt.
class JudgedRun : public FaultTestFile {
 protected:
  JudgedRun() {
    run_.result = Json::parse(R"({"status": "completed", "deterministic": true, "digest": "d1", "score": 8.0,
      "score_earned": 10.0, "points_detected": 9, "collisions": [], "sim_time_s": 60.3, "lost_members": [],
      "faults": [{"kind": "blackout", "began_step": 200}], "radio": {"sent": 50, "dropped_fault": 3},
      "uavs": [{"name": "alpha", "captures": 12}, {"name": "beta", "captures": 30}]})");
    run_.captures = {{"alpha", 0, 5.0, 1, 5.0, 5.1, ""},
                     {"beta", 0, 12.0, 2, 3.0, 12.1, ""},
                     {"beta", 1, 20.0, 3, 2.0, std::nullopt, "not received"}};
    fault_free_ = run_;
  }

  /// What is said about `run_` when a file expects this.
  std::string broken(const std::string& expect) {
    const FaultTest test = load(kBlackout + std::string("expect: {") + expect + "}");
    Evidence evidence{test.plan.scenario, test.plan.faults, run_, exit_code_, &fault_free_, {}};
    if (again_) evidence.repeats.emplace_back("again", &*again_);
    std::string text;
    for (const Judgement& judgement : judged(test.expect, evidence)) {
      if (judgement.finding.holds) continue;
      text += judgement.key + ": " + judgement.finding.text + "\n";
      place_ = test.said_of(judgement.path(), "");
      at_s_ = judgement.finding.at_s;
    }
    return text;
  }

  results::RunRecord run_, fault_free_;
  std::optional<results::RunRecord> again_;
  int exit_code_ = 0;
  std::string place_;           ///< of the last that did not hold
  std::optional<double> at_s_;  ///< and when
};

TEST_F(JudgedRun, AGoodRunMeetsWhatIsUsual) { EXPECT_EQ(broken(""), ""); }

TEST_F(JudgedRun, WhatIsUsualIsExpectedUnasked) {
  run_.result["status"] = "no_takeoff";
  run_.result["digest"] = nullptr;
  run_.result["collisions"] = Json::parse(R"([{"uav": "alpha", "with": "ground", "time_s": 4.5}])");
  run_.result["faults"][0]["began_step"] = nullptr;
  exit_code_ = 3;
  EXPECT_EQ(
      broken("custody: none"),
      "status: expected completed, seen no_takeoff\n"
      "exit_code: expected 0, seen 3\n"
      "deterministic: expected a digest, seen none\n"
      "faults_acted: expected that blackout of alpha begins at 10 s, seen that it did not; the run ended at 60.3 s\n"
      "collisions: expected 0, seen 1; alpha with ground at 4.5 s\n");
  run_.result["faults"][0]["began_step"] = 200;
  EXPECT_EQ(broken("status: no_takeoff, exit_code: 3, deterministic: false, collisions: {at_most: 1}, custody: none"),
            "");
}

TEST_F(JudgedRun, NumbersHaveLimits) {
  EXPECT_EQ(broken("score: 8, score_earned: {at_least: 10}, points_detected: {at_least: 5, at_most: 9}"), "");
  EXPECT_EQ(broken("score: 9"), "score: expected 9, seen 8\n");
  EXPECT_EQ(broken("points_detected: {at_least: 10}"), "points_detected: expected at least 10, seen 9\n");
  EXPECT_EQ(broken("points_detected: {at_least: 1, at_most: 3}"), "points_detected: expected from 1 to 3, seen 9\n");
  EXPECT_EQ(broken("score_vs_earned: {at_least: 0.9}"),
            "score_vs_earned: expected at least 0.9, seen 0.8 (8 of 10 earned)\n");
  EXPECT_EQ(broken("radio: {dropped_fault: {at_least: 3}, sent: {at_most: 50}}"), "");
  EXPECT_EQ(broken("radio: {dropped_fault: 0}"), "radio: expected 0 dropped_fault, seen 3\n");
  EXPECT_EQ(broken("uavs: {alpha: {captures: {at_most: 12}}}"), "");
  EXPECT_EQ(broken("uavs: {beta: {captures: 0}}"), "uavs: expected 0 for beta's captures, seen 30\n");
}

TEST_F(JudgedRun, TheSameRunWithoutFaultsIsAMeasure) {
  fault_free_.result["score"] = 10.0;
  EXPECT_EQ(broken("score_vs_fault_free: {at_least: 0.8}"), "");
  EXPECT_EQ(broken("score_vs_fault_free: {at_least: 0.9}"),
            "score_vs_fault_free: expected at least 0.9, seen 0.8 (8 of 10 without faults)\n");
  EXPECT_EQ(broken("earned_vs_fault_free: 1"), "");
}

TEST_F(JudgedRun, WhoLeftAndWhoCameBack) {
  run_.events = {{0, "joined", "alpha", ""}, {0, "joined", "beta", ""}, {200, "left", "alpha", ""}};
  EXPECT_EQ(broken("left: [alpha], rejoined: []"), "");
  EXPECT_EQ(broken("left: [alpha], rejoined: [alpha]"), "rejoined: expected alpha, seen nobody\n");
  run_.events.push_back({300, "joined", "alpha", ""});
  EXPECT_EQ(broken("rejoined: [alpha]"), "");
  EXPECT_EQ(broken("left: [alpha, station]"), "left: expected alpha, station, seen alpha\n");
}

TEST_F(JudgedRun, WorkIsTakenOverWhenOthersPhotographWhatWasLeft) {
  // Without the fault, alpha photographs 10, 11 and 12 after its fault at 10 s; beta gets 12 in time, and 11 too late.
  fault_free_.captures = {{"alpha", 0, 5, 9, 1, {}, ""},   {"alpha", 1, 12, 10, 1, {}, ""},
                          {"alpha", 2, 13, 11, 1, {}, ""}, {"alpha", 3, 14, 12, 1, {}, ""},
                          {"beta", 0, 15, 12, 1, {}, ""},  {"beta", 1, 45, 11, 1, {}, ""}};
  run_.captures = {{"beta", 0, 15, 12, 1, {}, ""}, {"beta", 1, 30, 9, 1, {}, ""}, {"beta", 2, 41, 11, 1, {}, ""}};
  run_.result["score"] = 0.0;
  EXPECT_EQ(broken("taken_over: {uav: alpha}"),
            "taken_over: expected others to photograph at least 1 of the 2 points that alpha had before it, from 10 to "
            "40 s, seen 0\n");
  run_.captures.push_back({"beta", 3, 39, 10, 1, {}, ""});
  EXPECT_EQ(broken("taken_over: {uav: alpha}"), "");
  EXPECT_NE(broken("taken_over: {uav: alpha, points: 2}"), "");
  EXPECT_NE(broken("taken_over: {uav: alpha, within_s: 20}"), "");
}

TEST_F(JudgedRun, RepetitionsHaveTheSameDigest) {
  again_ = run_;
  EXPECT_EQ(broken("same_digest: [again]"), "");
  again_->result["digest"] = "d2";
  EXPECT_EQ(broken(""),
            "same_digest: expected the digest \"d1\" of the repetition 'again' too, seen \"d2\"; compare  with \n");
  run_.result["digest"] = again_->result["digest"] = nullptr;
  EXPECT_NE(broken("deterministic: false"), "") << "no digest is no equal digest";
}

TEST_F(JudgedRun, WhatFailsHasItsLineAndItsTime) {
  const std::string file = (programs_.dir() / "mine.yaml").string();
  EXPECT_NE(broken("score: 8,\n  points_detected: 3"), "");
  EXPECT_EQ(place_, file + ":4: expect.points_detected: ");
  EXPECT_EQ(at_s_, 60.3) << "known at the end";
  run_.result["deterministic"] = false;
  EXPECT_NE(broken("score: 8"), "") << "what is usual";
  EXPECT_EQ(place_, file + ":3: expect.deterministic: ") << "stands nowhere but in `expect`";
  run_.result["deterministic"] = true;
  run_.events = {{0, "joined", "alpha", ""}, {200, "left", "alpha", ""}, {240, "left", "beta", ""}};
  EXPECT_NE(broken("left: [alpha]"), "");
  EXPECT_EQ(at_s_, 12.0) << "when beta left";
  EXPECT_NE(broken("uavs: {\n  alpha: {\n  captures: 3}}"), "");
  EXPECT_EQ(place_, file + ":5: expect.uavs.alpha.captures: ");
}

TEST_F(JudgedRun, PartsOfARunAreLookedAtAlone) {
  run_.events = {{110, "released", "alpha", "0"}, {250, "released", "beta", "0"}};
  run_.scores = {{5.1, 5.0}, {12.1, 8.0}};
  run_.messages = {{100, "alpha", std::nullopt}, {100, "beta", 105}, {300, "alpha", 310}};
  for (int tenth = 0; tenth <= 600; ++tenth) {
    run_.positions.push_back({0.1 * tenth, "alpha", {0.0, 0.0, 1.0}});
    run_.positions.push_back({0.1 * tenth, "beta", {0.2 * tenth, 0.0, 1.0}});
  }
  EXPECT_EQ(broken("during: [{after_s: 10, captures: 2, delivered: 1, acknowledged: 1, score: 3, distance_m: "
                   "{at_least: 99.9}}]"),
            "");
  EXPECT_EQ(broken("during: [{until_s: 10, captures: 1, score: 5, uavs: {alpha: {captures: 1, delivered: 1, "
                   "acknowledged: 1}}}]"),
            "");
  EXPECT_EQ(
      broken(
          "during: [{after_s: 30, until_s: 40, distance_m: {at_least: 19.9, at_most: 20.1}, captures: 0, score: 0}]"),
      "");
  EXPECT_EQ(broken("during: [{lost: 1, late: 2, uavs: {alpha: {lost: 1, late: 1}}}, {after_s: 6, lost: 0, late: 1}]"),
            "");
  EXPECT_EQ(broken("during: [{score: 8}, {after_s: 20, uavs: {alpha: {distance_m: {at_least: 1}}}}]"),
            "during: expected at least 1 distance_m of alpha from 20 to 60.3 s, seen 0\n");
  EXPECT_EQ(at_s_, 60.3);
  EXPECT_EQ(broken("during: [{after_s: 30, until_s: 40, captures: {at_least: 1}}]"),
            "during: expected at least 1 captures from 30 to 40 s, seen 0\n");
  EXPECT_EQ(at_s_, 40.0);
  EXPECT_EQ(broken("during: [{after_s: 3, captures: {at_most: 1}}]"),
            "during: expected at most 1 captures from 3 to 60.3 s, seen 3\n");
  EXPECT_EQ(at_s_, 12.0) << "when it became too many";
}

TEST_F(FaultTestFile, PartsOfARunAreReadStrictly) {
  const std::string run = kBlackout;
  refused(run + "expect: {during: [{after_s: 3}]}", "nothing is expected of this time");
  refused(run + "expect: {during: [{after_s: 30, until_s: 20, score: 1}]}", "must be later than after_s");
  refused(run + "expect: {during: [{after_s: 61, score: 1}]}", "expect.during[0].after_s: is after the end");
  refused(run + "expect: {during: [{captured: 1}]}", "unknown key 'expect.during[0].captured'");
  refused(run + "expect: {during: [{uavs: {gamma: {captures: 1}}}]}", "there is no UAV 'gamma'");
  refused(run + "expect: {during: [{uavs: {alpha: {score: 1}}}]}", "unknown key 'expect.during[0].uavs.alpha.score'");
  refused(run + "expect: {during: {score: 1}}", "must be a list");
}

TEST_F(FaultTestFile, AnotherSeedDrawsOtherTimes) {
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
    EXPECT_EQ(with_seed(test, seed).plan.faults.faults.front().at_s, fault.at_s) << "the same again";
    begins.insert(fault.at_s);
  }
  EXPECT_GT(begins.size(), 15u);
}

TEST_F(JudgedRun, EveryKindIsInTheTableOnceAndExplained) {
  std::set<std::string> keys;
  for (const ExpectationKind& kind : expectation_kinds()) {
    EXPECT_TRUE(keys.insert(kind.key).second) << kind.key;
    EXPECT_FALSE(kind.meaning.empty()) << kind.key;
  }
}

}  // namespace
}  // namespace skein::cli
