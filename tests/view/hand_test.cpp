// A UAV that is flown by hand from the page: a file keeps its commands, and repeats the flight bit for bit.
#include <csignal>

#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const Arguments kHandFlight = {"towers", "--duration", "120", "--no-oracle", "--no-report"};

class FlownByHand : public ViewTest {};

bool rests(const std::map<std::string, std::string>& row) {
  for (const char* column : {"ahead", "left", "up", "yaw_rate", "gimbal_pitch_rate", "gimbal_yaw_rate"}) {
    if (std::stod(row.at(column)) != 0.0) return false;
  }
  return true;
}

TEST_F(FlownByHand, IsRepeatedFromTheRecordedCommands) {
  if (const std::string why = no_browser(); !why.empty()) GTEST_SKIP() << why;
  SkeinRun& flown = start("flown", joined(kHandFlight, {"--planner", "kios,jurong=hand", "--view", "--view-close",
                                                        "--pause-at", "0", "--record=run"}));
  look_with_browser("hand", {door_of(flown), "jurong"});
  ASSERT_EQ(flown.exit_code(), 0) << flown.err();
  expect_complete_result(flown);

  const fs::path kept = flown.dir() / "hand-jurong.csv";
  const auto rows = read_csv(kept);
  ASSERT_GT(rows.size(), 8U) << "a command for each key that is pressed or released, and more";
  EXPECT_FALSE(rests(rows[rows.size() - 2]));
  EXPECT_TRUE(rests(rows.back())) << "the UAV must stop when its browser vanishes while a key is pressed";
  const Json result = flown.result();
  EXPECT_EQ(result["hand"], Json::array({{{"uav", "jurong"}, {"file", "hand-jurong.csv"}, {"commands", rows.size()}}}));
  const std::string again = result["repeat_command"];
  EXPECT_NE(again.find("kios,jurong=hand:" + kept.string()), std::string::npos) << again;
  EXPECT_EQ(again.find("--view"), std::string::npos) << again;

  const Arguments repeated = joined(kHandFlight, {"--planner", "kios,jurong=hand:" + kept.string()});
  EXPECT_EQ(run("one", joined(repeated, {"--one-process"})).digest(), flown.digest());
  EXPECT_EQ(run("dds", joined(repeated, {"--dds", "mixed"})).digest(), flown.digest());
  // Without these commands, the flight differs.
  const auto nothing =
      write("hand-nothing.csv", "step,tick,ahead,left,up,yaw_rate,gimbal_pitch_rate,gimbal_yaw_rate\n");
  const Arguments still = joined(kHandFlight, {"--planner", "kios,jurong=hand:" + nothing.string(), "--one-process"});
  EXPECT_NE(run("still", still).digest(), flown.digest());
  EXPECT_FALSE(run("still2", joined(still, {"--stop-at", "5"})).result().contains("hand"))
      << "the result must not mention flight by hand";

  ChildProcess& rerun =
      skein({"rerun", flown.dir().string(), "--uav", "jurong", "--out", (folder() / "rerun").string()});
  EXPECT_EQ(rerun.wait().code, 0) << rerun.out() << rerun.err();
  EXPECT_NE(rerun.out().find("jurong: the output is the recorded one"), std::string::npos) << rerun.out();
  ChildProcess& fork = skein({"fork", flown.dir().string(), "--at", "20", "--out", (folder() / "fork").string()});
  EXPECT_EQ(fork.wait().code, 0) << fork.out() << fork.err();
  EXPECT_NE(fork.out().find("the fork is the same run"), std::string::npos) << fork.out();
}

/// Faults kill and pause the program of a UAV that a file of commands flies, in one process and in several.
TEST_F(FlownByHand, IsRepeatedDespiteFaultsOfItsProgram) {
  const auto kept = write("hand-jurong.csv",
                          "step,tick,ahead,left,up,yaw_rate,gimbal_pitch_rate,gimbal_yaw_rate\n"
                          "20,400,0,0,2,0,0,0\n300,6000,1.5,0,0,0.3,0.25,-0.125\n460,9200,0,1,0,0,0,0\n");
  const auto faults = write("faults.yaml",
                            "faults:\n  - {at_s: 18, until_s: 21, kill: jurong}\n"
                            "  - {at_s: 26, until_s: 29, pause: jurong}\n");
  const Arguments flight = {"towers",      "--duration",  "40",
                            "--no-oracle", "--no-report", "--faults",
                            faults,        "--planner",   "kios,jurong=hand:" + kept.string()};
  const SkeinRun& one = run("one", joined(flight, {"--one-process"}));
  EXPECT_EQ(run("dds", flight).digest(), one.digest());
  EXPECT_GT(one.result()["uavs"][0]["distance_m"].get<double>(), 5.0);
}

TEST_F(FlownByHand, IsRefusedWhereNoViewerCanFly) {
  const Arguments by_hand = {"--planner", "kios,jurong=hand"};
  const SkeinRun& unwatched = run("unwatched", joined(kHandFlight, by_hand), {}, 2);
  for (const char* part : {"jurong=hand", "--view", "hand-jurong.csv"}) {
    EXPECT_NE(unwatched.err().find(part), std::string::npos) << unwatched.err();
  }
  const std::string out = (folder() / "study").string();
  const auto test =
      write("by-hand.test.yaml",
            "run: {scenario: towers, planner: \"jurong=hand\", duration_s: 30}\nfaults: []\nexpect: {exit_code: 0}\n");
  for (const Arguments& command :
       {Arguments{"compare", "--planners", "kios,hand", "--scenarios", "towers", "--seeds", "0", "--out", out},
        Arguments{"contest", "--planners", "kios,hand", "--scenarios", "towers", "--out", out},
        Arguments{"hunt", "towers", "--planner", "jurong=hand", "--out", out},
        Arguments{"test", "--faults", test.string()}, Arguments{"check-planner", "hand"}}) {
    ChildProcess& refused = skein(command);
    EXPECT_EQ(refused.wait().code, 2) << command.front() << refused.out();
    EXPECT_NE(refused.err().find("--view"), std::string::npos) << command.front() << ": " << refused.err();
  }
  const auto broken = write("broken.csv", "step,tick\n");
  const SkeinRun& bad = run("bad", joined(kHandFlight, {"--planner", "jurong=hand:" + broken.string()}), {}, 2);
  EXPECT_NE(bad.err().find("broken.csv:1: "), std::string::npos) << bad.err();
}

}  // namespace
}  // namespace skein::test
