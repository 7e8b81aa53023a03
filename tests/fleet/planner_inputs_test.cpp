// Inputs and outputs of planners beside map and path, through a whole fleet: LiDAR scans, and commands of their own.
#include <cmath>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using PlannerInputs = FleetTest;

/// The last entry of the planner `probe` in a UAV's log.
Json last_news(const SkeinRun& run, const std::string& uav) {
  const std::string log = text_of(run.dir() / ("uav_agent-" + uav + ".log")), mark = "probe {";
  const std::size_t at = log.rfind(mark);
  if (at == std::string::npos) return Json::object();
  const std::size_t begin = at + mark.size() - 1;
  return Json::parse(log.substr(begin, log.find('\n', begin) - begin), nullptr, false);
}

/// Heights of a UAV by time [s], from trajectories.csv.
std::map<double, double> heights(const SkeinRun& run, const std::string& uav) {
  std::map<double, double> z;
  for (const auto& row : read_csv(run.dir() / "trajectories.csv")) {
    if (row.at("uav") == uav) z[std::stod(row.at("time_s"))] = std::stod(row.at("z"));
  }
  return z;
}

TEST_F(PlannerInputs, PlannersGetScansOnRequestAndTheirCommandsArriveUnchanged) {
  const Arguments brief = {"towers", "--duration", "15"};
  const auto fly = [&](const std::string& name, Arguments more) -> SkeinRun& {
    more.insert(more.begin(), brief.begin(), brief.end());
    return run(name, more);
  };
  SkeinRun& probe = fly("probe", {"--agent", helper_program("probe_agent"), "--planner", "probe"});
  SkeinRun& plain = fly("plain", {"--agent", helper_program("probe_agent"), "--planner", "hover"});
  const Json result = probe.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["deterministic"]);
  EXPECT_TRUE(result["collisions"].empty());

  long scans = 0;
  for (const Json& uav : result["uavs"]) {
    const std::string name = uav["name"];
    const Json news = last_news(probe, name);
    ASSERT_TRUE(news.contains("scans")) << name;
    SCOPED_TRACE(name + ": " + news.dump());
    const bool explorer = uav["role"] == "explorer";
    EXPECT_NEAR(news["scans"], explorer ? 10.0 * news["t"].get<double>() + 1.0 : 0.0, 1.0)
        << "an explorer must get ten scans per second";
    EXPECT_EQ(news["late"], 0) << "a scan did not arrive with the exchange that follows it";
    EXPECT_EQ(news["points"] > 0, explorer);
    EXPECT_EQ(news["own_frames"] > 0, explorer);
    EXPECT_GT(news["others_frames"], 0) << "no key frames arrived from the explorer beside this UAV";
    scans += news["scans"].get<long>();
    EXPECT_EQ(uav["commands_rejected"], 0);

    const auto z = heights(probe, name);
    EXPECT_GT(z.at(5.0) - z.at(0.0), 3.0) << "the UAV did not climb at 1.5 m/s, as commanded";
    EXPECT_LT(z.at(5.0) - z.at(0.0), 9.0);
    EXPECT_NEAR(z.rbegin()->second - z.at(5.0), 3.0, 0.5) << "the path of 3 m did not begin at the UAV's position";
  }
  EXPECT_GE(result["timing"]["scans"].get<long>(), scans - 2)
      << "all scans but the first one of each explorer must be counted";
  EXPECT_LT(plain.result()["timing"]["scans"].get<long>(), scans / 3)
      << "scans were computed although no planner read them";
}

TEST_F(PlannerInputs, ARestartedAgentGetsAllDetectionsOfItsCamera) {
  const std::string scenario = write_small_scene(folder() / "small");
  const auto faults = write("restart.yaml", "faults: [{at_s: 20.0, until_s: 21.0, kill: changi}]\n");
  SkeinRun& done = run("run", {scenario, "--agent", helper_program("probe_agent"), "--planner",
                               "probe:east_m=12,up_m=0", "--duration", "25", "--faults", faults});
  EXPECT_TRUE(done.result()["collisions"].empty());
  for (const std::string uav : {"jurong", "changi"}) {
    std::set<std::string> seen;
    for (const auto& row : read_csv(done.dir() / "captures.csv")) {
      if (row.at("uav") == uav) seen.insert(row.at("point"));
    }
    ASSERT_GT(seen.size(), 5U);
    const Json news = last_news(done, uav);
    SCOPED_TRACE(uav + ": " + news.dump());
    EXPECT_EQ(news["named"], seen.size());
    EXPECT_EQ(news["gaps"], 0) << "points did not arrive in the order of detection";
    EXPECT_EQ(news["first_detected"], uav == "changi" ? seen.size() : 0U);
  }
}

}  // namespace
}  // namespace skein::test
