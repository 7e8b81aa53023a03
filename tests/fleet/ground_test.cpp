// A strategy's program at the ground station: it joins, hears and leaves, and changes nothing by being there.
#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

using GroundProgram = FleetTest;

TEST_F(GroundProgram, ListensWithoutChangingTheRun) {
  const Arguments brief = {"towers", "--duration", "15"};
  const auto with = [&](const std::string& name, const std::string& planner) -> SkeinRun& {
    Arguments arguments = brief;
    arguments.insert(arguments.end(), {"--planner", planner});
    return run(name, arguments);
  };
  SkeinRun& alone = with("alone", "patrol");
  SkeinRun& heard = with("heard", "patrol,gcs=listen:longest_text=20");
  EXPECT_EQ(heard.digest(), alone.digest());
  EXPECT_EQ(heard.result()["planner"]["gcs"], "listen:longest_text=20");
  EXPECT_TRUE(heard.result()["processes"].contains("uav_agent-gcs"));
  EXPECT_FALSE(alone.result()["planner"].contains("gcs"));
  EXPECT_NE(text_of(heard.dir() / "uav_agent-gcs.log").find("jurong in sight"), std::string::npos);
}

TEST_F(GroundProgram, UnknownOnesAreRefusedBeforeTheStart) {
  SkeinRun& run = this->run("unknown", {"towers", "--planner", "patrol,gcs=lisen"}, {}, 2);
  EXPECT_NE(run.err().find("listen"), std::string::npos) << run.err();
}

}  // namespace
}  // namespace skein::test
