// Agent programs of two teams in one flight, and in one study (docs/how-to-add-a-planner.md): --planner NAME@AGENT.
// Each behaves as with --agent.
#include <unistd.h>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

/// Two agent programs: only the first has the planner orbit, only the second has probe.
const std::string kOrbits = helper_program("howto_agent"), kProbes = helper_program("probe_agent");

class Teams : public FleetTest {
 protected:
  SkeinRun& fly(const std::string& name, const std::string& planner, Arguments more = {}) {
    more.insert(more.begin(), {scene_, "--duration", "15", "--planner", planner});
    return run(name, more);
  }

  const std::string scene_ = write_small_scene(folder());  ///< two UAVs: jurong and changi
};

TEST_F(Teams, MeetInOneFlight) {
  SkeinRun& met = fly("met", "orbit@" + kOrbits + ",changi=probe:up_m=2@" + kProbes);
  const Json result = met.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["planner"],
            (Json{{"jurong", "orbit@" + kOrbits}, {"changi", "probe:up_m=2@" + kProbes}, {"gcs", "orbit@" + kOrbits}}));
  EXPECT_FALSE(result.contains("agent"));
  EXPECT_NE(text_of(met.dir() / "uav_agent-changi.log").find("probe {"), std::string::npos);
  EXPECT_TRUE(result["processes"].contains("uav_agent-gcs"));
  // The flight does not depend on which program is the fleet's default; a planner of both programs flies the same in
  // each.
  EXPECT_EQ(fly("of_one", "orbit,changi=probe:up_m=2@" + kProbes, {"--agent", kOrbits}).digest(), met.digest());
  EXPECT_NE(fly("alone", "orbit", {"--agent", kOrbits}).digest(), met.digest());
  EXPECT_EQ(fly("patrols", "patrol@" + kOrbits + ",changi=hover@" + kProbes).digest(),
            fly("stock", "patrol,changi=hover").digest());
  expect_complete_result(met);
}

TEST_F(Teams, MeetInOneSecuredFlight) {
  std::filesystem::permissions(folder(), std::filesystem::perms(0755));  // agents with other user ids read the scenario
  const std::string planner = "orbit@" + kOrbits + ",changi=probe@" + kProbes;
  EXPECT_EQ(fly("secure", planner, {"--secure"}).digest(), fly("open", planner).digest());
  if (::geteuid() != 0) GTEST_SKIP() << "agents have users of their own only when the launcher is root";
  const auto closed = write("closed", "#!/bin/sh\nexec " + kProbes + " \"$@\"\n");
  std::filesystem::permissions(closed, std::filesystem::perms(0700));
  SkeinRun& refused =
      run("refused", {scene_, "--secure", "--planner", "orbit@" + kOrbits + ",changi=probe@" + closed.string()}, {}, 2);
  EXPECT_NE(refused.err().find("cannot read " + closed.string()), std::string::npos) << refused.err();
}

TEST_F(Teams, MeetInOneStudy) {
  const std::string ours = "patrol@" + kOrbits, theirs = "patrol@" + kProbes;
  ChildProcess& study = skein({"compare", "--planners", "orbit@" + kOrbits + "," + ours + "," + theirs, "--planner",
                               "changi=probe@" + kProbes, "--scenarios", scene_, "--seeds", "0", "--duration", "15",
                               "--out", folder() / "study"});
  ASSERT_EQ(study.wait().code, 0) << study.err();
  std::map<std::string, std::string> digests;
  for (const auto& row : read_csv(folder() / "study/flights.csv")) digests[row.at("planner")] = row.at("digest");
  const std::map<std::string, std::string> expected = {
      {"orbit@howto_agent", fly("orbit", "orbit", {"--agent", kOrbits}).digest()},
      {"patrol@howto_agent", fly("ours", "patrol", {"--agent", kOrbits}).digest()},
      {"patrol@probe_agent", fly("theirs", "patrol", {"--agent", kProbes}).digest()},
      {"changi=probe@probe_agent", fly("probe", "changi=probe", {"--agent", kProbes}).digest()}};
  EXPECT_EQ(digests, expected);
  const std::string page = text_of(folder() / "study/report.html");
  for (const auto& [label, digest] : expected) EXPECT_NE(page.find(label), std::string::npos) << label;
  EXPECT_TRUE(std::filesystem::exists(folder() / "study/flights/scenario/orbit@howto_agent/seed-0/result.json"));
}

TEST_F(Teams, AnAgentOrPlannerThatDoesNotExistIsNamed) {
  const std::string text = write("text", "no program"), nobody = folder() / "nobody";
  const std::vector<std::pair<std::string, std::vector<std::string>>> wrong = {
      {"orbit@" + nobody, {"--planner orbit@" + nobody, "no such file"}},
      {"orbit:standoff_m=5@" + nobody + ",speed_mps=2", {"no such file", "the last '@'", "/uav_agent"}},
      {"hover,changi=orbit@" + text, {"--planner orbit@" + text, "cannot be executed"}},
      {"hover,gcs=orbit@/bin/true", {"--planner orbit@/bin/true", "skein_add_agent()"}},
      {"patrol@" + kProbes + ",changi=probe@" + kOrbits, {"--planner probe@" + kOrbits, "known are", "orbit"}},
      {"hover,gcs=hover@" + kOrbits, {"hover", "ground"}},
      {"orbit@" + kOrbits + ",changi=orbits@" + kOrbits, {"orbits", "did you mean 'orbit'"}},
      {"hover@", {"--planner hover@: ", "such as hover@build/my_agent"}},
      {"@" + kOrbits, {"a planner's name is missing"}}};
  int count = 0;
  for (const auto& [planner, parts] : wrong) {
    SCOPED_TRACE(planner);
    SkeinRun& refused = run("run" + std::to_string(++count), {scene_, "--planner", planner}, {}, 2);
    ChildProcess& study = skein({"compare", "--planner", planner, "--scenarios", scene_, "--out", folder() / "study"});
    EXPECT_EQ(study.wait().code, 2);
    for (const std::string& part : parts) {
      EXPECT_NE(refused.err().find(part), std::string::npos) << part << " in " << refused.err();
      EXPECT_NE(study.err().find(part), std::string::npos) << part << " in " << study.err();
    }
    EXPECT_FALSE(std::filesystem::exists(refused.dir()));
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "study"));
}

}  // namespace
}  // namespace skein::test
