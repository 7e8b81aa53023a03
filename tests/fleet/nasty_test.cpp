// In a fleet of processes, one UAV's program stops itself (SIGSTOP), closes all its descriptors, or ends without a
// report. The other UAVs must fly on, messages must name only this UAV, and in the end the fleet must leave no process,
// no domain lock and no shared memory behind.
#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

/// The parameters of a test: what jurong's program does at 3 s, and the DDS vendor.
using NastyCase = std::pair<std::string, std::string>;

class Nasty : public FleetTest, public testing::WithParamInterface<NastyCase> {
 protected:
  static std::string planner(const std::string& how) { return "hover,jurong=nasty:how=" + how; }

  const std::string scene_ = write_small_scene(folder());  ///< two UAVs: jurong and changi
};

TEST_P(Nasty, TheLostProgramIsNamedAndTheOthersFlyOn) {
  const auto& [how, vendor] = GetParam();
  SkeinRun& run = this->run(how,
                            {scene_, "--agent", helper_program("nasty_agent"), "--planner", planner(how), "--duration",
                             "8", "--no-oracle", "--agent-timeout", "2", "--dds", vendor},
                            {}, 3);
  expect_complete_result(run);
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_NEAR(result["mission_time_s"].get<double>(), 8.0, 0.1);
  EXPECT_FALSE(result["deterministic"]);
  const Json lost = result["lost_members"];
  ASSERT_EQ(lost.size(), 1U) << lost;
  EXPECT_EQ(lost[0]["member"], "jurong");
  EXPECT_EQ(lost[0]["step"], 60) << "3 s in steps of 0.05 s";
  const std::string reason = how == "exits_now" ? "its process ended" : "did not answer for 2 s";
  EXPECT_TRUE(lost[0]["reason"].get<std::string>().starts_with(reason)) << lost[0]["reason"];
  for (const Json& uav : result["uavs"]) EXPECT_EQ(uav["program_lost"], uav["name"] == "jurong") << uav["name"];
  EXPECT_NE(run.out().find("warning: jurong was lost: " + reason), std::string::npos) << run.out();
  EXPECT_EQ(run.err().find("changi failed"), std::string::npos) << run.err();
  EXPECT_NE(text_of(run.dir() / "uav_agent-jurong.log").find("nasty " + how), std::string::npos);
  expect_nothing_left();
}

INSTANTIATE_TEST_SUITE_P(Deaths, Nasty,
                         testing::Values(NastyCase("stops", "cyclonedds"), NastyCase("closes", "fastdds"),
                                         NastyCase("exits_now", "cyclonedds"), NastyCase("stops", "fastdds"),
                                         NastyCase("closes", "cyclonedds"), NastyCase("exits_now", "fastdds")),
                         [](const auto& tested) { return tested.param.first + "_" + tested.param.second; });

class NastyStudy : public Nasty {};

TEST_P(NastyStudy, TheComparisonNamesTheUav) {
  const auto& [how, vendor] = GetParam();
  ChildProcess& study = skein({"compare", "--planners", "hover", "--planner", planner(how), "--agent",
                               helper_program("nasty_agent"), "--scenarios", scene_, "--seeds", "0", "--duration", "8",
                               "--dds", vendor, "--agent-timeout", "2", "--out", folder() / "study"});
  EXPECT_EQ(study.wait().code, 3) << study.err() << study.out();
  const std::string flights = text_of(folder() / "study" / "flights.csv");
  const std::string problem = ",skein run ended with exit code 3: jurong at 3.0 s: ";
  const std::size_t nasty = flights.find("\"hover,jurong=nasty"), at = flights.find(problem);
  ASSERT_NE(nasty, std::string::npos) << flights;
  EXPECT_GT(at, nasty) << "the flight of hover alone has no problem: " << flights;
  EXPECT_EQ(at, flights.rfind(problem)) << flights;
  ASSERT_NE(at, std::string::npos) << flights;
  EXPECT_NE((study.out() + study.err()).find("jurong at 3.0 s: "), std::string::npos) << study.out() << study.err();
}

INSTANTIATE_TEST_SUITE_P(Deaths, NastyStudy,
                         testing::Values(NastyCase("stops", "fastdds"), NastyCase("closes", "cyclonedds"),
                                         NastyCase("exits_now", "fastdds")),
                         [](const auto& tested) { return tested.param.first; });

}  // namespace
}  // namespace skein::test
