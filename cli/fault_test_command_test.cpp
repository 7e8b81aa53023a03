// `skein test --faults` with stand-ins for the programs: flights, output and exit codes.
#include "cli/test_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"
#include "report/testing/xml_check.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

using report::xml_elements;
using report::XmlElement;

/// A sim_server that writes a report with the digest DIGEST. It adds a line to `flights`, with faults, DDS vendor and
/// chaos of the flight, and a line to `seeds`.
constexpr const char* kFlyingServer = R"(
faults=no; dds=none
for word in $arguments; do
  [ "$word" = --faults ] && faults=yes
  [ "$last" = --dds ] && dds=$word
  [ "$last" = --seed ] && seed=$word
  last=$word
done
echo "$faults $dds ${SKEIN_CHAOS:-calm}" >> "$(dirname "$0")/flights"
echo "$seed" >> "$(dirname "$0")/seeds"
cat > "$out/sim_server.report.json" <<END
{"status": "completed", "deterministic": true, "digest": "DIGEST", "sim_time_s": 20, "faults": [{"began_step": 40}]}
END
)";

class FaultTestCommand : public testing::Test {
 protected:
  FaultTestCommand() {
    std::filesystem::create_symlink(build_path("bin/skein"), programs_.dir() / "skein");
    serve("d");
    programs_.script("station", R"(echo '{"score": 3.0, "score_earned": 4.0}' > "$out/station.report.json")");
  }

  /// Installs a sim_server that reports this digest. @param digest  a word in the syntax of the shell
  void serve(const std::string& digest) {
    std::string body = kFlyingServer;
    body.replace(body.find("DIGEST"), 6, digest);
    write_script(programs_.dir() / "sim_server", "arguments=\"$*\"" + std::string(kReadOptions) + body);
  }
  /// Writes a fault test with one property. @param property  the text of the property
  void test_file(const std::string& name, const std::string& property, const std::string& more = "") {
    std::filesystem::create_directories(programs_.dir() / "tests");
    write_text(programs_.dir() / "tests" / (name + ".yaml"),
               "run: {scenario: ../small.yaml, planner: hover, duration_s: 20}\nfaults: [{at_s: 2, blackout: alpha}]\n"
               "properties: {score_adds_up: off, mine: " +
                   property + "}\n" + more);
  }
  int run(TestOptions options = {}) {
    out_.str("");
    options.faults = programs_.dir() / "tests";
    options.out = programs_.dir() / "results";
    return run_tests(options, {out_, err_, false});
  }
  /// File and line of the property of a test, as messages name them.
  std::string place(const std::string& name) const {
    return (programs_.dir() / "tests" / (name + ".yaml")).string() + ":3";
  }
  std::string flights() const { return read_text(programs_.dir() / "flights"); }

  std::string seeds() const { return read_text(programs_.dir() / "seeds"); }

  FakePrograms programs_;
  std::ostringstream out_, err_;
};

TEST_F(FaultTestCommand, PrintsWhichTestsPassedAndWhichFailed) {
  test_file("a_good", "always result(score) == 3");
  test_file("b_bad", "always result(score) >= 5");
  EXPECT_EQ(run(), kExitCheckFailed);
  EXPECT_EQ(out_.str(), "PASS a_good\nFAIL b_bad\n     " + place("b_bad") +
                            ": properties.mine: it did not hold at 0 s, margin -2\n     results: " +
                            (programs_.dir() / "results" / "b_bad").string() + "\n1 passed, 1 failed\n");
  EXPECT_TRUE(std::filesystem::exists(programs_.dir() / "results" / "b_bad" / "result.json"));
}

TEST_F(FaultTestCommand, ReturnsZeroIfAllTestsPass) {
  test_file("good", "always result(score) == 3");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(out_.str(), "PASS good\n1 passed, 0 failed\n");
}

TEST_F(FaultTestCommand, NothingFliesWhenAFileIsWrong) {
  test_file("a_good", "always result(score) == 3");
  test_file("b_wrong", "always scor == 3");
  test_file("c_wrong", "always member(gamma)");
  try {
    run();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b_wrong.yaml:3:47: properties.mine: there is no signal 'scor'"),
              std::string::npos);
    EXPECT_NE(std::string(error.what()).find("c_wrong.yaml:3:54: properties.mine: there is no program"),
              std::string::npos)
        << "all wrong files are named";
  }
  EXPECT_EQ(flights(), "");
}

