// UAVs that ROS 2 nodes fly in real time without the lock-step (--clock realtime --planner UAV=ros): real nodes that do
// not know Skein, on either middleware, start late, die and come back, or stall. Skein counts their messages.
#include <algorithm>

#include "tests/support/places.hpp"
#include "workspace_fixture.hpp"

namespace skein::test {
namespace {

const std::string kNodesUav = "jurong";
const std::string kTrajectory = "/jurong/command/trajectory", kPlan = "/plan";

class FreeNodes : public WorkspaceTest, public testing::WithParamInterface<std::string> {
 protected:
  SkeinRun& start_fleet(const std::string& name = "fleet", const Arguments& more = {}) {
    SkeinRun& fleet = start(name, joined({"towers", "--planner", "hover,jurong=ros", "--clock", "realtime",
                                          "--duration", "3000", "--no-oracle", "--dds", GetParam()},
                                         more));
    EXPECT_TRUE(fleet.wait_until_flying()) << fleet.err();
    return fleet;
  }

  /// Starts a node while the fleet flies. @param what  arguments of free_node.py after UAV and FILE
  ChildProcess& start_free_node(const SkeinRun& fleet, const std::string& name, const std::string& middleware,
                                const std::string& what) {
    return start_node(
        name, middleware, fleet.domains().first + 2, "",
        as_told("python3 " + source_path("tests/ros2/free_node.py ") + kNodesUav + " " + file(name) + " " + what));
  }
  /// The command with the settings that `skein run --ros-env` prints for Fast DDS, with which a killed node leaves no
  /// shared memory.
  std::string as_told(const std::string& command) const {
    return "env FASTRTPS_DEFAULT_PROFILES_FILE=" + installed("skein_ros") + "/share/skein_ros/fastdds_udp.xml " +
           command;
  }
  bool wait_for_file(const std::string& path) {
    return eventually([&] { return std::filesystem::exists(path); }, std::chrono::minutes(3));
  }
  /// Waits until a node has flown the UAV to its goal. @returns the numbers of messages that it published.
  Json published(const std::string& name) {
    if (!wait_for_file(file(name))) {
      ADD_FAILURE() << name << " has not flown the UAV to its goal";
      return {{"trajectory", 0}, {"plan", 0}};
    }
    return Json::parse(text_of(file(name)));
  }

  Json end(SkeinRun& fleet) {
    fleet.skein().signal(SIGINT);
    fleet.exit_code();
    return fleet.result();
  }

