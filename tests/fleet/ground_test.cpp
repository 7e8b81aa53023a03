// A strategy's program at the ground station: it joins, receives messages and leaves, and its presence changes nothing.
#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

using GroundProgram = FleetTest;

TEST_F(GroundProgram, ListensWithoutChangingTheRun) {
  const Arguments brief = {"towers", "--duration", "15"};
  const auto with = [&](const std::string& name, const std::string& planner, const Arguments& how) -> SkeinRun& {
    Arguments arguments = brief;
    arguments.insert(arguments.end(), {"--planner", planner});
    arguments.insert(arguments.end(), how.begin(), how.end());
    return run(name, arguments);
  };
  SkeinRun& alone = with("alone", "patrol", {"--one-process"});
  SkeinRun& heard = with("heard", "patrol,gcs=listen:longest_text=20", {});
  SkeinRun& beside = with("beside", "patrol,gcs=listen:longest_text=20", {"--one-process"});
  EXPECT_EQ(heard.digest(), alone.digest());
  EXPECT_EQ(beside.digest(), alone.digest());
  EXPECT_EQ(heard.result()["planner"]["gcs"], "listen:longest_text=20");
  EXPECT_TRUE(heard.result()["processes"].contains("uav_agent-gcs"));
  EXPECT_FALSE(alone.result()["planner"].contains("gcs"));
  for (const SkeinRun* run : {&heard, &beside}) {
    EXPECT_NE(text_of(run->dir() / "uav_agent-gcs.log").find("jurong in sight"), std::string::npos);
  }
}

TEST_F(GroundProgram, AnUnknownStrategyIsRefusedBeforeTheStart) {
  SkeinRun& run = this->run("unknown", {"towers", "--planner", "patrol,gcs=lisen"}, {}, 2);
  EXPECT_NE(run.err().find("listen"), std::string::npos) << run.err();
}

}  // namespace
}  // namespace skein::test