TEST_F(FaultTestCommand, TheProgramsCheckTheFaultsOfEachTest) {
  test_file("a", "always result(score) == 3");
  test_file("b", "always result(score) == 3");
  write_script(programs_.dir() / "sim_server", "case \"$*\" in */b.yaml*) echo 'no such fault' >&2; exit 2;; esac");
  try {
    run();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b.yaml: run: no such fault"), std::string::npos) << error.what();
  }
}

TEST_F(FaultTestCommand, TheRunWithoutFaultsIsFlownOnceForAllTests) {
  test_file("a", "finally result(score) == undisturbed_score");
  test_file("b", "finally result(score) == undisturbed_score");
  EXPECT_EQ(run(), kExitDone) << out_.str();
  EXPECT_EQ(flights(), "yes cyclonedds calm\nno cyclonedds calm\nyes cyclonedds calm\n");
}

TEST_F(FaultTestCommand, WithRotateEachTestFliesOneOfTheRepetitions) {
  test_file("a", "always result(score) == 3");
  test_file("b", "always result(score) == 3");
  TestOptions options;
  options.repeat = {"fastdds", "chaos"};
  EXPECT_EQ(run(options), kExitDone) << out_.str();
  EXPECT_EQ(flights(),
            "yes cyclonedds calm\nyes fastdds calm\nyes cyclonedds 1\nyes cyclonedds calm\nyes fastdds calm\nyes "
            "cyclonedds 2\n");
  std::filesystem::remove(programs_.dir() / "flights");
  options.rotate = true;
  EXPECT_EQ(run(options), kExitDone) << out_.str();
  EXPECT_EQ(flights(), "yes cyclonedds calm\nyes fastdds calm\nyes cyclonedds calm\nyes cyclonedds 2\n");
}

TEST_F(FaultTestCommand, TwoFlightsNeverHaveTheSameFolder) {
  test_file("a", "finally result(score) == undisturbed_score", "expect: {same_digest: [again]}\n");
  for (const std::string other : {"a-again", "without-faults-1"}) {
    test_file(other, "always result(score) == 3");
    try {
      run();
      ADD_FAILURE() << other;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("would both write to the folder " + other), std::string::npos)
          << error.what();
    }
    std::filesystem::remove(programs_.dir() / "tests" / (other + ".yaml"));
  }
  EXPECT_EQ(flights(), "");
}

TEST_F(FaultTestCommand, ARepetitionWithAnotherDigestIsAFailure) {
  serve("${SKEIN_CHAOS:-calm}");
  test_file("a", "always result(score) == 3", "expect: {same_digest: [again, chaos]}\n");
  EXPECT_EQ(run(), kExitCheckFailed);
  EXPECT_NE(
      out_.str().find("expect.same_digest: expected the digest \"calm\" of the repetition 'chaos' too, seen \"1\""),
      std::string::npos)
      << out_.str();
}

TEST_F(FaultTestCommand, EachSeedIsATestOfItsOwn) {
  test_file("a", "always result(score) == 3");
  test_file("b", "always result(score) == 4");
  TestOptions options;
  options.seeds = "4-5,9";
  EXPECT_EQ(run(options), kExitCheckFailed);
  std::vector<std::string> verdicts;
  std::istringstream lines(out_.str());
  for (std::string line; std::getline(lines, line);) {
    if (line.front() != ' ') verdicts.push_back(line);
  }
  EXPECT_EQ(verdicts, (std::vector<std::string>{"PASS a-seed-4", "PASS a-seed-5", "PASS a-seed-9", "FAIL b-seed-4",
                                                "FAIL b-seed-5", "FAIL b-seed-9", "3 passed, 3 failed"}));
  EXPECT_EQ(seeds(), "4\n5\n9\n4\n5\n9\n");
}

TEST_F(FaultTestCommand, TestsThatFlyAtOnceGiveTheSameOutput) {
  for (const char* name : {"a", "b", "c", "d", "e"})
    test_file(name, std::string(name) == "c" ? "always result(score) == 9" : "always result(score) == 3");
  EXPECT_EQ(run(), kExitCheckFailed);
  const std::string alone = out_.str();
  TestOptions options;
  options.jobs = 4;
  EXPECT_EQ(run(options), kExitCheckFailed);
  EXPECT_EQ(out_.str(), alone);
}

