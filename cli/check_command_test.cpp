#include "cli/check_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

class CheckCommand : public ::testing::Test {
 protected:
  int check(const CheckOptions& options) { return check_files(options, {out_, err_, false}); }
  std::string file(const std::string& name, const std::string& text) {
    write_text(programs_.dir() / name, text);
    return programs_.dir() / name;
  }

  FakePrograms programs_;
  std::ostringstream out_, err_;
};

TEST_F(CheckCommand, GoodFilesAreNamedWithTheirKind) {
  const std::string vehicle = file("v.yaml", "{name: p, role: photographer}");
  EXPECT_EQ(check({{programs_.scenario(), vehicle}, {}, {}}), kExitDone);
  EXPECT_EQ(out_.str(), programs_.scenario().string() + ": OK (scenario)\n" + vehicle + ": OK (vehicle)\n");
}

TEST_F(CheckCommand, FaultFilesAreCheckedWithAScenario) {
  const std::string towers = file("f.yaml", "faults: [{at_s: 10, blackout: changi}]");
  const std::string mine = file("m.yaml", "faults: [{at_s: 10, blackout: alpha}]");
  EXPECT_EQ(check({{towers}, {}, {}}), kExitDone);
  EXPECT_EQ(out_.str(), towers + ": OK (fault file, with towers)\n");
  EXPECT_EQ(check({{mine}, {}, {}}), kExitBadInput) << "the scenario towers has no UAV alpha";
  CheckOptions options{{mine}, {}, {}};
  options.scenario = programs_.scenario();
  EXPECT_EQ(check(options), kExitDone);
}

TEST_F(CheckCommand, FaultFilesAreCheckedWithConditions) {
  CheckOptions options{{file("f.yaml", "faults: [{at_s: 10, fix_loss: changi}]")}, {}, {}};
  EXPECT_EQ(check(options), kExitBadInput) << "with the default conditions, no UAV can lose its GNSS fix";
  options.conditions = "odometry=breezy";
  EXPECT_EQ(check(options), kExitDone);
}

TEST_F(CheckCommand, OptionsWithoutAFileToWhichTheyApplyAreRefused) {
  CheckOptions options{{programs_.scenario()}, {}, {}};
  options.conditions = "harsh";
  EXPECT_EQ(check(options), kExitBadInput);
  EXPECT_NE(err_.str().find("--scenario and --conditions are for fault files"), std::string::npos) << err_.str();
  options.files.push_back(file("f.yaml", "faults: [{at_s: 10, fix_loss: changi}]"));
  EXPECT_EQ(check(options), kExitDone) << err_.str();
}

TEST_F(CheckCommand, FaultFilesNeedNoFilesOfTheScene) {
  CheckOptions options{{file("f.yaml", "faults: [{at_s: 10, blackout: changi}]")}, {}, {}};
  options.scenario = "mbs";
  options.assets = programs_.dir() / "nothing here";
  EXPECT_EQ(check(options), kExitDone) << "only its fleet and its times matter";
}

TEST_F(CheckCommand, FaultTestsNameTheirScenario) {
  const std::string faults = "run: {scenario: ./small.yaml}\nfaults: [{at_s: 10, blackout: alpha}]\n";
  const std::string test = file("t.yaml", faults + "properties: {some: 'eventually score >= 1'}");
  EXPECT_EQ(check({{test}, {}, {}}), kExitDone);
  EXPECT_EQ(out_.str(), test + ": OK (fault test, with small)\n");
  EXPECT_EQ(check({{file("u.yaml", faults)}, {}, {}}), kExitDone)
      << "a fault test needs no properties besides the default ones";
  EXPECT_EQ(check({{file("w.yaml", faults + "properties: {some: 'eventually scor >= 1'}")}, {}, {}}), kExitBadInput);
}

TEST_F(CheckCommand, AnAgentIsAskedWhetherItHasThePlanner) {
  write_script(programs_.dir() / "uav_agent", "case \"$*\" in *orbit*) echo 'no planner orbit' >&2; exit 2;; esac\n");
  const std::string mine = file("mine", "");
  write_script(mine, "[ \"$1\" != --list-planners ] || echo '{\"planners\":[\"orbit\"],\"ground_programs\":[]}'\n");
  const std::string test = file("t.yaml",
                                "run: {scenario: ./small.yaml, planner: orbit}\n"
                                "faults: [{at_s: 10, blackout: alpha}]\nexpect: {}\n");
  CheckOptions options{{test}, {}, {}};
  EXPECT_EQ(check(options), kExitBadInput) << "uav_agent does not know orbit";
  EXPECT_EQ(err_.str(), test + ": run: no planner orbit\n");
  options.agent = mine;
  EXPECT_EQ(check(options), kExitDone) << err_.str();
  options.agent = programs_.dir() / "missing";
  EXPECT_EQ(check(options), kExitBadInput);
}

TEST_F(CheckCommand, WrongFilesAreRefused) {
  EXPECT_EQ(check({{"/does/not/exist.yaml"}, {}, {}}), kExitBadInput);
  EXPECT_EQ(check({{file("a.yaml", "{colour: red}")}, {}, {}}), kExitBadInput);
  EXPECT_EQ(check({{file("b.yaml", "{name: p, role: pilot}")}, {}, {}}), kExitBadInput);
  EXPECT_EQ(check({{file("c.yaml", "{name: s, scene: {family: towers}, fleet: []}")}, {}, {}}), kExitBadInput);
}

TEST_F(CheckCommand, AScenarioThatTheServerRefusesIsBadInput) {
  write_script(programs_.dir() / "sim_server", "echo 'the mesh is empty' >&2; exit 2");
  EXPECT_EQ(check({{programs_.scenario()}, {}, {}}), kExitBadInput);
  EXPECT_EQ(err_.str(), programs_.scenario().string() + ": the mesh is empty\n") << "the message names the file";
}

TEST_F(CheckCommand, AllFilesAreCheckedAndTheCommandReturnsTheWorstExitCode) {
  const std::string bad = file("bad.yaml", "{name: p, role: pilot}"), odd = file("odd.yaml", "{colour: red}");
  const std::string good = file("v.yaml", "{name: p, role: photographer}"), table = file("t.csv", "x\n");
  EXPECT_EQ(check({{bad, good, odd}, {}, {}}), kExitBadInput);
  EXPECT_EQ(out_.str(), good + ": OK (vehicle)\n");
  EXPECT_NE(err_.str().find(bad + ":1: "), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find(odd + ":1: "), std::string::npos) << err_.str();
  write_script(programs_.dir() / "sim_server", "[ \"$1\" != --golden ] || exit 1; echo crashed >&2; exit 3");
  EXPECT_EQ(check({{bad}, {table}, {}}), kExitBadInput) << "bad input is worse than vectors that differ";
  EXPECT_EQ(check({{programs_.scenario(), bad}, {table}, {}}), kExitProcessFailed);
  EXPECT_NE(err_.str().find("sim_server --check ended with exit code 3"), std::string::npos) << err_.str();
}

TEST_F(CheckCommand, TheServerChecksReferenceVectorsAndTheCommandReturnsItsExitCode) {
  const std::string table = file("t.csv", "x\n");
  write_script(programs_.dir() / "sim_server", "[ \"$1\" = --golden ] && [ -e \"$2\" ] && exit 1; exit 2");
  EXPECT_EQ(check({{}, {table}, {}}), kExitCheckFailed);
  write_script(programs_.dir() / "sim_server", "exit 0");
  EXPECT_EQ(check({{}, {table, table}, {}}), kExitDone);
}

}  // namespace
}  // namespace skein::cli
