// `skein test --faults` with made-up programs: what is flown, what is printed, which exit code.
#include "cli/fault_test_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cli/fake_programs.hpp"
#include "cli/test_command.hpp"

namespace skein::cli {
namespace {

/// Writes a report whose digest tells the vendor and the chaos, and a line of what was flown.
constexpr const char* kServer = R"(
faults=no; dds=none
for word in $arguments; do
  [ "$word" = --faults ] && faults=yes
  [ "$last" = --dds ] && dds=$word
  last=$word
done
echo "$faults $dds ${SKEIN_CHAOS:-calm}" >> "$(dirname "$0")/flights"
cat > "$out/sim_server.report.json" <<END
{"status": "completed", "deterministic": true, "digest": "DIGEST", "sim_time_s": 20, "faults": [{"began_step": 40}]}
END
)";

class FaultTestCommand : public testing::Test {
 protected:
  FaultTestCommand() {
    serve("d");
    programs_.script("station", R"(echo '{"score": 3.0, "score_earned": 4.0}' > "$out/station.report.json")");
  }

  /// @param digest  as the shell spells it.
  void serve(const std::string& digest) {
    std::string body = kServer;
    body.replace(body.find("DIGEST"), 6, digest);
    write_script(programs_.dir() / "sim_server", "arguments=\"$*\"" + std::string(kReadOptions) + body);
  }
  void test_file(const std::string& name, const std::string& expect) {
    std::filesystem::create_directories(programs_.dir() / "tests");
    write_text(programs_.dir() / "tests" / (name + ".yaml"),
               "run: {scenario: ../small.yaml, planner: hover, duration_s: 20}\nfaults: [{at_s: 2, blackout: alpha}]\n"
               "expect: {custody: none, " +
                   expect + "}\n");
  }
  int run(TestOptions options = {}) {
    options.faults = programs_.dir() / "tests";
    options.out = programs_.dir() / "results";
    return run_tests(options, {out_, err_, false});
  }
  std::string flights() const { return read_text(programs_.dir() / "flights"); }

  FakePrograms programs_;
  std::ostringstream out_, err_;
};

TEST_F(FaultTestCommand, SaysWhatPassedAndWhatDidNot) {
  test_file("a_good", "score: 3");
  test_file("b_bad", "score: {at_least: 5}");
  EXPECT_EQ(run(), kExitCheckFailed);
  EXPECT_EQ(out_.str(), "PASS a_good\nFAIL b_bad\n     score: expected at least 5, seen 3\n     results: " +
                            (programs_.dir() / "results" / "b_bad").string() + "\n1 passed, 1 failed\n");
  EXPECT_TRUE(std::filesystem::exists(programs_.dir() / "results" / "b_bad" / "result.json"));
}

TEST_F(FaultTestCommand, AllPassed) {
  test_file("good", "score: 3");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(out_.str(), "PASS good\n1 passed, 0 failed\n");
}

TEST_F(FaultTestCommand, NothingFliesWhenAFileIsWrong) {
  test_file("a_good", "score: 3");
  test_file("b_wrong", "scor: 3");
  test_file("c_wrong", "left: [gamma]");
  try {
    run();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b_wrong.yaml:3: unknown key 'expect.scor'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("c_wrong.yaml:3: expect.left"), std::string::npos) << "all are named";
  }
  EXPECT_EQ(flights(), "");
}

TEST_F(FaultTestCommand, TheRunWithoutFaultsIsFlownOnceForAll) {
  test_file("a", "score_vs_fault_free: 1");
  test_file("b", "score_vs_fault_free: 1");
  EXPECT_EQ(run(), kExitDone) << out_.str();
  EXPECT_EQ(flights(), "yes cyclonedds calm\nno cyclonedds calm\nyes cyclonedds calm\n");
}

TEST_F(FaultTestCommand, RepetitionsMayTakeTurns) {
  test_file("a", "score: 3");
  test_file("b", "score: 3");
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

TEST_F(FaultTestCommand, AnotherDigestIsAFailure) {
  serve("${SKEIN_CHAOS:-calm}");
  test_file("a", "same_digest: [again, chaos]");
  EXPECT_EQ(run(), kExitCheckFailed);
  EXPECT_NE(out_.str().find("same_digest: expected the digest \"calm\" of the repetition 'chaos' too, seen \"1\""),
            std::string::npos)
      << out_.str();
}

}  // namespace
}  // namespace skein::cli