TEST_F(FaultTestCommand, VerbosePrintsTheObservedValues) {
  test_file("good", "always result(score) >= 2");
  TestOptions options;
  options.verbose = true;
  EXPECT_EQ(run(options), kExitDone);
  EXPECT_TRUE(out_.str().starts_with("PASS good\n")) << out_.str();
  EXPECT_NE(out_.str().find("     holds: " + place("good") + ": properties.mine: margin 1, decided at 0 s\n"),
            std::string::npos)
      << out_.str();
}

TEST_F(FaultTestCommand, WritesAReportAsJUnitXml) {
  test_file("a_good", "always result(score) == 3");
  test_file("b_bad<&\">", "always result(score) >= 5");
  TestOptions options;
  options.junit = programs_.dir() / "report.xml";
  EXPECT_EQ(run(options), kExitCheckFailed);
  const std::string text = read_text(*options.junit);
  ASSERT_TRUE(text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n")) << text;
  const auto elements = xml_elements(text);
  std::vector<std::string> names;
  for (const XmlElement& element : elements) names.push_back(element.name);
  EXPECT_EQ(names, (std::vector<std::string>{"testsuites", "testsuite", "testcase", "system-out", "testcase", "failure",
                                             "system-out"}));
  for (const std::size_t suite : {0u, 1u}) {
    EXPECT_EQ(elements[suite].attributes.at("tests"), "2");
    EXPECT_EQ(elements[suite].attributes.at("failures"), "1");
    EXPECT_EQ(elements[suite].attributes.at("errors"), "0");
    EXPECT_EQ(elements[suite].attributes.at("skipped"), "0");
    EXPECT_FALSE(elements[suite].attributes.at("time").empty());
  }
  EXPECT_EQ(elements[2].attributes.at("name"), "a_good");
  EXPECT_EQ(elements[4].attributes.at("name"), "b_bad<&\">");
  EXPECT_NE(elements[5].attributes.at("message").find("properties.mine: it did not hold at 0 s, margin -2"),
            std::string::npos);
}

TEST_F(FaultTestCommand, TheReasonIsReportedForARunWithoutResults) {
  programs_.script("comm_router", "");
  test_file("a", "always result(score) == 3");
  write_script(programs_.dir() / "fails", "echo nobody home >&2; exit 3");
  std::filesystem::remove(programs_.dir() / "skein");
  std::filesystem::create_symlink(programs_.dir() / "fails", programs_.dir() / "skein");
  EXPECT_EQ(run(), kExitCheckFailed);
  EXPECT_NE(out_.str().find("exit code 3 and without a result\n       nobody home"), std::string::npos) << out_.str();
}

TEST_F(FaultTestCommand, ABadReportOrSeedIsReportedBeforeAnythingFlies) {
  test_file("a", "always result(score) == 3");
  const auto refused = [&](TestOptions options, const std::string& words) {
    try {
      run(options);
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_EQ(flights(), "");
  };
  TestOptions options;
  options.junit = programs_.dir() / "none" / "report.xml";
  refused(options, "--junit: ");
  options.junit = programs_.dir();
  refused(options, "is not a regular file");
  options.junit = "/dev/null";
  refused(options, "is not a regular file");
  options.junit.reset();
  options.seeds = "3-x";
  refused(options, "is not a seed");
  options.seeds.reset();
  options.agent = programs_.dir() / "nobody";
  refused(options, "--agent: ");
}

TEST_F(FaultTestCommand, TheAgentProgramOfTheUserFliesTheTests) {
  write_script(programs_.dir() / "mine",
               "[ \"$1\" != --list-planners ] || { echo '{}'; exit 0; }\n"
               "echo \"$*\" >> \"$(dirname \"$0\")/mine.calls\"\n");
  test_file("a", "always result(score) == 3", "expect: {exit_code: {at_most: 9}}\n");
  TestOptions options;
  options.agent = programs_.dir() / "mine";
  EXPECT_EQ(run(options), kExitDone) << out_.str();
  const std::string calls = read_text(programs_.dir() / "mine.calls");
  EXPECT_NE(calls.find("--uav alpha --planner hover"), std::string::npos) << calls;
  EXPECT_NE(calls.find("--uav beta --planner hover"), std::string::npos) << calls;
}

}  // namespace
}  // namespace skein::cli