  /// Bound on a node's first messages that are lost, because the reader has not matched the node yet.
  static constexpr std::uint64_t kBeforeMatch = 15;
  static Json counts_of(const Json& result, const std::string& topic) {
    for (const Json& entry : result["uavs"][0]["from_nodes"]) {
      if (entry["topic"] == topic) return entry;
    }
    ADD_FAILURE() << topic << " is not counted in " << result["uavs"][0].dump();
    return {{"received", 0}, {"handed_on", 0}, {"late", 0}, {"lost", 0}, {"refused", 0}, {"other_clock", 0}};
  }
  static void expect_received(const Json& counts, std::uint64_t published, std::uint64_t nodes = 1) {
    EXPECT_LE(counts["received"], published) << counts;
    EXPECT_GE(counts["received"].get<std::uint64_t>() + nodes * kBeforeMatch, published) << counts;
    EXPECT_EQ(counts["received"].get<std::uint64_t>(),
              counts["handed_on"].get<std::uint64_t>() + counts["lost"].get<std::uint64_t>())
        << counts;
  }
};

TEST_P(FreeNodes, FlyTheirUavIfTheyStartLateOrRestart) {
  SkeinRun& fleet = start_fleet();
  start_free_node(fleet, "first", "cyclonedds", "3 60");
  const Json first = published("first");

  ChildProcess& killed = start_free_node(fleet, "killed", "fastrtps", "2 0");
  ASSERT_TRUE(wait_for_file(file("killed") + ".ready"));
  killed.signal(SIGKILL);
  killed.wait();
  start_free_node(fleet, "back", "fastrtps", "4 60");
  const Json back = published("back");

  const Json result = end(fleet);
  const Json counts = counts_of(result, kTrajectory);
  // The killed node published at least forty times; the exact number is not known.
  EXPECT_GE(counts["received"].get<std::uint64_t>() + 3 * kBeforeMatch, 60U + 40U + 60U) << counts;
  EXPECT_EQ(counts["received"], counts["handed_on"]) << counts;
  EXPECT_EQ(counts["refused"], 0) << counts;
  EXPECT_EQ(counts["other_clock"], 0) << counts;
  EXPECT_GT(result["uavs"][0]["distance_m"], 3.0 + 2.5) << "not every node flew the UAV to its goal";
  EXPECT_EQ(result["uavs"][0]["commands_unheard"], 0);
  EXPECT_EQ(result["radio"]["unheard"], 0);
  EXPECT_GE(result["radio"]["sent"].get<int>(), 10) << "messages of the nodes on /plan were not sent";
  EXPECT_FALSE(result["deterministic"]);
  EXPECT_NE(fleet.out().find(kTrajectory), std::string::npos) << fleet.out();
}

TEST_P(FreeNodes, SendLateCommandsAfterAStallAndFlyOn) {
  SkeinRun& fleet = start_fleet();
  start_free_node(fleet, "stalls", GetParam() == "fastdds" ? "cyclonedds" : "fastrtps", "4 80 stall");
  const Json said = published("stalls");
  const Json result = end(fleet), counts = counts_of(result, kTrajectory);
  expect_received(counts, said["trajectory"]);
  expect_received(counts_of(result, kPlan), said["plan"]);
  EXPECT_GE(counts["late"], 10) << counts;
  EXPECT_LT(counts["late"], counts["handed_on"]) << counts;
  EXPECT_GT(result["uavs"][0]["distance_m"], 3.0);
}

TEST_P(FreeNodes, SendInvalidCommandsThatAreRejectedAndCounted) {
  SkeinRun& fleet = start_fleet();
  start_free_node(fleet, "rejected", "cyclonedds", "3 60 reject");
  const Json said = published("rejected");
  const Json result = end(fleet), counts = counts_of(result, kTrajectory);
  expect_received(counts, said["trajectory"]);
  EXPECT_EQ(counts["refused"], 5) << counts;
  EXPECT_EQ(result["uavs"][0]["commands_rejected"], 5);
}

// The UAV's program is absent for a while, but the node continues: its messages during the absence have no effect and
// are counted, and afterwards the node flies the UAV again.
TEST_P(FreeNodes, HaveNoEffectWhileAFaultStopsOrKillsTheirUavsProgram) {
  for (const std::string kind : {"pause", "kill"}) {
    const auto faults =
        write(kind + ".yaml", "faults:\n  - {when: 'z(jurong) > 3 m', for_s: 4, " + kind + ": jurong}\n");
    SkeinRun& fleet = start_fleet(kind, {"--faults", faults});
    start_free_node(fleet, "node_" + kind, kind == "kill" ? "fastrtps" : "cyclonedds", "8 300");
    const Json said = published("node_" + kind);
    const Json result = end(fleet), counts = counts_of(result, kTrajectory);
    EXPECT_GT(result["uavs"][0]["commands_unheard"], 0) << kind;
    EXPECT_LT(counts["handed_on"], said["trajectory"]) << kind << counts;
    EXPECT_GT(counts["handed_on"], 20) << kind << counts;
    EXPECT_GT(result["uavs"][0]["distance_m"], 7.0) << kind;
    EXPECT_TRUE(result["faults"][0]["at_s"].is_number()) << kind;
    EXPECT_EQ(result["lost_members"], Json::array()) << kind;
  }
}

// A component in C++ with a wall timer, started as by `ros2 run`.
TEST_P(FreeNodes, InCppFlyWithSimulatedTime) {
  SkeinRun& fleet = start_fleet();
  const std::string library = installed("skein_ros_examples") + "/lib/libplain_node.so";
  start_node("climber", "fastrtps", fleet.domains().first + 2, "",
             as_told(with_workspace(installed("skein_ros") + "/lib/skein_ros/run_in_step " + library +
                                    ":plain::Climber --ros-args -p height_m:=4.0 -p use_sim_time:=true -r __ns:=/" +
                                    kNodesUav)));
  const auto climbed = [&] {
    const auto rows = read_csv(fleet.dir() / "trajectories.csv", LastLine::may_be_unfinished);
    return std::ranges::any_of(rows, [](const auto& row) {
      return row.at("uav") == kNodesUav && row.contains("z") && !row.at("z").empty() && std::stod(row.at("z")) > 3.5;
    });
  };
  EXPECT_TRUE(eventually(climbed, std::chrono::minutes(3)));
  const Json counts = counts_of(end(fleet), kTrajectory);
  EXPECT_GT(counts["handed_on"], 10) << counts;
  EXPECT_EQ(counts["other_clock"], 0) << counts;
}

INSTANTIATE_TEST_SUITE_P(Vendors, FreeNodes, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

class NoNodes : public FleetTest {};

TEST_F(NoNodes, AreReported) {
  SkeinRun& fleet = run("fleet", {"towers", "--planner", "hover,jurong=ros", "--clock", "realtime:20", "--duration",
                                  "10", "--no-oracle"});
  EXPECT_NE(fleet.out().find("jurong: no ROS 2 node sent anything; `skein run --ros-env jurong`"), std::string::npos)
      << fleet.out();
  EXPECT_EQ(fleet.result()["uavs"][0]["from_nodes"], Json::array());
  EXPECT_FALSE(fleet.result()["uavs"][1].contains("from_nodes"));
}

TEST_F(NoNodes, AreRefusedInTheLockStep) {
  SkeinRun& refused = run("refused", {"towers", "--planner", "hover,jurong=ros"}, {}, 2);
  EXPECT_NE(refused.err().find("--planner jurong=ros: "), std::string::npos) << refused.err();
  EXPECT_NE(refused.err().find("--clock realtime"), std::string::npos) << refused.err();
}

// `skein run --ros-env` prints the environment of a UAV's node, for the fleet that flies on this host.
TEST_F(NoNodes, GetTheirDomainFromTheLauncher) {
  SkeinRun& fleet = start("fleet", {"towers", "--clock", "realtime", "--duration", "3000", "--no-oracle"});
  ASSERT_TRUE(fleet.wait_until_flying()) << fleet.err();
  const auto printed = [&](const std::string& uav) -> ChildProcess& {
    return skein({"run", "--ros-env", uav, "--out", fleet.dir()});
  };
  EXPECT_NE(printed("raffles").out().find("export ROS_DOMAIN_ID=" + std::to_string(fleet.domains().first + 3) + "\n"),
            std::string::npos);
  ChildProcess& unknown = printed("nobody");
  EXPECT_EQ(unknown.wait().code, 2);
  EXPECT_NE(unknown.err().find("jurong, raffles, sentosa, changi, nanyang"), std::string::npos) << unknown.err();
  fleet.skein().signal(SIGINT);
  fleet.exit_code();
}

}  // namespace
}  // namespace skein::test
